// Any bytes given as a glass catalogue: refused with an InputError, or glasses with names, ranges, and an index in the middle of
// each. Anything else is a crash.
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "files/lenses/agf.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim;
    GlassCatalogue catalogue;
    try {
        catalogue = parse_agf(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    } catch (const InputError& error) {
        if (error.problems.empty()) std::abort();
        return 0;
    }
    for (const Glass& glass : catalogue.glasses) {
        if (glass.name.empty() || !(glass.range_nm[0] < glass.range_nm[1])) std::abort();
        if (!std::isfinite(index_of(glass, (glass.range_nm[0] + glass.range_nm[1]) / 2))) std::abort();
        index_of(glass, glass.range_nm[0]);
        abbe_number(glass);
    }
    return 0;
}
