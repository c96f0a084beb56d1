// Depths of field of one lens, by tracing. docs/measures.md, "Depth of field by spot size".

#include "analysis/spots/spot_depth.h"

#include "analysis/core/estimate.h"
#include "analysis/core/figure_json.h"
#include "analysis/spots/lens_spots.h"
#include "base/bisection.h"
#include "base/constants.h"
#include "checks/depth_words.h"
#include "geometry/resolve.h"
#include "geometry/sharp_range.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

namespace lfdsim {
namespace {

constexpr double most_per_mm = 1e6;  // a nanometre in front of the lens
constexpr int depth_fan_rays = 1001;
constexpr double farthest_mm = 1e7;  // end of the search by the lens
constexpr int depth_halvings = 120;

/// Returns every third ray from `first` on, and both rims.
std::vector<FanRay> thinned(const std::vector<FanRay>& fan, std::size_t first) {
    std::vector<FanRay> third;
    for (std::size_t k = first; k < fan.size(); k += 3) third.push_back(fan[k]);
    if (!fan.empty()) third.insert(third.end(), {fan.front(), fan.back()});
    return third;
}

/// A fan, and its three thirds, from which errors follow.
struct Fan {
    explicit Fan(const std::vector<FanRay>& fan) : all(fan), thirds{thinned(fan, 0), thinned(fan, 1), thinned(fan, 2)} {}
    /// Returns the fan after the diffuser.
    Fan diffused_at(double z, double angle) const {
        Fan turned(*this);
        for (std::vector<FanRay>* lines : {&turned.all, &turned.thirds[0], &turned.thirds[1], &turned.thirds[2]})
            *lines = diffused(*lines, z, angle);
        return turned;
    }
    std::vector<FanRay> all;
    std::array<std::vector<FanRay>, 3> thirds;
};

/// Returns the errors of both ends by the finite number of rays. An end is determined by the outermost ray, which lies d <= h/2
/// beside the true one, h the step between rays, and misses it by k d^2, k the curvature. The third whose nearest ray is the next
/// but one misses it by k (h + d)^2: it differs from all rays together by k (h^2 + 2 h d), at least eight times as much.
std::array<double, 2> errors(const SharpDepths& all, const Fan& fan, double pixel_slope, double airy_slope) {
    constexpr double margin = 0.25;  // twice an eighth
    std::array<double, 2> most{1e-9 * std::abs(all.near_per_mm), 1e-9 * std::abs(all.far_per_mm)};
    for (const std::vector<FanRay>& third : fan.thirds) {
        const SharpDepths other = where_sharp(third, pixel_slope, airy_slope);
        most[0] = std::max(most[0], margin * std::abs(all.near_per_mm - other.near_per_mm));
        most[1] = std::max(most[1], margin * std::abs(all.far_per_mm - other.far_per_mm));
    }
    return most;
}

/// Writes depths of field: figures under a key, and a line of the report for each side of the lenses.
class Teller {
  public:
    Teller(const Subject& s, Result& result)
        : geometry_(s.geometry()),
          eye_mm_(camera_distance_mm(s.display())),
          pixel_slope_(s.display().panel.pixel_pitch_mm / s.geometry().gap_mm),
          result_(result) {}

    /// A traced range with its errors.
    struct MeasuredRange {
        SharpRange range, least, most;  // least, most: with the errors of both ends against it, and for it
        std::string missing;            // why there is no range at all
    };

    /// Adds a range under `key`; without a traced one, theory alone.
    void tell(const std::string& key, const std::string& what, const std::optional<MeasuredRange>& found, const SharpRange& theory,
              const std::string& remark) {
        Json& json = result_.figures[key];
        for (const bool in_front : {false, true}) {
            const std::string side = in_front ? "in_front_mm" : "behind_mm";
            const DepthSpan of_theory = in_front ? theory.in_front : theory.behind;
            FigureValue value;
            if (found) {
                const auto part = [&](const SharpRange& r) { return in_front ? r.in_front : r.behind; };
                const DepthSpan span = part(found->range), least = part(found->least), most = part(found->most);
                value = FigureValue(Estimate{span.low, error(span.low, least.low, most.low)},
                                    Estimate{span.high, error(span.high, least.high, most.high)});
                if (span.empty())
                    value.missing = !found->missing.empty() ? found->missing : "no depth on this side of the lenses is sharp";
                for (std::size_t k = 0; k < 2; ++k)
                    if (value.errors[k] > std::abs(value.numbers[k])) {
                        value.missing = fmt::format("an end at {:.4g} mm has an error of {:.2g} mm, which is larger",
                                                    value.numbers[k], value.errors[k]);
                        value.numbers[k] = value.errors[k] = nan;
                    }
                json[side] = span.empty() ? Json() : numbers_json(value.numbers);
                json[side + "_error"] = span.empty() ? Json() : numbers_json(value.errors);
                if (!value.missing.empty()) result_.note(key + "." + side, value.missing);
            }
            const FigureValue by_theory =
                of_theory.empty() ? FigureValue() : FigureValue(std::vector{of_theory.low, of_theory.high});
            result_.add(key + ".theory_" + side, of_theory.empty()
                                                     ? FigureValue::none("no depth on this side of the lenses is sharp by theory")
                                                     : by_theory);
            if (found || !of_theory.empty())
                result_.add_line(
                    value, {.label = fmt::format("Depth of field {}, {} the lenses", what, in_front ? "in front of" : "behind"),
                            .unit = "mm",
                            .theory = by_theory,
                            .remark = remark});
        }
    }

