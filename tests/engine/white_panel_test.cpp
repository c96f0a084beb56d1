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
        d.panel.aperture_ratio = 1;
        d.panel.subpixels = SubpixelLayout::none;
        d.panel.subpixel_cell.reset();
        d.panel.custom.clear();
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
        d.panel.aperture_ratio = 1;
        d.panel.subpixels = SubpixelLayout::none;
        d.panel.subpixel_cell.reset();
        d.panel.custom.clear();
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

// Behind lenses that bend nothing a camera's rays end at the points of the frame, which lies in the panel's plane: each is bright
// in the middle of its pixel and else black.
TEST(WhitePanel, PixelsShineInTheirMiddles) {
    Display d = ideal_example();
    d.lens.as<IdealLens>().focal_length_mm = 1e6;
    d.camera.frame_width_mm = 6;
    d.camera.resolution = {311, 211};
    d.panel.aperture_ratio = 0.36;
    const Image seen = picture(d, uniform_panel(d, 0.5f));
    const double step = 6.0 / 311;
    int lit = 0;
    for (int y = 0; y < 211; ++y)
        for (int x = 0; x < 311; ++x) {
            const auto off_middle = [&](double mm) { return std::abs(mm / 0.25 - std::floor(mm / 0.25) - 0.5); };
            const double away = std::max(off_middle((x - 155) * step), off_middle((y - 105) * step));
            if (std::abs(away - 0.3) < 1e-3) continue;  // at the border
            ASSERT_FLOAT_EQ(seen.at(x, y)[1], away < 0.3 ? 0.5f / 0.36f : 0) << x << " " << y;
            lit += away < 0.3;
        }
    EXPECT_GT(lit, 10000);
}

// Whatever lies before it, a panel with a black matrix is as bright in the mean as one without: in that over places of the array,
// which may show each lens the same part of a pixel.
TEST(WhitePanel, TheBlackMatrixKeepsTheMean) {
    for (auto [name, d] : every_kind()) {
        d.render.samples = 8;
        const auto light = [](Display shown, double ratio) {
            shown.panel.aperture_ratio = ratio;
            double sum = 0;
            const std::array<double, 2> described = shown.array.offset_mm;
            for (int k = 0; k < 16; ++k) {
                shown.array.offset_mm = {described[0] + 0.25 * shown.panel.pixel_pitch_mm * (k % 4),
                                         described[1] + 0.25 * shown.panel.pixel_pitch_mm * (k / 4)};
                for (const float x : picture(shown, uniform_panel(shown, 1)).rgb) sum += x;
            }
            return sum;
        };
        EXPECT_NEAR(light(d, 0.5) / light(d, 1), 1, 0.015) << name;
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
