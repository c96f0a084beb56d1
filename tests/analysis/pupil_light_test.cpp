// Lenses with stops before, inside and behind them, of all lattices: what theory makes of their pupils against traced lines of
// sight.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <cmath>
#include <random>

#include "analysis/spots/aperture_wave.h"
#include "analysis/uniformity/luminance_theory.h"
#include "analysis/uniformity/uniformity.h"
#include "base/constants.h"
#include "geometry/screen.h"

namespace lfdsim {
namespace {

class DrawLenses {
  public:
    explicit DrawLenses(unsigned seed) : random_(seed) {}
    double even(double low, double high) { return low + (high - low) * double(random_()) / double(std::mt19937::max()); }

    /// Of two to four surfaces, narrow against its length (`scale`): paraxial, with apertures that cut its cell or not.
    Display display(int n, double scale) {
        constexpr LatticeKind lattices[] = {LatticeKind::square, LatticeKind::rectangle, LatticeKind::hexagon, LatticeKind::brick,
                                            LatticeKind::strips};
        Display d;
        d.panel.pixels = {4000, 4000};
        d.panel.pixel_pitch_mm = 8 * scale;
        d.array.lattice = lattices[n % 5];
        const double p = 8 * scale;
        const bool two = differs_by_axis(d.array);
        if (two)
            d.array.pitch_mm = Pitch{p, even(0.7, 1.4) * p};
        else
            d.array.pitch_mm = p;
        if (is_strips(d.array) && n % 10 == 4) d.array.slant_deg = even(-20, 20);
        d.array.count = {9, is_strips(d.array) ? 1 : 7};
        d.array.gap_mm = 30;
        d.array.aperture = n / 5 % 3 == 0 ? Aperture::circle : Aperture::cell;
        const bool round = d.array.aperture == Aperture::circle;
        const double inner = inner_radius_mm(d.array), outer = outer_radius_mm(d.array);
        std::vector<Surface> surfaces;
        const int count = 2 + n % 3;
        const int stop = int(random_() % std::uint32_t(count));  // the surface that limits light
        for (int k = 0; k < count; ++k) {
            const double wide = round ? inner : outer * 1.2, narrow = even(0.5, round ? 1 : 1.3) * inner;
            surfaces.push_back({even(-0.03, 0.03), 0, {}, k == stop ? std::min(narrow, wide) : wide, even(1, 3), even(1.4, 1.8)});
        }
        surfaces.front().curvature_per_mm = even(0, 0.05);
        surfaces.back().curvature_per_mm = -even(0.01, 0.06);
        d.lens = {SurfaceLens{surfaces}, {}};
        if (n % 4 == 3) d.lens.stop_radius_mm = even(0.5, 1) * inner;
        d.render.fresnel = Fresnel::none;
        d.camera.position_mm = {0, 0, 1e4};
        d.content.viewing_distance_mm = 1e4;
        return d;
    }

