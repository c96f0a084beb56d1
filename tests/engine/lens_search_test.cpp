// No lens is missed: the tracer's arithmetic against a search over all lenses near the ray, in plain geometry.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "../optics/example.h"
#include "display/keys.h"
#include "geometry/prescription.h"

namespace lfdsim {
namespace {

using V = std::array<double, 3>;
double dot(const V& a, const V& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The centre of lens (a, b), b counted upwards, by docs/model.md.
std::array<double, 2> centre_of(const Display& d, int a, int b) {
    const bool hexagon = d.array.lattice == LatticeKind::hexagon, staggered = hexagon || d.array.lattice == LatticeKind::brick;
    const double px = d.array.pitch_mm[0], py = hexagon ? px * std::sqrt(3) / 2 : d.array.pitch_mm[1];
    const auto [columns, rows] = *d.array.count;
    return {(a - double(columns - 1) / 2) * px + (!staggered ? 0 : b % 2 != 0 ? px / 4 : -px / 4), (b - double(rows - 1) / 2) * py};
}

bool within_cell(const Display& d, const V& q) {
    const double px = d.array.pitch_mm[0], x = std::abs(q[0]), y = std::abs(q[1]);
    if (d.array.lattice == LatticeKind::strips) return x <= px / 2;
    if (d.array.lattice == LatticeKind::hexagon) return x <= px / 2 && x / 2 + y * std::sqrt(3) / 2 <= px / 2;
    return x <= px / 2 && y <= d.array.pitch_mm[1] / 2;
}

/// Panel pixel of a ray through plano-convex lenses facing the viewer in an opaque surround, or -1: the cap that it meets first is
/// found by trying every lens near the ray's shadow, as the docs define the solid; strips are cylinders along y.
std::int64_t search(const Display& d, const Geometry& g, const V& o, const V& i) {
    const double R = d.lens.as<PlanoConvex>().sphere_radius_mm, r = g.glass_radius_mm, n = *d.lens.as<PlanoConvex>().index;
    const bool strips = d.array.lattice == LatticeKind::strips, filled = d.array.aperture == Aperture::cell;
    auto within = [&](const V& q) { return filled ? within_cell(d, q) : q[0] * q[0] + (strips ? 0 : q[1] * q[1]) <= r * r; };
    auto across = [&](V v) { return strips ? V{v[0], 0, v[2]} : v; };
    const double base = g.base_z_mm, rim = base + d.lens.as<PlanoConvex>().cylinder_height_mm,
                 centre = rim - std::sqrt(R * R - r * r);
    auto at = [&](double z) { return V{o[0] + i[0] * (z - o[2]) / i[2], o[1] + i[1] * (z - o[2]) / i[2], z}; };
    const V high = at(centre + R), low = at(rim);
    double first = 1e30;
    V met{}, ball{};
    const auto zero = centre_of(d, 0, 0), one = centre_of(d, 1, d.array.count->at(1) > 1 ? 2 : 0);
    auto index = [&](double x, int axis) {  // two more on either side are searched
        const double step = axis == 0 ? one[0] - zero[0] : one[1] > zero[1] ? (one[1] - zero[1]) / 2 : 1e9;
        return int(std::floor((x - zero[std::size_t(axis)]) / step));
    };
    for (int a = std::max(0, index(std::min(high[0], low[0]), 0) - 2);
         a <= std::min<int>(int(d.array.count->at(0)) - 1, index(std::max(high[0], low[0]), 0) + 2); ++a) {
        for (int b = std::max(0, index(std::min(high[1], low[1]), 1) - 2);
             b <= std::min<int>(int(d.array.count->at(1)) - 1, index(std::max(high[1], low[1]), 1) + 2); ++b) {
            const auto [cx, cy] = centre_of(d, a, b);
            const V c{cx, cy, centre};
            const V from{high[0] - c[0], high[1] - c[1], high[2] - c[2]}, flat = across(from), along = across(i);
            const double steep = dot(along, along), half = dot(flat, along), disc = half * half - steep * (dot(flat, flat) - R * R);
            if (disc < 0) continue;
            const double t = (-half - std::sqrt(disc)) / steep;  // coming in
            const V q{from[0] + i[0] * t, from[1] + i[1] * t, from[2] + i[2] * t};
            if (q[2] + centre < rim || !within(q) || t >= first) continue;
            first = t;
            met = q;
            ball = c;
        }
    }
    if (first == 1e30) return -1;
    const V up = across(met), normal{up[0] / R, up[1] / R, up[2] / R};
    auto refract = [](const V& ray, const V& m, double eta, V& out) {
        const double c = -dot(m, ray), radicand = 1 - eta * eta * (1 - c * c);
        if (radicand < 0) return false;
        for (int k = 0; k < 3; ++k) out[k] = eta * ray[k] + (eta * c - std::sqrt(radicand)) * m[k];
        return true;
    };
    V inside{}, out{};
    if (!refract(i, normal, 1 / n, inside) || inside[2] >= 0) return -1;
    const double down = (base - centre - met[2]) / inside[2];
    const V flat{met[0] + inside[0] * down, met[1] + inside[1] * down, base};
    if (!within(flat) || !refract(inside, {0, 0, 1}, n, out)) return -1;
    const double x = ball[0] + flat[0] - out[0] * base / out[2], y = ball[1] + flat[1] - out[1] * base / out[2];
    const std::int64_t column = std::int64_t(std::floor((x + g.panel_width_mm / 2) / d.panel.pixel_pitch_mm));
    const std::int64_t row = std::int64_t(std::floor((g.panel_height_mm / 2 - y) / d.panel.pixel_pitch_mm));
    if (column < 0 || row < 0 || column >= d.panel.pixels[0] || row >= d.panel.pixels[1]) return -1;
    return row * d.panel.pixels[0] + column;
}

template <class F>
std::int64_t traced(const optics::TracedDisplay<F>& scene, const optics::RayOrigin& view, int column, int row) {
    const optics::Sampler<F> sampler(Sampling::sobol, optics::sampler_dimensions, 0, 0);
    const auto rays = optics::pixel_rays<F>(view, column, row);
    const auto hit =
        optics::with_facts(scene, [&]<optics::Facts facts>() { return optics::trace<facts>(scene, view, rays, sampler); });
    return hit.lit ? std::int64_t(hit.pixel) : -1;
}

class LensSearch : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Arrays, LensSearch, testing::Values(10, 100, 1000), testing::PrintToStringParamName());

// Nearly half balls, so that caps stand as proud as they can, on a low rim. In double no ray differs but those within rounding of
// an edge (1e-12 of a pixel: none is met here); in float one in a thousand: an edge is blurred by some 1e-6 of the lens.
TEST_P(LensSearch, FindsTheLensThatAFullSearchFinds) {
    const int side = GetParam();
    Display d = example();
    d.array.count = {side, side};
    d.panel.pixels = {16 * side, 16 * side};
    d.array.gap_mm.reset();
    d.array.base_z_mm = 1.5;
    d.lens.as<PlanoConvex>().index = 1.7;
    d.camera.resolution = {150, 100};
    const struct {
        LatticeKind lattice;
        Pitch pitch;
        Aperture aperture;
        double radius;
    } cases[] = {
        {LatticeKind::square, 4, Aperture::circle, 2.001},   {LatticeKind::square, 4, Aperture::circle, 2.5},
        {LatticeKind::square, 4, Aperture::circle, 6},       {LatticeKind::square, 4, Aperture::cell, 2.83},
        {LatticeKind::square, 4, Aperture::cell, 3.3},       {LatticeKind::rectangle, {3.6, 5}, Aperture::cell, 3.2},
        {LatticeKind::hexagon, 4, Aperture::circle, 2.001},  {LatticeKind::hexagon, 4, Aperture::circle, 2.5},
        {LatticeKind::hexagon, 4, Aperture::cell, 2.4},      {LatticeKind::brick, {5, 4}, Aperture::circle, 2.001},
        {LatticeKind::brick, {3.6, 5}, Aperture::cell, 3.2}, {LatticeKind::brick, {6, 2.6}, Aperture::cell, 3.3},
        {LatticeKind::strips, 4, Aperture::circle, 2.001},   {LatticeKind::strips, 4, Aperture::cell, 2.3},
    };
    for (const auto& [lattice, pitch, aperture, radius] : cases) {
        d.lens.as<PlanoConvex>().sphere_radius_mm = radius;
        d.array.lattice = lattice;
        d.array.pitch_mm = pitch;
        d.array.aperture = aperture;
        d.array.count = {side, lattice == LatticeKind::strips ? 1 : side};
        const double reach = std::max(2., glass_radius_mm(2, d.array));
        d.lens.as<PlanoConvex>().cylinder_height_mm =
            std::min(0.5, 1.9 * std::sqrt(radius * radius - reach * reach));  // the ball clears the flat face
        for (double angle : {0.0, 30.0, 60.0, 75.0, 85.0}) {
            const double distance = 4.0 * side + 100, turn = 25 * degree;  // beside the array, on no axis of symmetry
            d.camera.position_mm = {distance * std::sin(angle * degree) * std::cos(turn),
                                    distance * std::sin(angle * degree) * std::sin(turn), distance * std::cos(angle * degree) + 10};
            d.camera.frame_width_mm =
                std::min(4.4 * side, 120.0) *
                std::max(0.2, std::cos(angle * degree));  // all of the small array, 30 lenses across of the others
            const Geometry g = resolve(d);
            const auto narrow = make_traced_display<float>(d, g);
            const auto wide = make_traced_display<double>(d, g);
            const optics::RayOrigin view = make_ray_origin(d, g);
            int lit = 0, different = 0, different_float = 0;
            for (int row = 0; row < 100; ++row) {
                for (int column = 0; column < 150; ++column) {
                    V to;
                    for (int a = 0; a < 3; ++a) {
                        to[a] = view.forward[a] * view.distance +
                                (view.right[a] * (column + 0.5 - 75) + view.up[a] * (50 - row - 0.5)) * view.pixel_mm;
                    }
                    const double length = std::sqrt(dot(to, to));
                    for (double& a : to) a /= length;
                    const std::int64_t wanted =
                        to[2] < 0 ? search(d, g, {view.position[0], view.position[1], view.position[2]}, to) : -1;
                    lit += wanted >= 0;
                    different += traced(wide, view, column, row) != wanted;
                    different_float += traced(narrow, view, column, row) != wanted;
                }
            }
            SCOPED_TRACE(fmt::format("{}, R {} at {} degrees", word(lattice), radius, angle));
            EXPECT_EQ(different, 0);
            EXPECT_LE(different_float, 15);
            EXPECT_GT(lit, 30);
        }
    }
}

}  // namespace
}  // namespace lfdsim
