// Depths of field by spot size and by diffraction, against paraxial theory, closed forms and a brute-force search.
#include "analysis/spots/spot_depth.h"

#include "base/constants.h"
#include "lenses.h"

#include <gtest/gtest.h>
#include <cmath>

namespace lfdsim {
namespace {

using namespace lens_examples;

Result sharp_depths(const Display& d, double wavelength_nm = 550) {
    AnalysisOptions options;
    options.wavelength_nm = wavelength_nm;
    Subject subject(d, {}, options);
    Result result;
    add_spot_depths(subject, result);
    return result;
}

std::vector<FanRay> axial_fan(const Display& d) { return fans(LensTrace(d, resolve(d)), {0, 0}, 1001).meridional; }

double end(const Json& interval, int side) { return interval.at(std::size_t(side)).get<double>(); }

// Fields of view of 24 to 60 degrees; real, virtual and infinite central depth; round, square and stopped.
TEST(SpotDepth, OfIdealLensesIsTheParaxialOne) {
    for (const double fov : {24., 32., 40., 50., 60.})
        for (const double pitch : {0.5, 2., 12.})
            for (const double f_per_gap : {0.9, 0.97, 1., 1.2}) {
                const double gap = pitch / (2 * std::tan(fov * pi / 360));
                Display d = ideal(pitch, gap, f_per_gap * gap, pitch > 1 ? 70 : 20);
                if (pitch == 2) d.array.aperture = Aperture::circle, d.lens.as<IdealLens>().aperture_radius_mm = 0.9;
                if (pitch == 12) d.lens.stop_radius_mm = 2;
                const Geometry g = resolve(d);
                const Theory t = theory(d, g);
                ASSERT_NEAR(t.along[0].fov_deg, fov, 1e-9);
                const Json figures = sharp_depths(d).figures, ends = figures.at("spot_diopters"),
                           errors = figures.at("spot_diopters_error");
                const double tolerance = 1e-6 * 1000 * (t.depth_near_per_mm - t.depth_far_per_mm);
                EXPECT_NEAR(end(ends, 0), 1000 * t.depth_near_per_mm, tolerance) << fov << " " << pitch << " " << f_per_gap;
                EXPECT_NEAR(end(ends, 1), 1000 * t.depth_far_per_mm, tolerance) << fov << " " << pitch << " " << f_per_gap;
                EXPECT_LT(end(errors, 0) + end(errors, 1), tolerance);
                if (end(ends, 0) > 5) {  // less is behind the eye; an ideal lens is its own vertex plane
                    EXPECT_NEAR(end(figures.at("by_pixel").at("in_front_mm"), 0) * end(ends, 0), 1000, 1e-6);
                }
            }
}

// Depths count from the vertex plane, which lies a known way before the principal plane when the flat face is there.
TEST(SpotDepth, CountsFromTheVertexPlane) {
    Display d = shipped("desktop-stopped");
    d.lens.as<PlanoConvex>().facing = Facing::panel;
    d.lens.stop_radius_mm = 0.1;  // so that aberration moves the best focus by little
    const Geometry g = resolve(d);
    const Theory t = theory(d, g);
    ASSERT_GT(g.vertex_plane_mm - g.rear_principal_mm, 1);
    const double best = sharp_depths(d).figures.at("spot_best_mm").get<double>();
    EXPECT_NEAR(best, t.central_depth_mm + g.rear_principal_mm - g.vertex_plane_mm, 0.5);
}

// Dense search: a spot is sharp inside of the interval, not outside, on every display.
TEST(SpotDepth, IsTheIntervalOfABruteForceSearch) {
    for (const auto& [name, d] : all_lenses()) {
        const Geometry g = resolve(d);
        const std::vector<FanRay> fan = axial_fan(d);
        const double pixel_slope = d.panel.pixel_pitch_mm / g.gap_mm, airy = 2e-3;
        for (const double airy_slope : {0., airy}) {
            const SharpDepths depths = where_sharp(fan, pixel_slope, airy_slope);
            double least = infinity;
            for (double z = -1000; z <= 1000; z += 0.37) {
                double low = infinity, high = -infinity;
                for (const FanRay& l : fan) {
                    low = std::min(low, l.at + l.slope * z);
                    high = std::max(high, l.at + l.slope * z);
                }
                const double slope = std::hypot((high - low) / z, airy_slope);
                least = std::min(least, slope);
                EXPECT_EQ(slope <= pixel_slope, 1 / z >= depths.far_per_mm && 1 / z <= depths.near_per_mm) << name << " " << z;
            }
            EXPECT_LE(depths.least_width, least + 1e-12) << name;
            if (std::abs(depths.best_per_mm) > 1e-3) {
                EXPECT_NEAR(depths.least_width, least, 0.05 * least + 1e-4) << name;
            }
        }
    }
}

TEST(SpotDepth, OfAFullSphereIsNone) {
    Display d = shipped("desktop-spherical");
    const Result result = sharp_depths(d);
    EXPECT_TRUE(result.figures.at("by_pixel").at("in_front_mm").is_null());
    EXPECT_TRUE(result.figures.at("by_pixel_with_diffuser").at("in_front_mm").is_null());
    EXPECT_NE(result.notes.at("spot_diopters").get<std::string>().find("nowhere"), std::string::npos);
    EXPECT_GT(result.figures.at("spot_least_pixel_images").get<double>(), 1);
    EXPECT_TRUE(std::isnan(result.findings[2].measured.at(0)));
}

// With the diffuser in the central depth plane nothing is added there, and to either side its angle as seen from there.
TEST(SpotDepth, DiffuserNarrowsIt) {
    Display d = ideal(12, 16.485, 15.7, 88);
    const Theory t = theory(d, resolve(d));
    d.diffuser = Diffuser{t.central_depth_mm, {1, 1}, Profile::box};
    const Result result = sharp_depths(d);
    const double L = t.central_depth_mm, slope = 12 / L / 2;
    // a rim's ray, at the angle atan(slope) to the axis, is turned outwards by half a degree
    const double turned = 2 * std::tan(std::atan(slope) + 0.5 * pi / 180), pixel = t.pixel_image_mm / L;
    const double near = L * turned / (turned + pixel), far = L * turned / (turned - pixel);  // turned |z - L| = pixel z
    EXPECT_NEAR(end(result.figures.at("by_pixel_with_diffuser").at("in_front_mm"), 0), near, 1e-6 * L);
    EXPECT_NEAR(end(result.figures.at("by_pixel_with_diffuser").at("in_front_mm"), 1), far, 1e-6 * L);
    EXPECT_GT(near, end(result.figures.at("by_pixel").at("in_front_mm"), 0) + 5);
    d.diffuser.reset();
    EXPECT_FALSE(sharp_depths(d).figures.contains("by_pixel_with_diffuser"));
}

TEST(SpotDepth, AiryDiskNarrowsIt) {
    const Display d = ideal(1, 2, 1.9, 20);
    const Theory t = theory(d, resolve(d));
    const Json range = sharp_depths(d, 700).figures.at("by_pixel_with_diffraction").at("in_front_mm");
    const double per_mm = 2.44 * 700e-6 / 1, L = t.central_depth_mm;
    for (const int side : {0, 1}) {
        const double z = end(range, side);
        EXPECT_NEAR(std::hypot(std::abs(z / L - 1), per_mm * z), t.pixel_image_mm * z / L, 1e-9);
    }
    EXPECT_GT(end(range, 0), depth_mm(t.depth_near_per_mm));
    EXPECT_LT(end(range, 1), depth_mm(t.depth_far_per_mm));
}

TEST(SpotDepth, QuarterOfAWave) {
    const double wavelength = 550e-6;
    const auto error_in_waves = [&](double z, double L, double D) { return std::abs(1 / z - 1 / L) * D * D / 8 / wavelength; };
    for (const double L : {145., -80., infinity}) {
        const auto [near, far] = quarter_wave_per_mm(L, 2.319, wavelength);
        EXPECT_LT(far, near);
        for (const double per_mm : {near, far}) EXPECT_NEAR(error_in_waves(1 / per_mm, L, 2.319), 0.25, 1e-12);
        const double rayleigh = 2 * wavelength * L * L / (2.319 * 2.319);  // for depths much less than L
        if (std::isfinite(L)) {
            EXPECT_NEAR((1 / far - 1 / near) / (2 * rayleigh), 1, 0.01);
        }
    }
    // so small a hole that infinity is sharp with L
    EXPECT_LT(quarter_wave_per_mm(1000, 0.5, wavelength)[1], 0);
    EXPECT_GT(quarter_wave_per_mm(-1000, 0.5, wavelength)[0], 0);
}

// The spot is that of the perfect lens: what it leaves out is said, and only that.
TEST(SpotDepth, NamesTheErrorsThatItLeavesOut) {
    Display d = shipped("desktop-ideal");
    d.errors.gap_mm = 0.15;
    d.errors.pitch_ppm = 100;
    d.errors.decenter_sd_mm = 0.01;
    EXPECT_FALSE(sharp_depths(d).notes.contains("by_lens"));
    EXPECT_TRUE(sharp_depths(d).remarks.empty());
    d.errors.curvature_sd = 0.01;
    d.errors.given = std::make_shared<const std::vector<GivenLensError>>(1);
    const Result result = sharp_depths(d);
    for (const char* figure : {"by_lens", "by_pixel", "by_pixel_with_diffraction", "spot_diopters", "spot_best_mm"})
        EXPECT_NE(result.notes.at(figure).get<std::string>().find("errors.curvature_sd, errors.table"), std::string::npos)
            << figure;
    ASSERT_EQ(result.remarks.size(), 1u);
    EXPECT_NE(result.remarks[0].find("errors.curvature_sd, errors.table"), std::string::npos);
}

}  // namespace
}  // namespace lfdsim