  private:
    std::mt19937 random_;
};

double traced(const Display& d, const Geometry& g, double eye) {
    const EyeRays rays(d, g);
    const std::vector<Choice> choices = even_choices(1 << 15);
    const PanelBehind panel(g);
    double sum = 0, all = 0;
    for (const Choice& c : choices) {
        const Vec3d at = rays.aim({0, 0, eye}, c);
        if (!panel.meets({0, 0, eye}, at[0], at[1])) continue;
        ++all;
        sum += rays.look({0, 0, eye}, c).light;
    }
    return sum / all;
}

double area_of(const ApertureShape& shape, const Lattice<double>& l) {
    if (shape.form == ApertureShape::ApertureForm::slit) return shape.width_mm[0] * l.pitch[1];
    constexpr int steps = 500;
    int within = 0;
    const double w = shape.extent_mm(0), h = shape.extent_mm(1);
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) within += shape.holds(w * ((i + 0.5) / steps - 0.5), h * ((j + 0.5) / steps - 0.5));
    return within * w * h / (steps * steps);
}

// An eye far away sees light through the pupil and nowhere else: its share of the cells' area.
TEST(PupilLight, ShareOfTheCellIsWhatLinesOfSightFind) {
    DrawLenses draw(5);
    int checked = 0, inside = 0, cut = 0;
    for (int n = 0; n < 24; ++n) {
        const Display d = draw.display(n, 0.02);
        if (!validate(d).empty()) continue;
        const Geometry g = resolve(d);
        const ApertureShape shape = aperture_shape(d, g);
        const double cell = g.lattice.pitch[0] * g.lattice.pitch[1];
        const double found = traced(d, g, 1e4);
        if (!d.array.slant_deg) {  // else strips reach beyond the panel
            EXPECT_NEAR(found, area_of(shape, g.lattice) / cell, 0.005) << n;
        }
        if (n % 4 == 0) {
            EXPECT_NEAR(luminance_over_panel(d, g, 1e4).value, found, 0.004) << n;
        }
        ++checked;
        inside += g.pupil.inner_z.has_value();
        cut += shape.outline.size() > 6;  // arcs between the sides
    }
    EXPECT_GT(checked, 12);
    EXPECT_GT(inside, 3);
    EXPECT_GT(cut, 1);
}

// A cell whose corners a round pupil cuts off: means of waves and areas against sums over a fine grid.
TEST(PupilLight, WavesOverCutCells) {
    Display d = DrawLenses(1).display(10, 1);  // a square that is filled
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon}) {
        d.array.lattice = lattice;
        d.array.pitch_mm = 8;
        Geometry g = resolve(d);
        g.pupil = {lattice == LatticeKind::square ? 4.7 : 4.3, {}, 1};
        g.clear_aperture_mm = {8, 8};
        const ApertureShape shape = aperture_shape(d, g);
        ASSERT_GT(shape.outline.size(), 6u);
        constexpr int steps = 800;
        const double side = 10;
        const std::array<std::array<double, 2>, 3> waves{{{0.05, 0.02}, {0.2, -0.13}, {0.0, 0.4}}};
        std::array<double, 3> sums{};
        double within = 0, below = 0;
        for (int j = 0; j < steps; ++j)
            for (int i = 0; i < steps; ++i) {
                const double x = side * ((i + 0.5) / steps - 0.5), y = side * ((j + 0.5) / steps - 0.5), r = g.pupil.radius_mm;
                const bool in_cell = lattice == LatticeKind::square
                                         ? std::max(std::abs(x), std::abs(y)) <= 4
                                         : std::abs(x) <= 4 && 0.5 * std::abs(x) + std::sqrt(0.75) * std::abs(y) <= 4;
                if (!in_cell || x * x + y * y > r * r) continue;
                within += 1;
                below += y < 1.3;
                for (std::size_t k = 0; k < 3; ++k) sums[k] += std::cos(2 * pi * (waves[k][0] * x + waves[k][1] * y));
            }
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_NEAR(shape.mean(waves[k][0], waves[k][1]), sums[k] / within, 1e-3) << int(lattice) << k;
        EXPECT_NEAR(shape.below(1, 1.3), below / within, 1e-3);
        EXPECT_NEAR(shape.below(0, 0), 0.5, 1e-12);
        EXPECT_NEAR(shape.extent_mm(0), 8, 2e-3);
    }
}

// Cells whose corners are nearly as wide as the ball: part of the light is totally reflected, or misses the panel's side.
TEST(PupilLight, SteepCornersPassLess) {
    Display d;
    d.panel.pixels = {485, 291};
    d.panel.pixel_pitch_mm = 0.18;
    d.lens.kind = PlanoConvex{6.14, 5.9614, 0.7335, 1.4773, Facing::viewer};
    d.array.pitch_mm = 8.43;
    d.array.aperture = Aperture::cell;
    d.array.gap_mm = 13.42;
    d.camera.position_mm = {0, 0, 620};
    d.content.viewing_distance_mm = 620;
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips}) {
        d.array.lattice = lattice;
        const Geometry g = resolve(d);
        const double found = traced(d, g, 620);
        const TheoryFigure theory = luminance_over_panel(d, g, 620);
        EXPECT_NEAR(theory.value, found, 0.004) << int(lattice);
    }
    // In one sheet of glass that light goes on through other lenses: null, and why.
    d.array.lattice = LatticeKind::square;
    d.array.surround = Surround::plate;
    EXPECT_TRUE(std::isnan(luminance_over_panel(d, resolve(d), 620).value));
    EXPECT_FALSE(luminance_over_panel(d, resolve(d), 620).missing.empty());
}

}  // namespace
}  // namespace lfdsim
