#include "analysis/spot_depth.h"

#include <fmt/format.h>
#include <cmath>
#include <limits>

// docs/model.md, "Depth of field by spot size".
namespace lfdsim {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
constexpr double far_mm = 1e12;  // what is sharp there has no bound
constexpr int fan_rays = 1001;

/// Where a predicate that changes once, from false at `out` to true at `in`, changes.
template <class Predicate>
double change(double out, double in, Predicate holds) {
    for (int halved = 0; halved < 120; ++halved) {
        const double middle = 0.5 * (out + in);
        (holds(middle) ? in : out) = middle;
    }
    return in;
}

}  // namespace

Allowed pixel_image(const Display& d, const Geometry& g, const Theory& t) {
    if (std::isinf(t.central_depth_mm)) return {0, d.panel.pixel_pitch_mm / g.gap_mm};
    return {t.pixel_image_mm, 0};
}

SharpDepths where_sharp(const std::vector<Line>& fan, Allowed allowed, double airy_per_mm) {
    const auto width = [&](double z) {
        const Width w = width_at(fan, z);
        if (airy_per_mm == 0) return w;
        const double mm = std::hypot(w.mm, airy_per_mm * z);
        return Width{mm, mm > 0 ? (w.mm * w.per_mm + airy_per_mm * airy_per_mm * z) / mm : 0};
    };
    // Both are convex functions of z, and so is what is too much: it has one minimum, and is not above 0 in one interval about it.
    const auto rises = [&](double z) { return width(z).per_mm > allowed.per_mm; };
    const auto sharp = [&](double z) { return width(z).mm <= allowed.mm + allowed.per_mm * z; };
    const double best = rises(-far_mm) ? -far_mm : rises(far_mm) ? change(-far_mm, far_mm, rises) : far_mm;
    if (fan.empty() || !sharp(best)) return {nan, nan, best, width(best).mm};
    return {sharp(-far_mm) ? -infinity : change(-far_mm, best, sharp), sharp(far_mm) ? infinity : change(far_mm, best, sharp), best,
            width(best).mm};
}

std::array<double, 2> quarter_wave_depths(double L, double D, double wavelength_mm) {
    const double v = 1 / L, most = 2 * wavelength_mm / (D * D);
    if (L < 0) return {v + most < 0 ? 1 / (v + most) : -infinity, 1 / (v - most)};
    return {1 / (v + most), v > most ? 1 / (v - most) : infinity};
}

std::array<double, 2> add_spot_depths(const Subject& s, Result& result) {
    const Theory& t = s.theory();
    const Geometry& g = s.geometry();
    const double from_vertex = g.rear_principal_mm - g.vertex_plane_mm, D = g.clear_aperture_mm, L = t.central_depth_mm;
    const double wavelength_mm = s.options().wavelength_nm * 1e-6;
    const std::vector<Line> fan = fans(LensTrace(s.display(), g), {0, 0}, fan_rays).meridional;
    const Allowed allowed = pixel_image(s.display(), g, t);
    const auto number = [](double x) { return std::isfinite(x) ? Json(x) : Json(); };
    const std::vector<double> paraxial{t.depth_range_mm[0] + from_vertex, t.depth_range_mm[1] + from_vertex};

    const auto say = [&](const char* key, const std::string& what, const SharpDepths& depths, const std::string& remark) {
        Finding finding{"Depth of field: " + what, "mm", {}, paraxial, remark};
        if (std::isnan(depths.low)) {
            result.figures[key] = Json();
            finding.remark = fmt::format(
                "the spot is nowhere as narrow as a panel pixel's image; it comes nearest to that {:.4g} mm "
                "before the lenses, where it is {:.4g} mm wide",
                depths.best + from_vertex, depths.least_mm);
            result.remarks.push_back(finding.what + ": " + finding.remark + ".");
        } else {
            finding.measured = {depths.low + from_vertex, depths.high + from_vertex};
            result.figures[key] = {number(finding.measured[0]), number(finding.measured[1])};
        }
        result.findings.push_back(std::move(finding));
        return depths;
    };
    const SharpDepths traced = say("spot_mm", "spot no wider than a pixel's image, traced", where_sharp(fan, allowed),
                                   "on the axis; theory is paraxial: where they differ the lens's aberrations are the cause");
    result.figures["spot_best_mm"] = number(traced.best + from_vertex);
    result.figures["spot_least_width_mm"] = number(traced.least_mm);
    if (s.display().diffuser) {
        const double z = *g.diffuser_z_mm - g.rear_principal_mm;
        const double angle = diffuser_angle(s.display(), {1, 0});
        say("spot_with_diffuser_mm", "the same with the diffuser's widening", where_sharp(diffused(fan, z, angle), allowed),
            "the diffuser widens a spot by its angle times the distance from it");
    }
    say("spot_with_diffraction_mm", fmt::format("the same with the Airy disk at {} nm", s.options().wavelength_nm),
        where_sharp(fan, allowed, 2.44 * wavelength_mm / D), "2.44 wavelength z / D, added in quadrature");
    const auto wave = quarter_wave_depths(L, D, wavelength_mm);
    result.figures["diffraction_quarter_wave_mm"] = {number(wave[0] + from_vertex), number(wave[1] + from_vertex)};
    result.findings.push_back({"Depth of field: quarter of a wave, of a perfect lens",
                               "mm",
                               {},
                               {wave[0] + from_vertex, wave[1] + from_vertex},
                               "where diffraction alone begins to tell defocus; pixels coarser than the Airy disk allow more"});
    return {traced.low + from_vertex, traced.high + from_vertex};
}

}  // namespace lfdsim
