// Conservation: no ray loses light or gains any. With Fresnel's losses off, a white panel is white or black in each pixel.
#include <gtest/gtest.h>

#include "pictures.h"

namespace lfdsim {
namespace {

constexpr double angles[] = {0, 15, 30, 60};

TEST(WhitePanel, EachRayIsWhiteOrBlack) {
    for (auto [name, d] : every_kind()) {
        d.render.fresnel = Fresnel::none;
        d.panel.emission_exponent = 0;
        d.diffuser.reset();
        d.camera.pixel_filter = PixelFilter::center;
        d.camera.pupil_diameter_mm.reset();
        const Texels white = uniform_panel(d, 1);
        for (double angle : angles) {
            look_from(d, angle, 400);
            int lit = 0;
            for (float light : picture(d, white).rgb) {
                ASSERT_TRUE(light == 0 || light == 1) << name << " " << angle << ": " << light;
                lit += light == 1;
            }
            EXPECT_GT(lit, 0) << name << " " << angle;
        }
    }
}

// The sum over n <= 256 samples is a whole number, exact in float; the mean is that number divided by n, rounded once.
TEST(WhitePanel, MeansAreWholeNumbersOfRays) {
    for (auto [name, d] : every_kind()) {
        d.render.fresnel = Fresnel::none;
        d.panel.emission_exponent = 0;
        d.render.samples = 7;
        const Texels white = uniform_panel(d, 1);
        for (double angle : angles) {
            look_from(d, angle, 400);
            int grey = 0;
            for (float light : picture(d, white).rgb) {
                ASSERT_EQ(light, std::round(light * 7) / 7) << name << " " << angle;
                ASSERT_LE(light, 1);
                grey += light > 0 && light < 1;
            }
            EXPECT_GT(grey, 0) << name << " " << angle;
        }
    }
}

// Square cells without a lens between them: the panel, larger than the array by far, is seen everywhere.
TEST(WhitePanel, IdealSquareLensesHaveNoGaps) {
    Display d = ideal_example();
    d.panel.pixels = {1600, 1120};
    d.array.count = {101, 71};
    d.camera.frame_width_mm = 120;
    d.camera.pixel_filter = PixelFilter::box;
    d.render.samples = 300;
    d.camera.resolution = {80, 56};
    const Texels white = uniform_panel(d, 1);
    for (double angle : angles) {
        look_from(d, angle, 4000);
        for (float light : picture(d, white).rgb) ASSERT_EQ(light, 1) << angle;
        d.diffuser = Diffuser{10, {3, 3}, Profile::box};
        for (float light : picture(d, white).rgb) ASSERT_EQ(light, 1) << angle << ", diffuser";
        d.diffuser.reset();
    }
}

// A Lambertian panel has the same radiance at every angle, so its colour gets no cosine; an exponent of 1 gives one. (The cosine at
// the panel: behind an ideal lens of huge focal length it is the camera's.)
TEST(WhitePanel, RadianceFollowsTheExponent) {
    Display d = ideal_example();
    d.lens.as<IdealLens>().focal_length_mm = 1e5;
    d.camera.frame_width_mm = 1;
    d.camera.resolution = {3, 3};
    for (double angle : angles) {
        look_from(d, angle, 4000);
        for (double m : {0.0, 1.0, 2.5}) {
            d.panel.emission_exponent = m;
            const float light = *picture(d, uniform_panel(d, 1)).at(1, 1);
            EXPECT_NEAR(light, std::pow(std::cos(angle * degree), m), m == 0 ? 0 : 2e-4) << angle << " " << m;
        }
    }
}

}  // namespace
}  // namespace lfdsim
