// Any bytes given as a lens of Optiland: refused with an InputError, or a lens whose display, if there can be one, reads back as it
// was written. Anything else is a crash.
#include "imported.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    return lfdsim::fuzz_import(lfdsim::parse_optiland, {reinterpret_cast<const char*>(data), size});
}
