// Any bytes given as a PFM picture: refused with an InputError, or a picture. Anything else is a crash.
#include "picture.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    return lfdsim::fuzz_picture(".pfm", data, size);
}
