#include "analysis/resolution/mtf_resolution.h"

#include "analysis/resolution/mtf_theory.h"
#include "base/constants.h"

#include <cmath>

namespace lfdsim {

Resolution resolution(const Subject& s, const MtfCurves& m) {
    const Geometry& g = s.geometry();
    const double z = g.vertex_plane_mm + m.depth_mm, theory = m.theory_below(0.5);
    Resolution r{lens_limit_per_mm(s, m.direction, z, m.angle_deg), pixel_limit_per_mm(s, m.direction, z), {nan, nan}, "", "", nan};
    const double limit = std::min(r.lens_limit_per_mm, r.pixel_limit_per_mm);
    if (m.has_theory()) r.theory_per_mm = std::isnan(theory) ? limit : std::min(theory, limit);
    if (!m.missing.empty()) {
        r.missing = m.missing;
        if (at_the_lenses(s.display(), g, z)) r.theory_per_mm = nan;
    } else {
        // A curve that does not fall below one half within the frequencies measured does not do so below the limit: the limit is
        // then the resolution, and its error reaches to where the curve less its error does.
        const LimitingFrequency mtf50 = m.below(0.5);
        const bool limited = !(mtf50.found.value < limit);
        r.per_mm = limited ? Estimate{limit, mtf50.least < limit ? limit - mtf50.least : 0} : mtf50.found;
        r.limited_by = !limited ? "mtf50" : r.lens_limit_per_mm <= r.pixel_limit_per_mm ? "lens sampling" : "pixel image";
    }
    return r;
}

}  // namespace lfdsim