    /// Adds the depth of field by the pixel, and its ends in 1/z.
    void by_pixel(const std::string& key, const std::string& diopters, const std::string& what, const Fan& fan, double airy_slope,
                  const SharpRange& theory, const std::string& remark) {
        const SharpDepths depths = where_sharp(fan.all, pixel_slope_, airy_slope);
        MeasuredRange found;
        if (std::isnan(depths.near_per_mm)) {
            found.missing = fan.all.empty()
                                ? "no light of the panel's point on the axis gets through the lens"
                                : fmt::format(
                                      "the spot is nowhere as narrow as a panel pixel's image; it comes nearest to that {}, "
                                      "where it is {:.4g} pixel images wide",
                                      place(depths.best_per_mm), depths.least_width / pixel_slope_);
            result_.add(diopters, FigureValue::none(found.missing));
            found.range = found.least = found.most = range_of_inverse(geometry_, nan, nan, eye_mm_);
        } else {
            const std::array<double, 2> error = errors(depths, fan, pixel_slope_, airy_slope);
            const auto range = [&](double by) {
                return range_of_inverse(geometry_, depths.near_per_mm + by * error[0], depths.far_per_mm - by * error[1], eye_mm_);
            };
            found = {range(0), range(-1), range(1), {}};
            result_.add(diopters, {Estimate{1000 * depths.near_per_mm, 1000 * error[0]},
                                   Estimate{1000 * depths.far_per_mm, 1000 * error[1]}});
        }
        tell(key, what, found, theory, remark);
    }

    /// Adds the depth of field by the lens: the depths z where the fan is no wider than the pitch, or than where it leaves the
    /// lens.
    void by_lens(const Fan& fan, double pitch_mm, const SharpRange& theory) {
        MeasuredRange found;
        if (fan.all.empty()) {
            found.missing = "no light of the panel's point on the axis gets through the lens";
            found.range = found.least = found.most = range_between(geometry_, nan, nan, eye_mm_);
        } else {
            // An end within a millionth of the pitch is the lenses' plane, from which rounding moves it.
            const auto ends = [&](const std::vector<FanRay>& rays) {
                std::array<double, 2> z = where_narrow(rays, pitch_mm);
                for (double& end : z)
                    if (std::abs(end) < 1e-6 * pitch_mm) end = 0;
                return z;
            };
            const std::array<double, 2> all = ends(fan.all);
            std::array<double, 2> error{};
            for (std::size_t k = 0; k < 2; ++k)
                if (std::isfinite(all[k])) error[k] = 1e-9 * std::abs(all[k]);
            for (const std::vector<FanRay>& third : fan.thirds) {
                const std::array<double, 2> other = ends(third);
                for (std::size_t k = 0; k < 2; ++k)
                    if (std::isfinite(all[k])) error[k] = std::max(error[k], 0.25 * std::abs(all[k] - other[k]));  // as in errors()
            }
            const auto range = [&](double by) {
                return range_between(geometry_, all[0] - by * error[0], all[1] + by * error[1], eye_mm_);
            };
            found = {range(0), range(-1), range(1), {}};
        }
        tell("by_lens", "by the lens", found, theory,
             "where the spot is no wider than the lens pitch: there the lenses' pitch limits what is seen");
    }
    double pixel_slope() const { return pixel_slope_; }

  private:
    /// Returns the error of an end, from those of the least and the greatest range; an end at infinity has none.
    static double error(double at, double least, double most) {
        if (std::isinf(at) || std::isnan(at)) return std::isnan(at) ? nan : 0;
        double error = 0;
        for (const double other : {least, most}) error = std::max(error, std::isnan(other) ? std::abs(at) : std::abs(at - other));
        return error;
    }
    /// Returns a depth, given as 1/z from H', as text.
    std::string place(double per_mm) const {
        const double z = depth_mm(per_mm) + geometry_.rear_principal_mm - geometry_.vertex_plane_mm;
        return std::isinf(z) ? "at infinity" : depth_in_words(z);
    }

