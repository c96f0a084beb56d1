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

std::optional<std::string> fill_apertures(DrawnLens& lens, const std::vector<double>& indices) {
    const auto first = lens.surfaces.begin() + 1, end = lens.surfaces.end() - 1;
    const auto stop = std::find_if(first, end, [](const DrawnSurface& s) { return s.is_stop; });
    const double object = lens.surfaces.front().distance_mm;
    const DrawnBeam& beam = lens.beam;
    if (stop == end) return "stop";
    if (!beam.field_slope && (!beam.object_height_mm || std::isinf(object)))
        return "field as angles, or as heights of an object at a finite distance,";
    if (!stop->semi_aperture_mm && !beam.entrance_pupil_mm && !beam.f_number && !beam.working_f_number)
        return "entrance pupil, f-number or size of the stop";

    // All paraxial rays are sums of these two: one parallel to the axis at the height 1, one through the first vertex of slope 1.
    // A ray from the axial point of the object is `high` if that is at infinity, else d high + steep from the distance d.
    const ParaxialRay high = paraxial_ray(lens, indices, 1, 0), steep = paraxial_ray(lens, indices, 0, 1);
    const double highs = std::isinf(object) ? 1 : object, steeps = std::isinf(object) ? 0 : 1;
    const auto axial = [&](double of_high, double of_steep) { return highs * of_high + steeps * of_steep; };
    // The chief ray meets the stop on the axis: before the lens it is y = field (z - pupil_at), z from the first vertex, where its
    // height is `chief`.
    const auto at_stop = std::size_t(stop - first);
    const double pupil_at = steep.height_mm[at_stop] / high.height_mm[at_stop];
    const double field = beam.field_slope ? *beam.field_slope : *beam.object_height_mm / (object + pupil_at);
    const double chief = -field * steep.height_mm[at_stop] / high.height_mm[at_stop];

    // The factor by which the axial ray becomes the edge of the axial beam: that ray's height on the stop, or in the entrance
    // pupil, or, by the f-number, its pupil f/2N with 1/f = |n u| of `high`; 1/2N is its own slope in the image, where N works.
    double edge = 0;
    if (stop->semi_aperture_mm)
        edge = *stop->semi_aperture_mm / axial(high.height_mm[at_stop], steep.height_mm[at_stop]);
    else if (beam.entrance_pupil_mm)
        edge = *beam.entrance_pupil_mm / 2 / axial(1, pupil_at);
    else if (beam.f_number)
        edge = 1 / high.slope / (2 * *beam.f_number) / axial(1, pupil_at);
    else
        edge = 1 / axial(high.slope, steep.slope) / (2 * *beam.working_f_number);

    std::vector<double> needed;
    for (std::size_t i = 0; i < high.height_mm.size(); ++i) {
        const double rim = std::abs(edge * axial(high.height_mm[i], steep.height_mm[i]));
        needed.push_back(i == at_stop ? rim : rim + std::abs(chief * high.height_mm[i] + field * steep.height_mm[i]));
    }
    if (!std::all_of(needed.begin(), needed.end(), [](double x) { return x > 0 && std::isfinite(x); }))
        return "finite width on every surface";
    for (std::size_t i = 0; i < needed.size(); ++i)
        if (std::optional<double>& semi = first[std::ptrdiff_t(i)].semi_aperture_mm; !semi) semi = needed[i];
    return {};
}

}  // namespace lfdsim
