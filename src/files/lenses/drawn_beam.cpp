#include "files/lenses/drawn_beam.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

// A paraxial ray in the order of light: its heights on all surfaces except object and image, and its optical slope n u after them.
struct ParaxialRay {
    std::vector<double> height_mm;
    double slope;
};

// Traces a ray from the first surface on, which it reaches at a height and with a slope in air. At each surface n'u' = n u - c (n'
// - n) y, and over the distance t to the next y' = y + t/n' (n'u').
ParaxialRay paraxial_ray(const DrawnLens& lens, const std::vector<double>& indices, double height, double slope) {
    ParaxialRay ray{{}, slope};
    for (std::size_t i = 1; i + 1 < lens.surfaces.size(); ++i) {
        const DrawnSurface& s = lens.surfaces[i];
        ray.height_mm.push_back(height);
        ray.slope -= s.curvature_per_mm * (indices[i] - indices[i - 1]) * height;
        height += s.distance_mm / indices[i] * ray.slope;
    }
    return ray;
}

}  // namespace

bool fill_apertures(DrawnLens& lens, const std::vector<double>& indices) {
    const auto first = lens.surfaces.begin() + 1, end = lens.surfaces.end() - 1;
    const auto stop = std::find_if(first, end, [](const DrawnSurface& s) { return s.is_stop; });
    if (stop == end || !lens.beam.field_slope || !std::isinf(lens.surfaces.front().distance_mm)) return false;
    // All paraxial rays are sums of these two: one parallel to the axis at the height 1, one through the first vertex of slope 1.
    const ParaxialRay high = paraxial_ray(lens, indices, 1, 0), steep = paraxial_ray(lens, indices, 0, 1);
    const auto at_stop = std::size_t(stop - first);

    // The radius of the entrance pupil; the f-number is f/(2 pupil), 1/f = |n u| of the ray of height 1.
    double pupil = 0;
    if (stop->semi_aperture_mm)
        pupil = *stop->semi_aperture_mm / std::abs(high.height_mm[at_stop]);
    else if (lens.beam.entrance_pupil_mm)
        pupil = *lens.beam.entrance_pupil_mm / 2;
    else if (lens.beam.f_number)
        pupil = 1 / std::abs(high.slope) / (2 * *lens.beam.f_number);
    // The chief ray comes from the field's edge and meets the stop on the axis: its height at the first surface is `chief`.
    const double field = *lens.beam.field_slope;
    const double chief = -field * steep.height_mm[at_stop] / high.height_mm[at_stop];

    std::vector<double> needed;
    for (std::size_t i = 0; i < high.height_mm.size(); ++i) {
        const double beam = pupil * std::abs(high.height_mm[i]);
        needed.push_back(i == at_stop ? beam : beam + std::abs(chief * high.height_mm[i] + field * steep.height_mm[i]));
    }
    if (!(pupil > 0) || !std::all_of(needed.begin(), needed.end(), [](double x) { return x > 0 && std::isfinite(x); }))
        return false;
    for (std::size_t i = 0; i < needed.size(); ++i)
        if (std::optional<double>& semi = first[std::ptrdiff_t(i)].semi_aperture_mm; !semi) semi = needed[i];
    return true;
}

}  // namespace lfdsim
