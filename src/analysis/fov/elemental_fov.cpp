#include "analysis/fov/elemental_fov.h"

#include "analysis/core/estimate.h"
#include "base/constants.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double share_error = 0.005;  // the share is not known more accurately than to this, about one half
// Each of the sets has first_rays lines, times up to most_growth; the bracket is found with coarse_rays.
constexpr int sets = 4, first_rays = 1024, coarse_rays = 512, most_growth = 64;

/// Mirrors lines of sight along an axis for the other side: a symmetric display then has the same share there to the last bit.
void mirror(std::vector<Choice>& choices, int axis) {
    for (Choice& c : choices)
        for (const std::size_t k : {0u, 2u, 4u}) c[k + std::size_t(axis)] = -c[k + std::size_t(axis)];
}

}  // namespace

OwnLens::OwnLens(Display display, bool with_diffuser)
    : display_([&] {
          if (!with_diffuser) display.diffuser.reset();
          display.panel.emission_exponent = 0;
          return std::move(display);
      }()),
      geometry_(resolve(display_)),
      rays_(display_, geometry_),
      pickup_(display_, geometry_),
      half_image_mm_{pickup_.lattice().half_pitch[0] * pickup_.scale,
                     pickup_.lattice().strips ? 0 : optics::reach_of_cell(pickup_.lattice()) * pickup_.scale} {}

bool OwnLens::is_whole(double x, double y) const {
    // The half sides of the image's bounding box in the display's frame
    const double c = std::abs(pickup_.lattice().cos_turn), s = std::abs(pickup_.lattice().sin_turn);
    const auto [half_x, half_y] = half_image_mm_;
    return std::abs(x) + half_x * c + half_y * s <= 0.5 * geometry_.panel_width_mm + 1e-9 * half_x &&
           std::abs(y) + half_x * s + half_y * c <= 0.5 * geometry_.panel_height_mm + 1e-9 * half_y;
}

std::int64_t OwnLens::whole_images() const {
    std::int64_t whole = 0;
    const Lattice<double>& lattice = pickup_.lattice();
    for (double j = 0; j < lattice.count[1]; ++j)
        for (double i = 0; i < lattice.count[0]; ++i) {
            const auto centre = pickup_.image_centre({i, j});
            whole += is_whole(centre.x, centre.y);
        }
    return whole;
}

double OwnLens::share(const Vec3d& eye, std::span<const Choice> choices) const {
    double own = 0, all = 0;
    for (const Choice& choice : choices) {
        const Sight sight = rays_.look_through(eye, rays_.aim(eye, choice), choice[2], choice[3]);
        if (!(sight.light > 0 && sight.by_lens)) continue;
        const Lattice<double>& lattice = pickup_.lattice();
        const auto [x, y] = pickup_.image_centre_beside(sight.cell, sight.x, sight.y);
        const auto off = optics::to_array(lattice, sight.x - x, sight.y - y);
        if (!is_whole(x, y)) continue;
        all += sight.light;
        if (optics::in_cell(lattice, off.x / pickup_.scale, off.y / pickup_.scale)) own += sight.light;
    }
    return all > 0 ? own / all : nan;
}

namespace {

/// Two positions on one side between which the share falls below one half, by few lines of sight; or why there are none.
struct Bracket {
    double in = nan, out = nan;
    std::string missing;
};

/// Finds the bracket by steps from the middle.
Bracket bracket(const OwnLens& lens, const EyePath& path, int side, std::span<const Choice> choices) {
    const double middle = lens.share(path.eye(0), choices);
    if (std::isnan(middle)) return {nan, nan, "no light of lenses whose whole elemental image lies on the panel is seen"};
    if (middle < 0.5)
        return {nan, nan,
                fmt::format("the share is only {:.2f} in the middle: elemental images are made for a distance other than the "
                            "eye's, or for another array",
                            middle)};
    for (double in = 0; in < path.most;) {
        const double out = std::min(in + path.step, path.most), share = lens.share(path.eye(side * out), choices);
        if (std::isnan(share)) return {nan, nan, fmt::format("no light is seen from {:.4g} on, before the share falls", out)};
        if (share < 0.5) return {in, out, {}};
        in = out;
    }
    return {nan, nan, fmt::format("the share stays above one half up to {:.4g}, where the search ends", path.most)};
}

/// Returns the position at which the share falls below a level, to `precision`, by bisection of the bracket; if the share by
/// these lines falls outside of it, the bracket is extended in steps first.
double falls_to(double level, const OwnLens& lens, const EyePath& path, int side, Bracket b, double precision,
                std::span<const Choice> choices) {
    const auto own = [&](double at) { return lens.share(path.eye(side * at), choices) >= level; };
    while (b.in > 0 && !own(b.in)) b.in = std::max(b.in - path.step, 0.);
    while (b.out < path.most && own(b.out)) b.out = std::min(b.out + path.step, path.most);
    while (b.out - b.in > precision) {
        const double middle = 0.5 * (b.in + b.out);
        (own(middle) ? b.in : b.out) = middle;
    }
    return side * 0.5 * (b.in + b.out);
}

}  // namespace

