// Resolution in a plane: the lowest of MTF50 and the sampling limits there. Floor 3.
#pragma once
#include "analysis/resolution/mtf_curves.h"

#include <string>

namespace lfdsim {

/// The resolution in a plane and its limits, cycles per mm there.
struct Resolution {
    double lens_limit_per_mm;   // half a cycle per jump from lens to lens; infinite in the central depth plane
    double pixel_limit_per_mm;  // half a cycle per image of a panel pixel; infinite in the lenses' own plane
    Estimate per_mm;            // NaN: it is undefined, and `missing` says why
    const char* limited_by;     // "mtf50", "lens sampling" or "pixel image"; empty if it is undefined
    std::string missing;
    double theory_per_mm;  // resolution with theory's MTF50
};

/// Returns the resolution by curves of lines of sight.
Resolution resolution(const Subject&, const MtfCurves&);

}  // namespace lfdsim
