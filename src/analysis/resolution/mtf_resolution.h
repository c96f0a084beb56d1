// Resolution in a plane: the least of MTF50 and the sampling limits there. Floor 3.
#pragma once
#include "analysis/resolution/mtf_curves.h"

#include <string>

namespace lfdsim {

struct Resolution {
    double lens_limit_per_mm;   // half a cycle per lens pitch, as the eye projects it into the plane
    double pixel_limit_per_mm;  // half a cycle per image of a panel pixel; infinite in the lenses' own plane
    Estimate per_mm;            // NaN where it is undefined, and `missing` says why
    const char* limited_by;     // "mtf50", "lens sampling" or "pixel image"; empty where it is undefined
    std::string missing;
    double theory_per_mm;  // the same of theory's MTF50
};

Resolution resolution(const Subject&, const MtfCurves&);

}  // namespace lfdsim
