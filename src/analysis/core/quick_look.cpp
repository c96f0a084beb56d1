#include "analysis/core/quick_look.h"

#include "analysis/core/eye_rays.h"
#include "analysis/crosstalk/paraxial_lines.h"
#include "analysis/moire/eye_filter.h"
#include "analysis/moire/white_lines.h"
#include "analysis/spots/ray_fan.h"
#include "base/constants.h"
#include "content/pickup/pickup.h"
#include "optics/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <vector>

namespace lfdsim {
namespace {

constexpr int lines_of_lens = 1024, lines_of_screen = 4096, lines_of_waves = 16384, rays_of_lens = 32, fan_of_lens = 65;
constexpr double middle_share = 0.95;
constexpr int fewest = 16;               // lines that tell anything
constexpr std::uint32_t most_sets = 16;  // of as many lines, where few get through

std::optional<Vec3d> eye_before(const Display& d, const Geometry& g, double x = 0) {
    const double distance = eye_distance_mm(d);
    if (!(distance > nearest_eye_mm(g))) return {};
    return Vec3d{x, 0, distance};
}

/// The width that holds the middle of places, as if they lay evenly over it.
double even_width(std::vector<double>& places) {
    if (places.size() < fewest) return nan;
    std::ranges::sort(places);
    const auto at = [&](double share) {
        const double rank = share * double(places.size() - 1);
        const std::size_t low = std::size_t(rank), high = std::min(low + 1, places.size() - 1);
        return places[low] + (rank - double(low)) * (places[high] - places[low]);
    };
    return (at(0.5 + middle_share / 2) - at(0.5 - middle_share / 2)) / middle_share;
}

}  // namespace

std::optional<SeenAtOnce> seen_at_once(const Display& d, const Geometry& g) {
    const std::optional<Vec3d> eye = eye_before(d, g);
    if (!eye) return {};
    const Lattice<double>& l = g.lattice;
    const std::size_t axis = !l.strips && std::abs(l.cos_turn) < std::abs(l.sin_turn) ? 1 : 0;
    // The line from the eye through the nodal points of the lens at C ends on the panel at e C, from where the display's axis meets
    // it.
    const double e = 1 + g.gap_mm / ((*eye)[2] - g.rear_principal_mm);
    const optics::Vec2<double> offset = optics::to_array(l, l.offset[0], l.offset[1]);
    const auto along = [&](const optics::Vec2<double>& p) { return axis == 0 ? p.x : p.y; };
    const EyeRays rays(d, g);
    const ParaxialLines paraxial(d, g, *eye);
    std::vector<double> traced, theory;
    for (std::uint32_t set = 0; set < most_sets && traced.size() < lines_of_lens / 2; ++set)
        for (Choice c : even_choices(lines_of_lens, set)) {
            c[4] = c[5] = 1e-9;  // the lens in the middle
            if (const Sight s = rays.look(*eye, c); s.light > 0 && s.by_lens)
                traced.push_back(along(optics::to_array(l, s.x - e * s.lens[0], s.y - e * s.lens[1])));
            const Vec3d aim = rays.aim(*eye, c);
            if (const auto line = paraxial.look(aim[0], aim[1], c[2], c[3]); line && line->through)
                theory.push_back(along(line->seen) - e * along(line->axis) - (e - 1) * along(offset));
        }
    const double power = std::isfinite(g.focal_length_mm) ? g.gap_mm / g.focal_length_mm : 0, width = even_width(traced),
                 through = g.clear_aperture_mm[axis] * std::abs(e - power);
    if (std::isnan(width)) return {};
    return SeenAtOnce{lfdsim::theory(d, g).along[axis].elemental_pitch_mm, {width, even_width(theory)}, through};
}

std::optional<TracedAndTheory> between_eyes_percent(const Display& as_made, const Geometry& g) {
    Display d = as_made;
    d.content.viewing_distance_mm = eye_distance_mm(d);
    const std::optional<Vec3d> eye = eye_before(d, g, -0.5 * usual_eyes_apart_mm);
    if (!eye) return {};
    const Lattice<double>& l = g.lattice;
    const double image_mm = theory(d, g).along[0].elemental_pitch_mm / (l.strips ? l.cos_turn : 1);
    if (!(((*eye)[2] - g.rear_principal_mm) * image_mm / g.gap_mm >= usual_eyes_apart_mm)) return {};
    const EyeRays rays(d, g);
    const ParaxialLines paraxial(d, g, *eye);
    const Pickup pickup(d, g);
    const double per_mm = (pickup.scale - 1) / g.gap_mm;  // 1/D' of the viewer that the elemental images are made for
    // Light of the own eye's image and of the other eye's.
    struct CrosstalkSums {
        double own = 0, other = 0;
        int lines = 0;
        double percent() const { return own > 0 ? 100 * other / own : other > 0 ? infinity : nan; }
    } traced, in_theory;
    // A viewer at x is meant to see the slope x/D' of the lines through the lenses, counted from the screen's middle.
    const auto add = [&](CrosstalkSums& light, double x, double y, double much) {
        const NodalLine line = pickup.line(x, y);
        if (!line.owned) return;
        const double mx = line.mx + line.x * per_mm, my = line.my + line.y * per_mm;
        ((l.strips ? optics::to_array(l, mx, my).x : mx) < 0 ? light.own : light.other) += much;
        ++light.lines;
    };
    for (std::uint32_t set = 0; set < most_sets && traced.lines < lines_of_screen / 2; ++set)
        for (const Choice& c : even_choices(lines_of_screen, set)) {
            if (const Sight s = rays.look(*eye, c); s.light > 0 && s.by_lens) add(traced, s.x, s.y, s.light);
            const Vec3d aim = rays.aim(*eye, c);
            const auto line = paraxial.look(aim[0], aim[1], c[2], c[3]);
            if (!line || !line->through || !paraxial.on_panel(line->seen)) continue;
            const auto seen = optics::in_display(l, line->seen);
            add(in_theory, seen.x, seen.y, 1);
        }
    if (traced.lines < fewest) return {};
    return TracedAndTheory{traced.percent(), in_theory.percent()};
}

std::optional<LensBlur> blur(const Display& d, const Geometry& g, double stop_mm) {
    if (d.lens.type() == LensType::pinhole) return {};
    const LensTrace lens(d, g);
    Fans rims = fans(lens, {0, 0}, fan_of_lens);
    std::vector<FanRay> fan = std::move(rims.meridional), light;
    if (g.lattice.strips) {  // steep light along strips, which no eye sees, meets them as if they were stronger
        std::erase_if(fan, [&](const FanRay& line) { return !(std::abs(line.at) <= stop_mm); });
        light = fan;
    } else {
        fan.insert(fan.end(), rims.sagittal.begin(), rims.sagittal.end());
        std::erase_if(fan, [&](const FanRay& line) { return !(std::abs(line.at) <= stop_mm); });
        for (const LensRay& ray : bundle(lens, {0, 0}, rays_of_lens).rays) {
            const double r = std::hypot(ray.x, ray.y);
            if (!(r <= stop_mm)) continue;
            light.push_back({ray.x, ray.mx});
            if (!(r > 0)) continue;
            const double out = (ray.x * ray.mx + ray.y * ray.my) / r;  // rays of a point on the axis stay in planes through it
            fan.insert(fan.end(), {{r, out}, {-r, -out}});
        }
    }
    if (fan.empty() || light.size() < fewest) return {};
    const double L = theory(d, g).central_depth_mm, per_mm = std::isinf(L) ? 0 : 1 / L,
                 pixel_slope = d.panel.pixel_pitch_mm / g.gap_mm;
    double squares = 0, from = infinity, to = -infinity;
    for (const FanRay& line : light) {  // over its depth z a ray passes at x/z + m
        const double at = line.at * per_mm + line.slope;
        squares += at * at;
    }
    for (const FanRay& line : fan) {
        from = std::min(from, line.at * per_mm + line.slope);
        to = std::max(to, line.at * per_mm + line.slope);
    }
    return LensBlur{std::sqrt(12 * squares / double(light.size())) / pixel_slope, (to - from) / pixel_slope,
                    where_sharp(fan, pixel_slope)};
}

namespace {

constexpr double usual_pupil_mm = 4, near_eye_mm = 250;  // an eye right before the lenses sees through all of its pupil

}  // namespace

std::optional<ColourWave> colour_wave(const Display& d, const Geometry& g) {
    const bool near = eye_distance_mm(d) < near_eye_mm;
    const std::optional<Vec3d> eye = eye_before(d, g, near ? 0 : -0.5 * usual_eyes_apart_mm);
    if (!eye || d.panel.subpixels == SubpixelLayout::none) return {};
    constexpr ChannelWeights mixtures[] = {{1 - luminance_weights[0], -luminance_weights[1], -luminance_weights[2]},
                                           {-luminance_weights[0], -luminance_weights[1], 1 - luminance_weights[2]}};
    // A beat by theory and the traced light's sum at its frequency.
    struct BeatSum {
        Beat beat;
        WhitePanel white;
        std::complex<double> sum = 0;
    };
    std::vector<BeatSum> waves;
    for (const ChannelWeights& weights : mixtures)
        if (const auto beat = MoireTheory(d, g, (*eye)[2], weights).strongest(eye_for_colour))
            waves.push_back({*beat, WhitePanel(d.panel, weights)});
    if (waves.empty()) return {};

    // Where the eye is focused a line from any place in its pupil meets the line from the pupil's middle.
    const double away = (*eye)[2] - g.vertex_plane_mm, focused = g.focus_distance_mm;
    const double pupil = d.camera.pupil_diameter_mm.value_or(near ? usual_pupil_mm : 0);
    const EyeRays rays(d, g);
    double light = 0;
    std::uint64_t line = 0;
    for (const Choice& c : even_choices(lines_of_waves)) {
        const Vec3d at = rays.aim(*eye, c);
        const double radius = 0.5 * pupil * std::sqrt(counted_random(line++)), turn = 2 * pi * counted_random(line++);
        const double x = (*eye)[0], to_focus = focused / away;
        const Vec3d in_pupil{x + radius * std::cos(turn), radius * std::sin(turn), (*eye)[2]},
            focus{x + (at[0] - x) * to_focus, at[1] * to_focus, (*eye)[2] - focused};
        const Sight s = pupil > 0 ? rays.look_through(in_pupil, focus, c[2], c[3]) : rays.look(*eye, c);
        if (!(s.light > 0)) continue;
        light += s.light;
        const double column = s.x / d.panel.pixel_pitch_mm + 0.5 * double(d.panel.pixels[0]),
                     row = 0.5 * double(d.panel.pixels[1]) - s.y / d.panel.pixel_pitch_mm;
        for (BeatSum& w : waves)
            w.sum += s.light * w.white.at(column, row) *
                     std::polar(1., -2 * pi * (w.beat.frequency[0] * at[0] + w.beat.frequency[1] * at[1]));
    }
    if (!(light > 0)) return {};
    std::optional<ColourWave> strongest;
    for (const BeatSum& w : waves) {
        const bool uniform = period_mm(w.beat.frequency) > 2 * std::min(g.panel_width_mm, g.array_width_mm);
        const double fine = mm_per_degree(away) / period_mm(w.beat.frequency),
                     contrast = (uniform ? 1 : 2) * std::abs(w.sum) / light;
        const ColourWave wave{uniform ? infinity : period_mm(w.beat.frequency),
                              direction_deg(w.beat.frequency),
                              fine,
                              contrast,
                              contrast * eye_for_colour.filter(fine),
                              {w.beat.turned_per_rad[0] * degree, w.beat.turned_per_rad[1] * degree}};
        if (!strongest || wave.visible > strongest->visible) strongest = wave;
    }
    return strongest;
}

}  // namespace lfdsim
