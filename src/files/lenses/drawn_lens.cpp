#include "files/lenses/drawn_lens.h"

#include <cmath>

#include "base/constants.h"

namespace lfdsim {

void scale(DrawnLens& lens, double factor) {
    for (DrawnSurface& s : lens.surfaces) {
        s.curvature_per_mm /= factor;
        s.distance_mm *= factor;
        if (s.semi_aperture_mm) *s.semi_aperture_mm *= factor;
        double per_length = factor * factor * factor;  // of a4, whose unit is mm^-3
        for (double& a : s.even_asphere) {
            a /= per_length;
            per_length *= factor * factor;
        }
    }
    if (lens.beam.entrance_pupil_mm) *lens.beam.entrance_pupil_mm *= factor;
    if (lens.beam.object_height_mm) *lens.beam.object_height_mm *= factor;
}

double slope_of_field(double x_deg, double y_deg) { return std::hypot(std::tan(x_deg * degree), std::tan(y_deg * degree)); }

bool fold_r2(DrawnSurface& s, double a2) {
    if (a2 == 0) return true;
    if (s.curvature_per_mm != 0 && s.conic != -1) return false;
    s.curvature_per_mm += 2 * a2;
    s.conic = -1;
    return true;
}

}  // namespace lfdsim