    const Geometry& geometry_;
    double eye_mm_, pixel_slope_;
    Result& result_;
};

}  // namespace

SharpDepths where_sharp(const std::vector<FanRay>& fan, double pixel_slope, double airy_slope) {
    if (fan.empty()) return {nan, nan, nan, nan};
    // A ray's position over its depth, at/z + slope, is a line over u = 1/z, too. The width of a fan is therefore convex in u,
    // and within the limit in one interval about its minimum.
    std::vector<FanRay> over_depth;
    for (const FanRay& l : fan) over_depth.push_back({l.slope, l.at});
    const auto width = [&](double per_mm) { return std::hypot(width_at(over_depth, per_mm).mm, airy_slope); };
    const auto rises = [&](double per_mm) { return width_at(over_depth, per_mm).per_mm > 0; };
    const auto sharp = [&](double per_mm) { return width(per_mm) <= pixel_slope; };
    const double best = rises(-most_per_mm) ? -most_per_mm : bisected(most_per_mm, -most_per_mm, depth_halvings, rises).in;
    if (!sharp(best)) return {nan, nan, best, width(best)};
    return {sharp(most_per_mm) ? most_per_mm : bisected(best, most_per_mm, depth_halvings, sharp).in,
            sharp(-most_per_mm) ? -most_per_mm : bisected(best, -most_per_mm, depth_halvings, sharp).in, best, width(best)};
}

std::array<double, 2> where_narrow(const std::vector<FanRay>& fan, double width_mm) {
    // The width is convex in z, so that it is within the limit in one interval, which contains 0 as the limit is not less than
    // the width there.
    const double limit = std::max(width_mm, width_at(fan, 0).mm) * (1 + 1e-12);
    const auto narrow = [&](double z) { return width_at(fan, z).mm <= limit; };
    std::array<double, 2> ends{};
    for (const int side : {-1, 1}) {
        double in = 0, out = side * 1e-3;
        while (narrow(out) && std::abs(out) < farthest_mm) in = out, out *= 2;
        ends[side < 0 ? 0 : 1] = narrow(out) ? side * infinity : bisected(in, out, depth_halvings, narrow).in;
    }
    return ends;
}

std::array<double, 2> quarter_wave_per_mm(double L, double D, double wavelength_mm) {
    const double most = 2 * wavelength_mm / (D * D);
    return {1 / L + most, 1 / L - most};
}

SharpDepths add_spot_depths(const Subject& s, Result& result) {
    const Theory& t = s.theory();
    const Geometry& g = s.geometry();
    const double D = widest_aperture_mm(g), wavelength_mm = s.options().wavelength_nm * 1e-6;
    // Depths stated as sharp are sharp along both axes. A pixel is as wide along both: its fan is that of the wider clear aperture.
    const bool along_x = D == g.clear_aperture_mm[0];
    const Fans both = fans(LensTrace(s.display(), g), {0, 0}, depth_fan_rays);
    const Fan fan(along_x ? both.meridional : both.sagittal);
    const double eye = camera_distance_mm(s.display());
    const SharpRange by_pixel = sharp_by_pixel(g, t, eye);
    Teller tell(s, result);
    const SharpDepths traced = where_sharp(fan.all, tell.pixel_slope());
    const std::size_t tighter = tighter_axis(g);
    tell.by_lens(Fan(tighter == 0 ? both.meridional : both.sagittal), lens_pitch_mm(g, tighter), sharp_by_lens(g, t, eye));
    tell.by_pixel("by_pixel", "spot_diopters", "by the pixel", fan, 0, by_pixel,
                  "where the traced spot of a panel point on the axis is no wider than a pixel's image; theory is paraxial, so "
                  "differences come from the lens's aberrations");
    result.add("spot_best_mm", depth_mm(traced.best_per_mm) + g.rear_principal_mm - g.vertex_plane_mm);
    result.add("spot_least_pixel_images", traced.least_width / tell.pixel_slope());
    if (fan.all.empty())
        for (const char* name : {"spot_best_mm", "spot_least_pixel_images"}) result.note(name, "no light gets through the lens");
    if (s.display().diffuser) {
        const double z = *g.diffuser_z_mm - g.rear_principal_mm,
                     angle = diffuser_angle(s.display(), g, along_x ? Point{1, 0} : Point{0, 1});
        tell.by_pixel("by_pixel_with_diffuser", "spot_with_diffuser_diopters", "by the pixel, with the diffuser's widening",
                      fan.diffused_at(z, angle), 0, by_pixel, "the diffuser widens a spot by its angle times the distance from it");
    }
    tell.by_pixel("by_pixel_with_diffraction", "spot_with_diffraction_diopters",
                  fmt::format("by the pixel, with the Airy disk at {} nm", s.options().wavelength_nm), fan,
                  2.44 * wavelength_mm / D, by_pixel, "2.44 wavelength z / D, added in quadrature");
    const auto [near, far] = quarter_wave_per_mm(t.central_depth_mm, D, wavelength_mm);
    result.add("diffraction_quarter_wave_diopters", std::vector{1000 * near, 1000 * far});
    tell.tell("by_quarter_wave", "by a quarter of a wave, for a perfect lens", {}, range_of_inverse(g, near, far, eye),
              "where defocus becomes visible beside diffraction; pixels larger than the Airy disk allow more");
    note_left_out_errors(s, result);
    return traced;
}

}  // namespace lfdsim
