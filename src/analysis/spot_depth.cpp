#include "analysis/spot_depth.h"

#include "model/numbers.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// docs/model.md, "Depth of field by spot size".
namespace lfdsim {
namespace {

constexpr double most_per_mm = 1e6;  // a nanometre in front of the lens
constexpr int depth_fan_rays = 1001;

/// Where a predicate that changes once, from false at `out` to true at `in`, changes.
template <class Predicate>
double change(double out, double in, Predicate holds) {
    for (int halved = 0; halved < 120; ++halved) {
        const double middle = 0.5 * (out + in);
        (holds(middle) ? in : out) = middle;
    }
    return in;
}

/// Every third ray from `first` on, with the rims.
std::vector<Line> thinned(const std::vector<Line>& fan, std::size_t first) {
    std::vector<Line> third;
    for (std::size_t k = first; k < fan.size(); k += 3) third.push_back(fan[k]);
    if (!fan.empty()) third.insert(third.end(), {fan.front(), fan.back()});
    return third;
}

/// A fan, and the three thirds of it.
struct Fan {
    explicit Fan(const std::vector<Line>& fan) : all(fan), thirds{thinned(fan, 0), thinned(fan, 1), thinned(fan, 2)} {}
    /// Each ray turned by the diffuser.
    Fan diffused_at(double z, double angle) const {
        Fan turned(*this);
        for (std::vector<Line>* lines : {&turned.all, &turned.thirds[0], &turned.thirds[1], &turned.thirds[2]})
            *lines = diffused(*lines, z, angle);
        return turned;
    }
    std::vector<Line> all;
    std::array<std::vector<Line>, 3> thirds;
};

/// The errors of the ends by the finite number of rays. An end is set by the outermost ray, which lies d <= h/2 beside the true
/// one, h the step between rays, and misses it by k d^2, k the curvature. The third whose nearest ray is the next but one misses by
/// k (h + d)^2: it differs from all rays together by k (h^2 + 2 h d), at least eight times as much.
std::array<double, 2> errors(const SharpDepths& all, const Fan& fan, double pixel_slope, double airy_slope) {
    constexpr double margin = 0.25;  // twice an eighth
    std::array<double, 2> most{1e-9 * std::abs(all.near_per_mm), 1e-9 * std::abs(all.far_per_mm)};
    for (const std::vector<Line>& third : fan.thirds) {
        const SharpDepths other = where_sharp(third, pixel_slope, airy_slope);
        most[0] = std::max(most[0], margin * std::abs(all.near_per_mm - other.near_per_mm));
        most[1] = std::max(most[1], margin * std::abs(all.far_per_mm - other.far_per_mm));
    }
    return most;
}

/// The same in millimetres, to first order.
double error_mm(double per_mm, double error_per_mm) { return error_per_mm / (per_mm * per_mm); }

/// Writes what is found and what theory says as millimetres from the vertex plane, and as dioptres from the principal plane.
class Teller {
  public:
    Teller(const Subject& s, Result& result)
        : from_vertex_(s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm),
          pixel_slope_(s.display().panel.pixel_pitch_mm / s.geometry().gap_mm),
          paraxial_(ends_mm(s.theory().depth_near_per_mm, s.theory().depth_far_per_mm)),
          result_(result) {}

    void operator()(const std::string& key, const std::string& what, const Fan& fan, double airy_slope, const std::string& remark) {
        const SharpDepths depths = where_sharp(fan.all, pixel_slope_, airy_slope);
        Finding finding{"Depth of field: " + what, "mm", {}, paraxial_, remark};
        if (std::isnan(depths.near_per_mm)) {
            for (const char* unit : {"_mm", "_diopters"}) result_.figures[key + unit] = Json();
            finding.measured = {nan, nan};
            finding.remark = fan.all.empty()
                                 ? "no light of the panel's point on the axis gets through the lens"
                                 : fmt::format(
                                       "the spot is nowhere as narrow as a panel pixel's image; it comes nearest to that {} mm "
                                       "in front of the lenses, where it is {:.4g} pixel images wide",
                                       text_mm(depths.best_per_mm), depths.least_width / pixel_slope_);
            result_.note(key + "_mm", finding.remark);
            result_.note(key + "_diopters", finding.remark);
        } else {
            const auto [near, far] = errors(depths, fan, pixel_slope_, airy_slope);
            finding.measured = ends_mm(depths.near_per_mm, depths.far_per_mm);
            finding.error = {error_mm(depths.near_per_mm, near), error_mm(depths.far_per_mm, far)};
            result_.figures[key + "_mm"] = numbers_json(finding.measured);
            result_.figures[key + "_mm_error"] = numbers_json(finding.error);
            result_.figures[key + "_diopters"] = numbers_json({1000 * depths.near_per_mm, 1000 * depths.far_per_mm});
            result_.figures[key + "_diopters_error"] = numbers_json({1000 * near, 1000 * far});
        }
        result_.findings.push_back(std::move(finding));
    }

