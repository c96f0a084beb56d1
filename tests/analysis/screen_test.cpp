// An array that reaches over the panel: measures are of the screen that there is, on every lattice.
#include "geometry/screen.h"

#include "analysis/pictures/views.h"
#include "analysis/uniformity/uniformity.h"
#include "analysis/zone/zone_search.h"

#include <gtest/gtest.h>

#include "../engine/pictures.h"

namespace lfdsim {
namespace {

constexpr double eye_of_screen_mm = 600;

/// Ideal lenses in focus for the eye, before a panel of 120 x 68 mm; without a count they cover its bounding box.
Display covered(LatticeKind lattice, double turn_deg) {
    Display d;
    d.panel.pixels = {4800, 2720};
    d.panel.pixel_pitch_mm = 0.025;
    d.lens.kind = IdealLens{{}, 1 / (1 / 4. + 1 / eye_of_screen_mm)};
    d.array.lattice = lattice;
    d.array.pitch_mm = 2;
    d.array.gap_mm = 4;
    d.array.aperture = Aperture::cell;
    if (lattice == LatticeKind::strips)
        d.array.slant_deg = turn_deg;
    else
        d.array.rotation_deg = turn_deg;
    d.camera.position_mm = {0, 0, eye_of_screen_mm + 4};
    d.content.viewing_distance_mm = eye_of_screen_mm + 4;
    return d;
}

/// What an eye at x sees of whose images.
SightShares seen_from_x(const Display& d, double x) {
    const Geometry g = resolve(d);
    return sight_shares(EyeRays(d, g), Pickup(d, g), d, {x, 0, eye_of_screen_mm + 4}, even_choices(1 << 14));
}

// The panel's rectangle as the eye projects it onto the vertex plane, by the intercept theorem; its box along the array's axes.
TEST(Screen, IsWhereALineGoesOnToThePanel) {
    Random random(5);
    for (int n = 0; n < 200; ++n) {
        Display d = covered(LatticeKind::square, random(-45, 45));
        d.array.offset_mm = {random(-20, 20), random(-20, 20)};
        d.array.count = std::array<std::int64_t, 2>{std::int64_t(random(5, 90)), std::int64_t(random(5, 90))};
        const Geometry g = resolve(d);
        const PanelBehind panel(g);
        const Vec3d eye{random(-500, 500), random(-500, 500), random(50, 900)};
        const double x = random(-60, 60), y = random(-34, 34), from_eye = (eye[2] - 4) / eye[2];  // a place on the panel
        const auto meets = [&](double beyond) {
            return panel.meets(eye, eye[0] + from_eye * (beyond * x - eye[0]), eye[1] + from_eye * (beyond * y - eye[1]));
        };
        EXPECT_TRUE(meets(1));
        EXPECT_FALSE(meets(1.001 / std::max(std::abs(x) / 60, std::abs(y) / 34)));
        const std::array<double, 2> size = screen_size_mm(g);
        const double c = g.lattice.cos_turn, s = g.lattice.sin_turn;
        double reach[2][2] = {{1e9, -1e9}, {1e9, -1e9}};
        for (const double u : {-60., 60.})
            for (const double v : {-34., 34.}) {
                const double at[2] = {c * (u - d.array.offset_mm[0]) + s * (v - d.array.offset_mm[1]),
                                      c * (v - d.array.offset_mm[1]) - s * (u - d.array.offset_mm[0])};
                for (int k = 0; k < 2; ++k) reach[k][0] = std::min(reach[k][0], at[k]), reach[k][1] = std::max(reach[k][1], at[k]);
            }
        for (int k = 0; k < 2; ++k) {
            const double half = 0.5 * (k == 0 ? g.array_width_mm : g.array_height_mm);
            EXPECT_NEAR(size[std::size_t(k)], std::max(std::min(reach[k][1], half) - std::max(reach[k][0], -half), 0.), 1e-9);
        }
    }
}

// A lens in focus for the eye shows one point of the panel all over: the screen is as bright as the panel, but for a rim.
TEST(Screen, IsAsBrightAsThePanelOnEveryLattice) {
    struct {
        LatticeKind lattice;
        double turn_deg;
    } const all[] = {{LatticeKind::strips, 18.43},
                     {LatticeKind::strips, 60},
                     {LatticeKind::square, 30},
                     {LatticeKind::hexagon, 0},
                     {LatticeKind::brick, 17}};
    for (const auto& [lattice, turn] : all) {
        const Display d = covered(lattice, turn);
        const Geometry g = resolve(d);
        Job job;
        Parts parts(job, 0, 1 << 20, 0);
        const ScreenLuminance screen = screen_luminance(EyeRays(d, g), d, g, d.camera.position_mm, parts);
        // Lenses whose middle's line misses the panel are dark, though half of each may lie before it: a fifth of a rim one lens
        // wide
        EXPECT_NEAR(screen.mean().value, 1, 0.03) << int(lattice) << " " << turn;
        EXPECT_GT(screen.uniformity_percent(true).value, 99.99) << int(lattice) << " " << turn;
        EXPECT_GT(screen.uniformity_percent(false).value, 80) << int(lattice) << " " << turn;
        EXPECT_NEAR(michelson(pitch_luminance(EyeRays(d, g), d, g, d.camera.position_mm, parts).places).value, 0, 1e-9);
    }
}

// Paraxially half of the screen shows another lens's image from E p'/(2g cos(slant)) on, E the eye's distance from the lenses.
TEST(Screen, ZoneOfSlantedStripsIsThatOfTheory) {
    for (const double slant : {18.43, -25., 60.}) {
        const Display d = covered(LatticeKind::strips, slant);
        const double edge = (eye_of_screen_mm + 4) * 2 / (2 * 4 * std::cos(slant * degree));
        for (const int side : {-1, 1}) {
            EXPECT_LT(seen_from_x(d, 0.9 * side * edge).wrong, 0.1) << slant;
            EXPECT_LT(seen_from_x(d, 0.97 * side * edge).wrong, 0.5) << slant;
            EXPECT_GT(seen_from_x(d, 1.03 * side * edge).wrong, 0.5) << slant;
        }
        const SightShares middle = seen_from_x(d, 0);
        EXPECT_LT(middle.wrong, 0.005) << slant;
        EXPECT_LT(middle.dark, 0.02) << slant;
    }
}

// Four times as many lenses as are before the panel show the same.
TEST(Screen, LensesBesideThePanelDoNotCount) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::hexagon, LatticeKind::strips}) {
        const bool strips = lattice == LatticeKind::strips;
        Display fits = covered(lattice, 0), reaches_over = fits;
        fits.array.count = {59, strips ? 1 : 33};
        reaches_over.array.count = {119, strips ? 1 : 67};
        for (const double x : {0., 90., 140., 150., 160., 250.}) {
            const SightShares a = seen_from_x(fits, x), b = seen_from_x(reaches_over, x);
            EXPECT_NEAR(a.wrong, b.wrong, 0.03) << int(lattice) << " " << x;
            EXPECT_NEAR(a.dark, b.dark, 0.05) << int(lattice) << " " << x;
        }
        const Display seen = seen_from(reaches_over, 0, 0);
        const Geometry g = resolve(reaches_over);
        const double per_mm = double(seen.camera.resolution[0]) / g.frame_width_mm;  // in the panel's plane, the camera's target
        EXPECT_NEAR(double(seen_screen(seen, g).pixels()) / (120 * 68 * per_mm * per_mm), 1, 0.01);
    }
}

}  // namespace
}  // namespace lfdsim
