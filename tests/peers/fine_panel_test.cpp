// Panels with subpixels, as other renderers show them: lfdsim's own picture of the finer panel is that of the display.
#include "interchange/peers/fine_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../engine/pictures.h"
#include "display/keys.h"
#include "geometry/subpixels.h"

namespace lfdsim {
namespace {

TEST(FinePanel, ShowsTheSamePicture) {
    for (const SubpixelLayout layout : {SubpixelLayout::rgb_stripe, SubpixelLayout::pentile_rgbg, SubpixelLayout::delta}) {
        Display d = example();
        d.panel.subpixels = layout;
        d.camera.frame_width_mm = 8;
        const Texels shown = noise_panel(d);
        const FinePanel fine = fine_panel(d);
        EXPECT_EQ(fine.times, layout == SubpixelLayout::rgb_stripe ? 3 : layout == SubpixelLayout::delta ? 6 : 2);
        EXPECT_EQ(fine.deviations.size(), 1u);
        const Image wanted = picture(d, shown), got = picture(fine.display, fine_image(fine, shown));
        int differ = 0;
        for (std::size_t k = 0; k < wanted.rgb.size(); ++k)
            differ += std::abs(wanted.rgb[k] * float(fine.light) - got.rgb[k]) > 1e-5f;
        EXPECT_LT(differ, int(wanted.rgb.size() / 1000)) << word(layout);  // rays that meet a border
    }
}

TEST(FinePanel, KeepsWhiteWhereBordersAreRounded) {
    Display d = example();
    d.panel = with_subpixels(d.panel, SubpixelLayout::custom);
    const FinePanel fine = fine_panel(d);
    EXPECT_EQ(fine.deviations.size(), 2u);
    const Texels image = fine_image(fine, uniform_panel(d, 1));
    // Whole cells, away from the border, over which rectangles hang
    double sum[3] = {}, most = 0;
    const std::int64_t cell_x = 3 * fine.times, cell_y = 2 * fine.times;
    for (std::int64_t y = cell_y; y < 4 * cell_y; ++y)
        for (std::int64_t x = cell_x; x < 5 * cell_x; ++x)
            for (int c = 0; c < 3; ++c) {
                const double light = double(image.data()[4 * (y * image.columns() + x) + c]);
                sum[c] += light;
                most = std::max(most, light);
            }
    for (const double each : sum) EXPECT_NEAR(each / double(12 * cell_x * cell_y), fine.light, 1e-6);
    EXPECT_NEAR(most, 1, 1e-6);
}

// Subpixels whose borders are not on twelfths of a pixel keep nearly their area and the black around them.
TEST(FinePanel, RoundsSubpixelsToTheirArea) {
    struct Case {
        SubpixelLayout layout;
        double aperture_ratio;
        int area;  // of a rectangle, in fine pixels
    };
    for (const Case& each : {Case{SubpixelLayout::rgb_stripe, 0.9, 3 * 11}, Case{SubpixelLayout::rgb_stripe, 0.6, 3 * 10},
                             Case{SubpixelLayout::rgb_rows, 0.6, 10 * 3}, Case{SubpixelLayout::delta, 0.5, 3 * 8},
                             Case{SubpixelLayout::pentile_rgbg, 0.7, 5 * 10}, Case{SubpixelLayout::none, 0.4, 8 * 7}}) {
        Display d = example();
        d.panel.subpixels = each.layout;
        d.panel.aperture_ratio = each.aperture_ratio;
        d.panel.pixels = {8, 8};
        const FinePanel fine = fine_panel(d);
        const Texels image = fine_image(fine, uniform_panel(d, 1));
        const auto light = [&](std::int64_t x, std::int64_t y, int c) { return image.data()[4 * (y * image.columns() + x) + c]; };
        int lit = 0, touched = 0;
        double mean = 0;
        for (std::int64_t y = 24; y < 48; ++y)
            for (std::int64_t x = 24; x < 48; ++x) {
                mean += double(light(x, y, 1)) / (24 * 24);
                if (light(x, y, 1) == 0) continue;
                ++lit;
                for (const int other : {0, 2})
                    if (each.layout != SubpixelLayout::none)
                        touched +=
                            light(x - 1, y, other) + light(x + 1, y, other) + light(x, y - 1, other) + light(x, y + 1, other) > 0;
            }
        EXPECT_EQ(lit, 4 * each.area) << word(each.layout) << each.aperture_ratio;
        EXPECT_EQ(touched, 0) << word(each.layout) << each.aperture_ratio;
        EXPECT_NEAR(mean, fine.light, 1e-6);
    }
}

// The first ratio is that of means: 3/12 x 10/12, as red's subpixels are 1. The last one is that of lit points: 0.6 / 3.
TEST(FinePanel, SaysHowRoundingChangesLight) {
    Display d = example();
    d.panel.subpixels = SubpixelLayout::rgb_stripe;
    d.panel.aperture_ratio = 0.6;
    EXPECT_THAT(fine_panel(d).deviations,
                testing::ElementsAre(
                    "The panel's light is 0.2083 times the display's in the mean, so that its brightest subpixels are at most 1.",
                    "Subpixels are rounded to 1/12 of a pixel: their area is 1.042 times the display's, and where they are "
                    "lit, their light 0.2 times."));
}

TEST(FinePanel, OfAPanelThatShinesAllOverIsThatPanel) {
    const FinePanel fine = fine_panel(example());
    EXPECT_EQ(fine.times, 1);
    EXPECT_EQ(fine.display, example());
    EXPECT_TRUE(fine.deviations.empty());
}

TEST(FinePanel, HasALimit) {
    Display d = example();
    d.panel.pixels = {20000, 10000};
    d.panel.subpixels = SubpixelLayout::delta;
    EXPECT_THROW(fine_panel(d), InputError);
}

}  // namespace
}  // namespace lfdsim
