#include "checks/first_order.h"

#include "base/constants.h"
#include "base/input_error.h"
#include "display/keys.h"
#include "geometry/geometry.h"
#include "geometry/lattice.h"
#include "geometry/prescription.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace lfdsim {

double to_nanometre(double mm) { return std::round(mm * 1e6) / 1e6; }
double to_picometre(double mm) { return std::round(mm * 1e9) / 1e9; }

double rounded(double x) {
    const double unit = std::pow(10, std::floor(std::log10(std::abs(x))) - 2);
    return unit < 1 ? std::round(x / unit) / std::round(1 / unit) : std::round(x / unit) * unit;
}

namespace {

// The allowed values of a design request, by option.
struct DesignLimit {
    double DesignRequest::*field;
    const char* name;
    Range range;
};
constexpr DesignLimit limits[] = {
    {&DesignRequest::panel_inch, "--panel-inch", {0.1, 2000}},
    {&DesignRequest::fov_deg, "--fov-deg", {1, 120}},
    {&DesignRequest::distance_mm, "--distance-mm", {5, 1e5}},
};
constexpr Range depth_range{-1e6, 1e6}, pixel_range{fewest_views * fewest_lenses, 1e5}, views_range{2, 1e4}, pitch_range{1e-3, 1e4};

/// Returns a problem for each value of a request that is out of range or contradicts another one, with its option as `where`.
std::vector<Problem> out_of_range(const DesignRequest& r) {
    std::vector<Problem> all;
    const auto check = [&](const char* name, double value, const Range& range) {
        if (!range.contains(value)) all.push_back({name, fmt::format("is {}; allowed is {}", value, range.text())});
    };
    for (const DesignLimit& l : limits) check(l.name, r.*l.field, l.range);
    for (const std::int64_t n : r.pixels)
        if (all.empty() || all.back().where != "--pixels") check("--pixels", double(n), pixel_range);
    if (r.depth_mm) check("--depth-mm", *r.depth_mm, depth_range);
    if (r.views) check("--views", double(*r.views), views_range);
    if (r.pitch_mm) check("--pitch-mm", *r.pitch_mm, pitch_range);
    if (r.views && r.pitch_mm) all.push_back({"--views, --pitch-mm", "both determine the lenses' pitch; give one of them"});
    if (r.lens == LensType::surfaces) all.push_back({"--lens", "is surfaces; allowed are plano_convex and ideal"});
    return all;
}

/// Returns L, the depth of the central depth plane, mm from the lenses, where none is requested: a tenth of the viewing distance
/// in front of them; for an eye too near to see the lenses sharply, a metre behind them, or `longest`, mm, if that is less.
double chosen_depth_mm(const DesignRequest& r, double longest) {
    return r.distance_mm < nearest_sight_mm ? -std::min(1000., std::floor(longest)) : rounded(r.distance_mm / 10);
}

/// Returns N, the panel pixels behind a lens of the pitch N a, and the rule that determines it; a is the pixel pitch, mm. Seen
/// from the eye, a lens and the image of a pixel in the central depth plane are to be equally wide, p/E = P_I/(E - L). With P_I =
/// a |L|/g and g about p/(2 tan(FOV/2)) that is p^2 = 2 a |L| tan(FOV/2) E/(E - L). E is the distance from the panel, since H' is
/// not known yet.
std::pair<int, PitchRule> views(const DesignRequest& r, double a, double L) {
    if (r.views) return {int(*r.views), PitchRule::asked};
    if (r.pitch_mm) return {int(std::lround(*r.pitch_mm / a)), PitchRule::asked};
    const double E = r.distance_mm, slope = std::tan(r.fov_deg * degree / 2), far = E / (E - L);
    const bool near_eye = E < nearest_sight_mm;
    const double pitch = near_eye ? usual_pupil_mm / 2 : std::sqrt(2 * slope * a * std::abs(L) * far);
    const double most = std::floor(double(std::min(r.pixels[0], r.pixels[1])) / fewest_lenses), N = std::round(pitch / a);
    if (N > most) return {int(most), PitchRule::lenses};
    if (N < fewest_views) return {fewest_views, PitchRule::views};
    return {int(N), near_eye ? PitchRule::pupil : PitchRule::balanced};
}

/// Returns the radius r of the lens, mm, and what limits it: the cell; r <= 0.9 R; and a blur by spherical aberration, K
/// (2r/f)^3, of at most `pixel_angle` = a/g, radians.
std::pair<double, ApertureRule> aperture(double pitch, double R, double f, double pixel_angle) {
    const double cell = pitch / 2, sphere = 0.9 * R, sharp = f / 2 * std::cbrt(pixel_angle / spherical_blur);
    if (cell <= sphere && cell <= sharp) return {cell, ApertureRule::cell};
    return sphere < sharp ? std::pair{sphere, ApertureRule::sphere} : std::pair{sharp, ApertureRule::aberration};
}

/// Finds lens and gap for the field of view and the central depth plane L: g = 1/(2 tan(FOV/2)/p - 1/E) and f = 1/(1/g + 1/L),
/// with E = D' - z_H'. z_H' exceeds g by the distance between the principal planes, which depends on the lens: the iteration
/// alternates between both. If there is no such gap, gap_mm becomes 0 or what the last round had.
void place_lenses(FirstOrder& o, double L) {
    const DesignRequest& r = o.request;
    PlanoConvex lens;
    LensArray& array = o.display.array;
    const double p = array.pitch_mm[0], slope = std::tan(r.fov_deg * degree / 2);
    double apart = 0, gap = 0;  // apart: from H to H'; gap: g
    for (int round = 0; round < 60; ++round) {
        const double before = r.distance_mm - apart;  // D' - z_H' = before - g
        // 1/g + 1/(before - g) = 2 tan(FOV/2)/p =: k, so that k g^2 - k before g + before = 0; the root nearer to the panel.
        const double k = 2 * slope / p, root = k * k * before * before - 4 * k * before;
        if (!(before > 0 && root >= 0)) break;
        gap = 2 * before / (k * before + std::sqrt(root));
        const double f = 1 / (1 / gap + 1 / L);
        if (r.lens == LensType::ideal) break;
        const double R = f * (pmma_index - 1), h = std::min(p, gap) / 4;
        if (!(R > 0)) break;
        const auto [radius, rule] = aperture(p, R, f, o.display.panel.pixel_pitch_mm / gap);
        o.aperture_rule = rule;
        lens.sphere_radius_mm = to_nanometre(R);
        lens.aperture_radius_mm = std::floor(radius * 1e6) / 1e6;
        lens.cylinder_height_mm = rounded(h);
        // T = h + R - sqrt(R^2 - r^2); with the flat face to the panel H is at T/n and H' at the apex, T (1 - 1/n) apart
        const double thickness = lens.cylinder_height_mm + R - std::sqrt((R - radius) * (R + radius));
        apart = thickness * (1 - 1 / pmma_index);
    }
    array.gap_mm = to_nanometre(gap);
    o.eye_mm = r.distance_mm - apart - gap;
    if (r.lens == LensType::ideal) {
        o.display.lens.kind = IdealLens{{}, to_nanometre(1 / (1 / gap + 1 / L))};
        array.aperture = Aperture::cell;
        o.aperture_rule = ApertureRule::cell;
    } else {
        lens.index = pmma_index;
        o.display.lens.kind = lens;
    }
}

/// Fills in the design for a request whose values are in range. Returns why the request cannot be met, if so; the display is then
/// filled in as far as that point.
std::optional<Problem> design(FirstOrder& o) {
    DesignRequest& r = o.request;
    // The panel: square pixels, a = 25.4 mm/inch x diagonal / sqrt(columns^2 + rows^2)
    const double a = to_nanometre(25.4 * r.panel_inch / std::hypot(double(r.pixels[0]), double(r.pixels[1])));
    Display& d = o.display;
    d.panel.pixels = r.pixels;
    d.panel.pixel_pitch_mm = a;
    const double width = double(r.pixels[0]) * a, height = double(r.pixels[1]) * a, D = r.distance_mm;
    const double longest = 50 * std::max(D, height);  // beyond it the central depth plane is practically at infinity
    if (!r.depth_mm) r.depth_mm = chosen_depth_mm(r, longest);
    const double L = *r.depth_mm;
    if (L > D / 2) return Problem{"--depth-mm", fmt::format("is {:g}, more than half of the way to the eye", L)};
    if (L < -longest) return Problem{"--depth-mm", fmt::format("is {:g}, which is practically infinity", L)};
    // The lens pitch, by rule or as requested
    o.near_eye = D < nearest_sight_mm;
    std::tie(o.views, o.pitch_rule) = views(r, a, L);
    d.array.lattice = r.lattice;
    d.array.pitch_mm = to_nanometre(r.pitch_mm.value_or(o.views * a));
    if (o.pitch_rule == PitchRule::asked) {
        const char* const option = r.views ? "--views" : "--pitch-mm";
        const double pitch_mm = d.array.pitch_mm[0], side_mm = double(std::min(r.pixels[0], r.pixels[1])) * a;
        if (pitch_mm < 1.999 * a)
            return Problem{option, fmt::format("is {:g}, less than two pixels of {:.4g} mm behind a lens", pitch_mm, a)};
        if (pitch_mm * fewest_lenses > side_mm)
            return Problem{option, fmt::format("makes lenses of {:.4g} mm, wider than 1/{} of the panel's shorter side, {:.4g} mm",
                                               pitch_mm, fewest_lenses, side_mm)};
    }
    place_lenses(o, L);

    // Designs that cannot be built or used: parts more than a quarter of the way to the eye, an image plane at the lenses, narrow
    // lenses
    const double p = d.array.pitch_mm[0], g = *d.array.gap_mm, z_r = D - o.eye_mm;
    if (!(g > 0 && g <= D / 4))
        return Problem{"--fov-deg", fmt::format("is {:g}, which would need lenses of {:.4g} mm for an eye at {:g} mm, more than a "
                                                "quarter of the way to it from the panel",
                                                r.fov_deg, p, D)};
    if (std::abs(L) < 2 * g) return Problem{"--depth-mm", fmt::format("is {:g}, less than twice the gap of {:.4g} mm", L, g)};
    if (r.lens == LensType::plano_convex && *d.lens.as<PlanoConvex>().aperture_radius_mm < p / 6)
        return Problem{"--fov-deg", fmt::format("is {:g}, for which a spherical lens of index {} must be narrower than a third of "
                                                "its pitch; --lens ideal does not have this limit",
                                                r.fov_deg, pmma_index)};

    // As many lenses as have whole elemental images, of the pitch p (1 + g/E), on the panel. Rows of hexagons alternate by half a
    // pitch, and the corners of hexagons extend beyond the first and the last row.
    const double across = width / (1 + g / o.eye_mm), along = height / (1 + g / o.eye_mm);
    std::array<double, 2> fit{across / p, along / p};
    if (r.lattice == LatticeKind::hexagon)
        fit = {across / p - 0.5, 1 + (along - 2 * outer_radius_mm(d.array)) / spacing_mm(d.panel, d.array)[1]};
    d.array.count.emplace();
    for (std::size_t k = 0; k < 2; ++k) (*d.array.count)[k] = std::max<std::int64_t>(1, std::int64_t(fit[k] + 1e-6));

    // The frame, in the panel's plane, is 1.05 times as wide as the display appears at H'. Near eyes get a pupil, which joins the
    // lenses' light, in place of a diffuser; a diffuser has omega = 2 atan(p/2d), upwards of hexagons with their rows' distance
    // as p.
    d.camera.position_mm = {0, 0, D};
    d.camera.frame_width_mm = rounded(1.05 * std::max(width, height * 16 / 9) * D / o.eye_mm);
    d.camera.resolution = {1280, 720};
    if (o.near_eye) {
        d.camera.resolution = {640, 360};
        d.camera.pupil_diameter_mm = usual_pupil_mm;
        d.camera.focus_distance_mm = rounded(D - z_r - L);
    } else {
        Diffuser& diffuser = d.diffuser.emplace();
        diffuser.distance_mm = L > 0 ? L : rounded(std::min(-L, D / 4));
        const std::array<double, 2> spacing = spacing_mm(d.panel, d.array);
        for (const std::size_t k : {0u, 1u})
            diffuser.angle_deg[k] = rounded(2 * std::atan(spacing[k] / (2 * diffuser.distance_mm)) / degree);
    }
    d.content.depth_mm = L;
    // The content appears half as high as the panel from the eye, but is no higher than |L|, since it may be as deep as it is
    // high.
    d.content.height_mm = rounded(std::min(height / 2 * (o.eye_mm - L) / o.eye_mm, std::abs(L)));
    d.content.viewing_distance_mm = D;
    if (const std::vector<Problem> problems = validate(d); !problems.empty())
        return Problem{"--distance-mm",
                       fmt::format("is {:g}, which gives no valid display: {} {}", D, problems[0].where, problems[0].what)};
    o.theory = theory(d, resolve_unchecked(d));
    return {};
}

/// Returns whether a request can be met.
bool possible(DesignRequest r) {
    FirstOrder o{};
    o.request = r;
    return out_of_range(r).empty() && !design(o);
}

/// Returns, as text, the nearest possible value of each option with all others unchanged, to about 1 %; empty if there is none
/// within a factor of 10^6.
std::string nearest(const DesignRequest& request) {
    std::string text;
    const auto seek = [&](const char* name, auto value_of) {
        for (int step = 1; step <= 1400; ++step)
            for (const double factor : {std::pow(1.01, step), std::pow(1.01, -step)}) {
                DesignRequest r = request;
                const double value = value_of(r) = rounded(value_of(r) * factor);
                if (!possible(r)) continue;
                text += fmt::format("{}{} {:g}", text.empty() ? "" : ", or ", name, value);
                return;
            }
    };
    seek("--fov-deg", [](DesignRequest& r) -> double& { return r.fov_deg; });
    seek("--distance-mm", [](DesignRequest& r) -> double& { return r.distance_mm; });
    if (request.depth_mm) seek("--depth-mm", [](DesignRequest& r) -> double& { return *r.depth_mm; });
    return text;
}

}  // namespace

FirstOrder first_order(const DesignRequest& request) {
    if (std::vector<Problem> problems = out_of_range(request); !problems.empty()) throw InputError(std::move(problems));
    FirstOrder o{};
    o.request = request;
    if (const std::optional<Problem> p = design(o)) {
        const std::string others = nearest(request);
        throw InputError(p->where, p->what + (others.empty() ? "; changing a single value does not make it possible"
                                                             : "; nearest possible: " + others));
    }
    return o;
}

}  // namespace lfdsim
