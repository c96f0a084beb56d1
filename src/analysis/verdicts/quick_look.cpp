#include "analysis/verdicts/quick_look.h"

#include "analysis/core/eye_rays.h"
#include "analysis/crosstalk/intended_light.h"
#include "analysis/crosstalk/intended_theory.h"
#include "analysis/crosstalk/paraxial_lines.h"
#include "analysis/crosstalk/pixel_views.h"
#include "analysis/moire/eye_filter.h"
#include "analysis/moire/white_lines.h"
#include "analysis/spots/ray_fan.h"
#include "base/constants.h"
#include "geometry/seen_width.h"
#include "optics/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>
#include <vector>

namespace lfdsim {
namespace {

constexpr int lines_of_lens = 1024, lines_of_screen = 4096, lines_of_waves = 16384, rays_of_lens = 32, fan_of_lens = 65;
constexpr int fewest = 16;               // lines that are needed for a figure
constexpr std::uint32_t most_sets = 16;  // of as many lines each, if few get through
constexpr std::uint32_t most_sets_of_waves = 32;
constexpr double wave_error = 0.01;  // standard error of a colour wave's visible contrast; of stronger waves a tenth of it

/// Returns an eye at the camera's distance, display frame; nothing if that is inside the display.
std::optional<Vec3d> eye_before(const Display& d, const Geometry& g, double x = 0) {
    const double distance = camera_distance_mm(d);
    if (!(distance > nearest_eye_mm(g))) return {};
    return Vec3d{x, 0, distance};
}

/// Returns the width that holds the middle 95 % of positions, over 0.95: exact for evenly spread ones. NaN for too few.
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
    const std::size_t axis = axis_of_eyes(g);
    // The line from the eye through the nodal points of the lens at C meets the panel at e C, from where the display's axis meets
    // it. The part seen is measured from there.
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
                // Paraxial positions are from the array's centre, at the offset o: (seen + o) - e (axis + o)
                theory.push_back(along(line->seen) - e * along(line->axis) - (e - 1) * along(offset));
        }
    const double width = even_width(traced), through = seen_through_lens_mm(g, (*eye)[2] - g.rear_principal_mm);
    if (std::isnan(width)) return {};
    return SeenAtOnce{lfdsim::theory(d, g).along[axis].elemental_pitch_mm, {width, even_width(theory)}, through};
}

double zone_before_camera_mm(const Display& d, const Geometry& g) {
    return line_of_eyes(g.lattice) == 1 ? nan : viewing_zone_mm(d, g, camera_distance_mm(d) - g.rear_principal_mm);
}

std::optional<TracedAndTheory> between_eyes_percent(const Display& as_made, const Geometry& g) {
    Display d = as_made;
    d.content.viewing_distance_mm = camera_distance_mm(d);
    const std::optional<Vec3d> middle = eye_before(d, g);
    if (!middle || !(zone_before_camera_mm(d, g) >= usual_eye_separation_mm)) return {};
    const double distance = (*middle)[2];
    const MeantPanel panel(d, g, d.content.sampling);
    const EyePaths paths(d, g);
    const MeantTheory paraxial(d, g);
    const LineSets lines(lines_of_screen / (2 * independent_sets) * paths.more_for(*middle), 0);
    std::optional<TracedAndTheory> worse;
    for (const std::size_t side : {0u, 1u}) {
        const Vec3d eye{(double(side) - 0.5) * usual_eye_separation_mm, 0, distance};
        const auto percent = [&](const MeantLight& light) { return crosstalk_of(light, leak_of_side(light, side)).percent.value; };
        const double traced = percent({paths.look(eye, lines, EyePaths::Counting::by_lens), paths.weights(), panel});
        if (std::isnan(traced) || (worse && traced <= worse->traced)) continue;
        worse = {traced, percent({paraxial.look(eye, lines), {luminance_weights}, panel})};
    }
    return worse;
}

