#include "engine/scene/misalignment.h"
#include "geometry/lens_misalignment.h"
#include "report/folder/description.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

std::vector<Figure> largest_errors(const Display& d, const Geometry& g) {
    if (!lenses_differ(d.errors)) return {};
    double aside = 0, height = 0, tilt = 0, curvature = 0;
    for (const LensError& e : lenses_as_built(d, g.lattice)) {
        aside = std::max(aside, std::hypot(e.aside_mm[0], e.aside_mm[1]));
        height = std::max(height, std::abs(e.height_mm));
        tilt = std::max(tilt, std::hypot(e.tilt_deg[0], e.tilt_deg[1]));
        curvature = std::max(curvature, std::abs(e.curvature));
    }
    return {{"largest_decenter_mm", {aside}, "distance of a lens's axis from its lattice position"},
            {"largest_height_mm", {height}, "height of a lens's vertex above or below the common plane, including bow"},
            {"largest_tilt_deg", {tilt}, "tilt of a lens's axis"},
            {"largest_curvature_error", {curvature}, "relative error of a lens's curvatures"}};
}

}  // namespace lfdsim
