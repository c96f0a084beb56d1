// Any bytes given as an NPY picture: refused with an InputError, or a picture. Anything else is a crash.
#include "picture.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    return lfdsim::fuzz_picture(".npy", data, size);
}