std::optional<LensBlur> blur(const Display& d, const Geometry& g, double stop_mm) {
    if (d.lens.type() == LensType::pinhole) return {};
    // Rays of the point on the axis: fans up to the rims for the full width, and a bundle of equal light for the variance. In
    // round lenses such rays stay in planes through the axis, so that each counts as a ray of the fan, too.
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
            const double out = (ray.x * ray.mx + ray.y * ray.my) / r;  // slope in the plane through the axis
            fan.insert(fan.end(), {{r, out}, {-r, -out}});
        }
    }
    if (fan.empty() || light.size() < fewest) return {};
    const double L = theory(d, g).central_depth_mm, per_mm = std::isinf(L) ? 0 : 1 / L,
                 pixel_slope = d.panel.pixel_pitch_mm / g.gap_mm;
    double squares = 0, from = infinity, to = -infinity;
    // At depth z a ray is at x + m z; over z, in the central depth plane, at x/L + m. There the image of a pixel is a/g wide.
    for (const FanRay& line : light) {
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

/// A wave of colours by theory, and what lines of sight find of it: the sum of their light times exp(-2 pi i f.r), and the sum of
/// its terms' squared moduli.
struct BeatSum {
    Beat beat;
    WhitePanel white;
    std::complex<double> sum = 0;
    double squares = 0;

    /// Adds a line to the point r of the vertex plane that ends at a position of the panel, in pixels.
    void add(const Vec3d& r, double column, double row, double light) {
        const double term = light * white.at(column, row);
        sum += term * std::polar(1., -2 * pi * (beat.frequency[0] * r[0] + beat.frequency[1] * r[1]));
        squares += term * term;
    }

    /// Returns the wave before an eye `away` mm from it, and the standard error of its visible contrast. `light`: of all lines.
    std::pair<ColourWave, double> found(double light, double away, double screen_mm) const {
        // The contrast of a wave is twice the amplitude of its Fourier component, over the mean. Where the period is more than
        // twice the screen's width, the screen has one tint, whose contrast is the mean itself. Chance adds the sum of the terms'
        // squares to the squared modulus of a sum of independent ones, and half of that is the variance of the modulus.
        const double period = period_mm(beat.frequency), fine = mm_per_degree(away) / period, filter = eye_for_colour.filter(fine);
        const bool uniform = period > 2 * screen_mm;
        const double per_sum = (uniform ? 1 : 2) / light, contrast = per_sum * std::sqrt(std::max(std::norm(sum) - squares, 0.));
        return {{uniform ? infinity : period,
                 direction_deg(beat.frequency),
                 fine,
                 contrast,
                 contrast * filter,
                 {beat.turned_per_rad[0] * degree, beat.turned_per_rad[1] * degree}},
                per_sum * std::sqrt(0.5 * squares) * filter};
    }
};

}  // namespace

std::optional<ColourWave> colour_wave(const Display& d, const Geometry& g) {
    const bool near = camera_distance_mm(d) < nearest_sight_mm;  // an eye right before the lenses sees through all of its pupil
    const std::optional<Vec3d> eye = eye_before(d, g, near ? 0 : -0.5 * usual_eye_separation_mm);
    if (!eye || d.panel.subpixels == SubpixelLayout::none) return {};
    // Red, and blue, less the luminance
    constexpr ChannelWeights mixtures[] = {{1 - luminance_weights[0], -luminance_weights[1], -luminance_weights[2]},
                                           {-luminance_weights[0], -luminance_weights[1], 1 - luminance_weights[2]}};
    std::vector<BeatSum> waves;
    for (const ChannelWeights& weights : mixtures)
        if (const auto beat = MoireTheory(d, g, (*eye)[2], weights).strongest(eye_for_colour))
            waves.push_back({*beat, WhitePanel(d.panel, weights)});
    if (waves.empty()) return {};

    // A line from any point of the pupil meets the line from the pupil's middle where the eye is focused.
    const double away = (*eye)[2] - g.vertex_plane_mm, focused = g.focus_distance_mm;
    const double pupil = d.camera.pupil_diameter_mm.value_or(near ? usual_pupil_mm : 0);
    const EyeRays rays(d, g);
    double light = 0;
    std::uint64_t line = 0;
    const auto add_line = [&](const Choice& c) {
        const Vec3d at = rays.aim(*eye, c);
        // The pupil's points are uniform over its disk.
        const double radius = 0.5 * pupil * std::sqrt(counted_random(line++)), turn = 2 * pi * counted_random(line++);
        const double x = (*eye)[0], to_focus = focused / away;
        const Vec3d in_pupil{x + radius * std::cos(turn), radius * std::sin(turn), (*eye)[2]},
            focus{x + (at[0] - x) * to_focus, at[1] * to_focus, (*eye)[2] - focused};
        const Sight s = pupil > 0 ? rays.look_through(in_pupil, focus, c[2], c[3]) : rays.look(*eye, c);
        if (!(s.light > 0)) return;
        light += s.light;
        const auto [column, row] = pixel_place(d.panel, s);
        for (BeatSum& w : waves) w.add(at, column, row, s.light);
    };
    std::optional<ColourWave> strongest;
    bool certain = false;
    for (std::uint32_t set = 0; set < most_sets_of_waves && !certain; ++set) {
        for (const Choice& c : even_choices(lines_of_waves, set)) add_line(c);
        if (!(light > 0)) continue;
        strongest.reset();
        certain = true;
        for (const BeatSum& w : waves) {
            const auto [wave, error] = w.found(light, away, std::min(g.panel_width_mm, g.array_width_mm));
            certain = certain && error <= std::max(wave_error, 0.1 * wave.visible);
            if (!strongest || wave.visible > strongest->visible) strongest = wave;
        }
    }
    return strongest;
}

}  // namespace lfdsim
