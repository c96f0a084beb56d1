// Depths that are sharp, on either side of the lenses: against the equations of the spot, at depths on both sides of every end.
#include "geometry/sharp_range.h"

#include "analysis/fov/thresholds.h"
#include "analysis/spots/spot_depth.h"
#include "base/constants.h"
#include "lenses.h"

#include <gtest/gtest.h>
#include <complex>
#include <random>

namespace lfdsim {
namespace {

using namespace lens_examples;

// Ideal lenses have no thickness: depths count from the lens. Real, virtual and infinite central depths; D less than the pitch.
TEST(SharpRange, HoldsWhereTheSpotIsNarrowEnough) {
    std::mt19937 random(4);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    int through_infinity = 0;
    for (int n = 0; n < 300; ++n) {
        const double pitch = between(0.3, 8), gap = pitch * between(0.8, 2.5), f = gap * (n % 10 == 0 ? 1 : between(0.85, 1.15));
        Display d = ideal(pitch, gap, f, int(between(8, 90)));
        if (n % 2 == 0) d.array.aperture = Aperture::circle, d.lens.as<IdealLens>().aperture_radius_mm = between(0.15, 0.5) * pitch;
        const Geometry g = resolve(d);
        const Theory t = theory(d, g);
        const double D = g.clear_aperture_mm[0], a = d.panel.pixel_pitch_mm, eye = 600, L = t.central_depth_mm;
        const SharpRange lens = sharp_by_lens(g, t, eye), pixel = sharp_by_pixel(g, t, eye);
        EXPECT_TRUE(lens.holds(0));
        EXPECT_FALSE(lens.holds(eye) || pixel.holds(eye));  // the eye is 600 mm from the panel
        through_infinity += std::isinf(pixel.behind.low) && !pixel.in_front.empty();
        for (int k = 0; k < 100; ++k) {
            const double z = k % 2 ? between(-3000, eye - g.vertex_plane_mm) : between(-60, 60), spot = D * std::abs(1 - z / L);
            if (std::abs(spot - pitch) > 1e-9 * pitch) {
                EXPECT_EQ(lens.holds(z), spot <= pitch) << n << " " << z;
            }
            EXPECT_EQ(pixel.holds(z), spot <= a * std::abs(z) / gap) << n << " " << z;
        }
    }
    EXPECT_GT(through_infinity, 30);
}

// Lenses in rectangles and bricks: what is sharp is sharp along both axes, and a quarter turn of the display changes nothing.
TEST(SharpRange, OfRectanglesIsSharpAlongBothAxes) {
    for (const bool brick : {false, true})
        for (const bool filled : {false, true})
            for (const auto& pitch : {Pitch(1.2, 1.0), Pitch(0.7, 1.9)}) {
                Display d = ideal(1, 4.6, 4.4, 10);
                d.array.lattice = brick ? LatticeKind::brick : LatticeKind::rectangle;
                d.array.aperture = filled ? Aperture::cell : Aperture::circle;
                if (!filled) d.lens.as<IdealLens>().aperture_radius_mm = 0.35;
                d.array.pitch_mm = pitch;
                const Geometry g = resolve(d);
                const Theory t = theory(d, g);
                const SharpRange found = sharp_by_lens(g, t, 600);
                for (double z = -300.3; z < 500; z += 1.7) {
                    bool sharp = true;
                    for (const std::size_t k : {0u, 1u})
                        sharp = sharp && (filled ? pitch[k] : 0.7) * std::abs(1 - z / t.central_depth_mm) <= pitch[k];
                    EXPECT_EQ(found.holds(z), sharp) << brick << filled << pitch[0] << " " << z;
                }
                Display turned = d;
                turned.array.pitch_mm = Pitch(pitch[1], pitch[0]);
                for (auto* one : {&d, &turned}) one->array.count = {11, 11};
                Result of_one, of_turned;
                add_spot_depths(Subject(d, {}, {}), of_one);
                add_spot_depths(Subject(turned, {}, {}), of_turned);
                for (const char* side : {"behind_mm", "in_front_mm"})
                    EXPECT_EQ(of_one.figures["by_lens"][side], of_turned.figures["by_lens"][side]) << brick << filled << pitch[0];
                for (const std::size_t k : {0u, 1u}) EXPECT_NEAR(t.along[k].lens_sampling_limit_per_mm, 0.5 / pitch[k], 1e-12);
            }
}

// Every display: the fan of one lens at depths inside and outside of the ends; and theory's ends where there is no aberration.
TEST(SharpRange, ByTheLensIsTheIntervalOfABruteForceSearch) {
    for (const auto& [name, d] : all_lenses()) {
        const Geometry g = resolve(d);
        const std::vector<FanRay> fan = fans(LensTrace(d, g), {0, 0}, 1001).meridional;
        const double pitch = d.array.pitch_mm[0], limit = std::max(pitch, width_at(fan, 0).mm);
        const auto [low, high] = where_narrow(fan, pitch);
        EXPECT_LE(low, 0) << name;
        EXPECT_GE(high, 0) << name;
        for (double z = -1000; z <= 1000; z += 0.37)
            EXPECT_EQ(width_at(fan, z).mm <= limit, low <= z && z <= high) << name << " " << z;
    }
}

TEST(SharpRange, FiguresNameBothSidesAndEndAtTheViewer) {
    Display d = ideal(2, 3.3, 3.3, 20);  // collimated: through infinity
    d.camera.position_mm = {0, 0, 600};
    const Subject s(d, {}, {});
    Result result;
    add_spot_depths(s, result);
    const Json& pixel = result.figures.at("by_pixel");
    const double start = 2 * 3.3 / d.panel.pixel_pitch_mm;  // D = a z / g
    EXPECT_EQ(pixel.at("behind_mm")[0], "-infinite");
    EXPECT_NEAR(pixel.at("behind_mm")[1].get<double>(), -start, 1e-6 * start);
    EXPECT_NEAR(pixel.at("in_front_mm")[0].get<double>(), start, 1e-6 * start);
    EXPECT_NEAR(pixel.at("in_front_mm")[1].get<double>(), 600 - 3.3, 1e-9);
    EXPECT_EQ(result.figures.at("by_lens").at("in_front_mm")[0], 0);
    EXPECT_NEAR(result.figures.at("by_lens").at("in_front_mm")[1].get<double>(), 600 - 3.3, 1e-9);
}

TEST(SharpRange, WordsNameNothingBehindTheViewer) {
    const Geometry g = resolve(ideal(2, 3.3, 3.2, 20));  // the viewer is 596.7 mm in front of the lens
    const auto words = [&](double low, double high) { return depths_in_words(g, range_between(g, low, high, 600), 600); };
    EXPECT_EQ(words(21.5, 280), "from 21.5 to 280 mm in front of the lenses");
    EXPECT_EQ(words(21.5, 2677), "from 21.5 mm in front of the lenses to the viewer");
    EXPECT_EQ(words(-30, -7), "from 7 to 30 mm behind the lenses");
    EXPECT_EQ(words(-30, 40), "from 30 mm behind the lenses to 40 mm in front of the lenses");
    EXPECT_EQ(words(-infinity, infinity), "from infinity behind the lenses to the viewer");
    EXPECT_EQ(words(700, 2677), "no depth up to the viewer");
    EXPECT_EQ(depths_in_words(g, range_of_inverse(g, 0.02, -0.01, 600), 600),
              "from 100 mm behind the lenses to infinity and from 50 mm in front of the lenses to the viewer");
}

// Waves in a plane at the depth z, as an eye on the axis sees them through thin lenses: point by point, the line of sight through a
// lens meets the panel where the nodal line to the shown point begins. Below the limit the wave itself is stronger than its first
// alias of the lattice, above it the alias is.
TEST(SharpRange, TheLimitOfTheLensesIsWhereAliasesBecomeStronger) {
    std::mt19937 random(9);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    int by_pieces = 0, by_points = 0;
    for (int n = 0; n < 400; ++n) {
        const double pitch = between(0.3, 8), gap = pitch * between(0.8, 2.5), L = (n % 2 ? 1 : -1) * gap * between(3, 100);
        Display d = ideal(pitch, gap, 1 / (1 / gap + 1 / L), int(between(2, 90)));
        d.array.aperture = Aperture::circle;
        const double D = between(0.3, 1) * pitch;
        d.lens.as<IdealLens>().aperture_radius_mm = 0.5 * D;
        const Geometry g = resolve(d);
        const Theory t = theory(d, g);
        const double eye = 600 - g.vertex_plane_mm, z = between(-400, 200);
        // Through the lens at X, x beside its axis, the eye sees the panel where its image at L is met.
        const double pixels = D * gap * std::abs(1 / eye - 1 / L) / d.panel.pixel_pitch_mm;
        const bool points = pixels < 1;
        const double limit = lens_limit_per_mm(d, g, t, z, 600, 0);
        if (!(limit < 100 / pitch)) continue;  // near L there is none
        ++(points ? by_points : by_pieces);
        const auto shown = [&](double X, double x) {
            const double at_image = (X + (points ? 0 : x)) * (1 - L / eye);
            return X + (at_image - X) * z / L;
        };
        for (const double share : {0.93, 1.07}) {
            const double f = share * limit, seen = f * (1 - z / eye);  // cycles per mm in the plane, and at the lenses
            const auto strength = [&](double at_lenses) {
                std::complex<double> sum = 0;
                for (int lens = 0; lens < 8; ++lens)
                    for (int k = 0; k < 64; ++k) {
                        const double X = pitch * lens, x = D * ((k + 0.5) / 64 - 0.5);
                        sum += std::polar(1., 2 * pi * (f * shown(X, x) - at_lenses * (X + x)));
                    }
                return std::abs(sum);
            };
            const double alias = std::max(strength(seen - 1 / pitch), strength(seen + 1 / pitch));
            EXPECT_EQ(strength(seen) > alias, share < 1) << n << " z " << z << " L " << L << " pixels " << pixels;
        }
    }
    EXPECT_GT(by_points, 20);
    EXPECT_GT(by_pieces, 100);
}

TEST(SharpRange, CyclesPerDegreeAreThoseOfTheAngleAtTheEye) {
    const Display d = ideal(2, 3.3, 3.2, 20);
    const Geometry g = resolve(d);
    for (const double z : {-200., 0., 150.}) {
        const double away = 600 - 3.3 - z, one_degree = away * std::tan(1 * degree);
        EXPECT_NEAR(cycles_per_degree(g, 0.25, z, 600), 0.25 * one_degree, 2e-4 * one_degree);
    }
}

// A slope rule that ends within its own error of the middle says nothing.
TEST(Rules, ALimitWithinItsErrorOfTheMiddleIsNone) {
    Curve steps{{-2, -1, 0, 1, 2}, {0.5, 0.9, 0.9, 0.89, 0.5}, 0};
    const Interval i = where_steady(steps, 0, 0.006);
    EXPECT_TRUE(std::isnan(i.low.at) || std::abs(i.low.at) >= i.low.error);
    EXPECT_TRUE(std::isnan(i.high.at));
    EXPECT_NE(i.high.missing.find("error"), std::string::npos) << i.high.missing;
}

}  // namespace
}  // namespace lfdsim