    std::vector<double> ends_mm(double near_per_mm, double far_per_mm) const {
        return {depth_mm(near_per_mm) + from_vertex_, depth_mm(far_per_mm) + from_vertex_};
    }
    double pixel_slope() const { return pixel_slope_; }

  private:
    std::string text_mm(double per_mm) const {
        const double z = depth_mm(per_mm) + from_vertex_;
        return std::isinf(z) ? "infinitely many" : fmt::format("{:.4g}", z);
    }

    double from_vertex_, pixel_slope_;
    std::vector<double> paraxial_;
    Result& result_;
};

}  // namespace

SharpDepths where_sharp(const std::vector<Line>& fan, double pixel_slope, double airy_slope) {
    if (fan.empty()) return {nan, nan, nan, nan};
    // A ray at + slope z, over its depth: at/z + slope, a line over 1/z too. The width of a fan is therefore convex there, and
    // within the limit in one interval about its minimum.
    std::vector<Line> over_depth;
    for (const Line& l : fan) over_depth.push_back({l.slope, l.at});
    const auto width = [&](double per_mm) { return std::hypot(width_at(over_depth, per_mm).mm, airy_slope); };
    const auto rises = [&](double per_mm) { return width_at(over_depth, per_mm).per_mm > 0; };
    const auto sharp = [&](double per_mm) { return width(per_mm) <= pixel_slope; };
    const double best = rises(-most_per_mm) ? -most_per_mm : change(-most_per_mm, most_per_mm, rises);
    if (!sharp(best)) return {nan, nan, best, width(best)};
    return {sharp(most_per_mm) ? most_per_mm : change(most_per_mm, best, sharp),
            sharp(-most_per_mm) ? -most_per_mm : change(-most_per_mm, best, sharp), best, width(best)};
}

std::array<double, 2> quarter_wave_per_mm(double L, double D, double wavelength_mm) {
    const double most = 2 * wavelength_mm / (D * D);
    return {1 / L + most, 1 / L - most};
}

SharpDepths add_spot_depths(const Subject& s, Result& result) {
    const Theory& t = s.theory();
    const Geometry& g = s.geometry();
    const double D = widest_aperture_mm(g), wavelength_mm = s.options().wavelength_nm * 1e-6;
    const bool along_x = D == g.clear_aperture_mm[0];  // of the widest fan
    const Fans both = fans(LensTrace(s.display(), g), {0, 0}, depth_fan_rays);
    const Fan fan(along_x ? both.meridional : both.sagittal);
    Teller tell(s, result);
    const SharpDepths traced = where_sharp(fan.all, tell.pixel_slope());
    tell("spot", "spot no wider than a pixel's image, traced", fan, 0,
         "on the axis; theory is paraxial: where they differ the lens's aberrations are the cause");
    result.figures["spot_best_mm"] = number_json(depth_mm(traced.best_per_mm) + g.rear_principal_mm - g.vertex_plane_mm);
    result.figures["spot_least_pixel_images"] = number_json(traced.least_width / tell.pixel_slope());
    if (fan.all.empty())
        for (const char* name : {"spot_best_mm", "spot_least_pixel_images"}) result.note(name, "no light gets through the lens");
    if (s.display().diffuser) {
        const double z = *g.diffuser_z_mm - g.rear_principal_mm,
                     angle = diffuser_angle(s.display(), along_x ? Point{1, 0} : Point{0, 1});
        tell("spot_with_diffuser", "the same with the diffuser's widening", fan.diffused_at(z, angle), 0,
             "the diffuser widens a spot by its angle times the distance from it");
    }
    tell("spot_with_diffraction", fmt::format("the same with the Airy disk at {} nm", s.options().wavelength_nm), fan,
         2.44 * wavelength_mm / D, "2.44 wavelength z / D, added in quadrature");
    const auto [near, far] = quarter_wave_per_mm(t.central_depth_mm, D, wavelength_mm);
    const std::vector<double> wave = tell.ends_mm(near, far);
    result.figures["diffraction_quarter_wave_mm"] = numbers_json(wave);
    result.figures["diffraction_quarter_wave_diopters"] = numbers_json({1000 * near, 1000 * far});
    result.findings.push_back({"Depth of field: quarter of a wave, of a perfect lens",
                               "mm",
                               {},
                               wave,
                               "where defocus begins to show beside diffraction; pixels coarser than the Airy disk allow more"});
    return traced;
}

}  // namespace lfdsim