OwnRange where_own(const OwnLens& lens, const EyePath& path, double wanted, std::uint32_t seed, Parts& parts) {
    OwnRange range{{nan, nan}, {nan, nan}, {}};
    const int more = lens.rays().more_for(path.eye(0));
    const double precision = 0.05 * wanted;
    parts.run(own_range_parts, [&](int part) {
        const int side = part == 0 ? -1 : 1;
        const std::size_t k = std::size_t(part);
        const auto choices = [&](int count, std::uint32_t set) {
            std::vector<Choice> all = even_choices(count * more, set);
            if (side < 0) mirror(all, path.mirrored);
            return all;
        };
        Bracket b = bracket(lens, path, side, choices(coarse_rays, sets * seed));
        range.missing[k] = b.missing;
        if (!b.missing.empty()) return;
        for (int growth = 1; growth <= most_growth; growth *= 4) {
            std::array<double, sets> found;
            for (std::uint32_t set = 0; set < sets; ++set)
                found[set] = falls_to(0.5, lens, path, side, b, precision, choices(first_rays * growth, sets * seed + set));
            const auto [at, error] = estimate(found, precision);
            // Where few lenses drop out one after the other the share has steps, and one of them may lie at one half: the error
            // includes how far the share is within share_error of it.
            const std::vector<Choice> lines = choices(first_rays * growth, sets * seed);
            const auto away = [&](double share) {
                return std::abs(falls_to(share, lens, path, side, b, precision, lines) - found[0]);
            };
            range.at[k] = at;
            range.error[k] = std::hypot(error, std::max(away(0.5 - share_error), away(0.5 + share_error)));
            if (error <= wanted) break;
            // More lines search near the position that these have found.
            b.in = std::max(std::abs(at) - 3 * error, 0.);
            b.out = std::min(std::abs(at) + 3 * error, path.most);
        }
    });
    return range;
}

namespace {

/// Returns an axis of the array as built, as a unit vector in the display's frame.
std::array<double, 2> array_axis(const Geometry& g, int axis) {
    const double c = g.lattice.cos_turn, s = g.lattice.sin_turn;
    return axis == 0 ? std::array{c, s} : std::array{-s, c};
}

/// Returns the slope of the edge by theory, p'/2g.
double half_slope(const Geometry& g, const Theory& t, int axis) {
    return 0.5 * t.along[std::size_t(axis)].elemental_pitch_mm / g.gap_mm;
}

double half_field(const Display& d, const Geometry& g, int axis) { return std::atan(half_slope(g, theory(d, g), axis)); }

}  // namespace

EyePath arc(const Display& d, const Geometry& g, double distance, int axis) {
    const auto [x, y] = array_axis(g, axis);
    const auto eye = [=, x = x, y = y](double angle) {
        const double aside = distance * std::sin(angle * degree);
        return Vec3d{aside * x, aside * y, distance * std::cos(angle * degree)};
    };
    // The angle at which the arc reaches the display, with a margin of a thousandth
    const double before = std::acos(std::min(1.001 * nearest_eye_mm(g) / distance, 1.)) / degree;
    return {eye, std::min(85., before), std::min(0.1 * half_field(d, g, axis) / degree, 1.), axis};
}

double arc_edge_deg(const Geometry& g, const Theory& t, double distance, int axis) {
    // R sin a = slope (R cos a - z_H') gives a = atan(slope) - asin(slope z_H'/(R sqrt(1 + slope^2))).
    const double slope = half_slope(g, t, axis);
    return (std::atan(slope) - std::asin(slope * g.rear_principal_mm / (distance * std::hypot(1, slope)))) / degree;
}

EyePath across(const Display& d, const Geometry& g, double distance, int axis) {
    const auto [x, y] = array_axis(g, axis);
    const auto eye = [=, x = x, y = y](double aside) { return Vec3d{aside * x, aside * y, distance}; };
    const double away = distance - g.rear_principal_mm;
    return {eye, away * std::tan(85 * degree), 0.1 * away * std::tan(half_field(d, g, axis)), axis};
}

}  // namespace lfdsim
