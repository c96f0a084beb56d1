// Panels with subpixels, as other renderers show them: lfdsim's own picture of the finer panel is that of the display.
#include "interchange/peers/fine_panel.h"

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
        const Image wanted = picture(d, shown), got = picture(fine.display, fine_image(fine, d.panel, shown));
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
    const Texels image = fine_image(fine, d.panel, uniform_panel(d, 1));
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
