// Depths of field by spot size and by diffraction, against paraxial theory, closed forms and a brute-force search.
#include "analysis/spot_depth.h"

#include "lenses.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>
#include <numbers>

namespace lfdsim {
namespace {

using namespace lens_examples;

constexpr double infinity = std::numeric_limits<double>::infinity();

Result measured(const Display& d, double wavelength_nm = 550) {
    AnalysisOptions options;
    options.wavelength_nm = wavelength_nm;
    Subject subject(d, {}, options);
    Result result;
    add_spot_depths(subject, result);
    return result;
}

std::vector<Line> axial_fan(const Display& d) { return fans(LensTrace(d, resolve(d)), {0, 0}, 1001).meridional; }

double end(const Json& interval, int side) { return interval.at(std::size_t(side)).get<double>(); }

// Fields of view of 24 to 60 degrees; real, virtual and infinite central depth; round, square and stopped.
TEST(SpotDepth, OfIdealLensesIsTheParaxialOne) {
    for (const double fov : {24., 32., 40., 50., 60.})
        for (const double pitch : {0.5, 2., 12.})
            for (const double f_per_gap : {0.9, 0.97, 1., 1.2}) {
                const double gap = pitch / (2 * std::tan(fov * std::numbers::pi / 360));
                Display d = ideal(pitch, gap, f_per_gap * gap, pitch > 1 ? 70 : 20);
                if (pitch == 2) d.array.aperture = Aperture::circle, d.lens.aperture_radius_mm = 0.9;
                if (pitch == 12) d.lens.stop_radius_mm = 2;
                const Geometry g = resolve(d);
                const Theory t = theory(d, g);
                ASSERT_NEAR(t.fov_deg, fov, 1e-9);
                const Json range = measured(d).figures.at("spot_mm");
                EXPECT_NEAR(end(range, 0) / t.depth_range_mm[0], 1, 1e-6) << fov << " " << pitch << " " << f_per_gap;
                if (std::isinf(t.depth_range_mm[1]))
                    EXPECT_TRUE(range.at(1).is_null());
                else
                    EXPECT_NEAR(end(range, 1) / t.depth_range_mm[1], 1, 1e-6) << fov << " " << pitch << " " << f_per_gap;
            }
}

// Depths count from the vertex plane, which lies a known way before the principal plane when the flat face is there.
TEST(SpotDepth, CountsFromTheVertexPlane) {
    Display d = shipped("desktop-stopped");
    d.lens.facing = Facing::panel;
    d.lens.stop_radius_mm = 0.1;  // so that aberration moves the best focus by little
    const Geometry g = resolve(d);
    const Theory t = theory(d, g);
    ASSERT_GT(g.vertex_plane_mm - g.rear_principal_mm, 1);
    const double best = measured(d).figures.at("spot_best_mm").get<double>();
    EXPECT_NEAR(best, t.central_depth_mm + g.rear_principal_mm - g.vertex_plane_mm, 0.5);
}

// Dense search: a spot is sharp inside of the interval, not outside, on every display.
TEST(SpotDepth, IsTheIntervalOfABruteForceSearch) {
    for (const auto& [name, d] : all_lenses()) {
        const Geometry g = resolve(d);
        const Theory t = theory(d, g);
        const std::vector<Line> fan = axial_fan(d);
        const Allowed allowed = pixel_image(d, g, t);
        const double airy = 2e-3;
        for (const double airy_per_mm : {0., airy}) {
            const SharpDepths depths = where_sharp(fan, allowed, airy_per_mm);
            double least = infinity;
            for (double z = -1000; z <= 1000; z += 0.37) {
                double low = infinity, high = -infinity;
                for (const Line& l : fan) {
                    low = std::min(low, l.at + l.slope * z);
                    high = std::max(high, l.at + l.slope * z);
                }
                const double width = std::hypot(high - low, airy_per_mm * z);
                least = std::min(least, width);
                const bool sharp = width <= allowed.mm + allowed.per_mm * z;
                EXPECT_EQ(sharp, z >= depths.low && z <= depths.high) << name << " " << z;
            }
            EXPECT_LE(depths.least_mm, least + 1e-9) << name;
            EXPECT_NEAR(depths.least_mm, least, 0.37 * std::abs(width_at(fan, 1e6).per_mm) + 1e-3) << name;
        }
    }
}

TEST(SpotDepth, OfAFullSphereIsNone) {
    Display d = shipped("desktop-spherical");
    const Result result = measured(d);
    EXPECT_TRUE(result.figures.at("spot_mm").is_null());
    EXPECT_TRUE(result.figures.at("spot_with_diffuser_mm").is_null());
    ASSERT_FALSE(result.remarks.empty());
    EXPECT_NE(result.remarks[0].find("nowhere"), std::string::npos);
    EXPECT_GT(result.figures.at("spot_least_width_mm").get<double>(), theory(d, resolve(d)).pixel_image_mm);
    EXPECT_TRUE(result.findings[0].measured.empty());
}

// With the diffuser in the central depth plane nothing is added there, and to either side its angle as seen from there.
TEST(SpotDepth, DiffuserNarrowsIt) {
    Display d = ideal(12, 16.485, 15.7, 88);
    const Theory t = theory(d, resolve(d));
    d.diffuser = Diffuser{t.central_depth_mm, {1, 1}, Profile::box};
    const Result result = measured(d);
    const double L = t.central_depth_mm, slope = 12 / L / 2;
    // a rim's ray, at the angle atan(slope) to the axis, is turned outwards by half a degree
    const double turned = std::tan(std::atan(slope) + 0.5 * std::numbers::pi / 180), half = t.pixel_image_mm / (2 * turned);
    EXPECT_NEAR(end(result.figures.at("spot_with_diffuser_mm"), 0), L - half, 1e-6 * L);
    EXPECT_NEAR(end(result.figures.at("spot_with_diffuser_mm"), 1), L + half, 1e-6 * L);
    EXPECT_GT(L - half, end(result.figures.at("spot_mm"), 0) + 5);
    d.diffuser.reset();
    EXPECT_FALSE(measured(d).figures.contains("spot_with_diffuser_mm"));
}

TEST(SpotDepth, AiryDiskNarrowsIt) {
    const Display d = ideal(1, 2, 1.9, 20);
    const Theory t = theory(d, resolve(d));
    const Json range = measured(d, 700).figures.at("spot_with_diffraction_mm");
    const double per_mm = 2.44 * 700e-6 / 1, L = t.central_depth_mm;
    for (const int side : {0, 1}) {
        const double z = end(range, side);
        EXPECT_NEAR(std::hypot(std::abs(z / L - 1), per_mm * z), t.pixel_image_mm, 1e-9);
    }
    EXPECT_GT(end(range, 0), t.depth_range_mm[0]);
    EXPECT_LT(end(range, 1), t.depth_range_mm[1]);
}

TEST(SpotDepth, QuarterOfAWave) {
    const double wavelength = 550e-6;
    const auto error_in_waves = [&](double z, double L, double D) { return std::abs(1 / z - 1 / L) * D * D / 8 / wavelength; };
    for (const double L : {145., -80.}) {
        const auto range = quarter_wave_depths(L, 2.319, wavelength);
        EXPECT_LT(range[0], L);
        EXPECT_GT(range[1], L);
        for (const double z : range) EXPECT_NEAR(error_in_waves(z, L, 2.319), 0.25, 1e-12);
        const double rayleigh = 2 * wavelength * L * L / (2.319 * 2.319);  // for depths much less than L
        EXPECT_NEAR((range[1] - range[0]) / (2 * rayleigh), 1, 0.01);
    }
    // so small a hole that infinity is sharp with L
    EXPECT_EQ(quarter_wave_depths(1000, 0.5, wavelength)[1], infinity);
    EXPECT_EQ(quarter_wave_depths(-1000, 0.5, wavelength)[0], -infinity);
    EXPECT_LT(quarter_wave_depths(-1000, 0.5, wavelength)[1], 0);
    const auto far = quarter_wave_depths(infinity, 2, wavelength);
    EXPECT_NEAR(far[0], 4 / (2 * wavelength), 1e-9);
    EXPECT_EQ(far[1], infinity);
}

}  // namespace
}  // namespace lfdsim
