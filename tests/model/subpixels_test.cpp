// Subpixels: where each colour shines, how bright, and for what place its content is made.
#include "geometry/subpixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "example.h"
#include "panels.h"

namespace lfdsim {
namespace {

Panel panel(SubpixelLayout layout, double aperture_ratio = 1) {
    Panel p = with_subpixels(example().panel, layout);
    p.aperture_ratio = aperture_ratio;
    return p;
}

std::vector<Panel> every_layout() {
    std::vector<Panel> all{panel(SubpixelLayout::custom, 0.8)};
    for (const double ratio : {1.0, 0.5})
        for (const SubpixelLayout layout : {SubpixelLayout::none, SubpixelLayout::rgb_stripe, SubpixelLayout::bgr_stripe,
                                            SubpixelLayout::rgb_rows, SubpixelLayout::pentile_rgbg, SubpixelLayout::delta})
            all.push_back(panel(layout, ratio));
    return all;
}

TEST(Subpixels, OfWhiteAreWhiteInTheMean) {
    for (const Panel& p : every_layout()) {
        double mean[3] = {}, shares[3] = {};
        for (const LitPart& part : lit_parts(p)) {
            const double area = (part.to[0] - part.from[0]) * (part.to[1] - part.from[1]),
                         cell = part.plane.cell[0] * part.plane.cell[1];
            for (int c = 0; c < 3; ++c) {
                if (part.channel != 3 && part.channel != c) continue;
                mean[c] += gain(p, c) * area / cell;
                shares[c] += part.share;
            }
            for (std::size_t k = 0; k < 2; ++k) {
                EXPECT_GE(part.from[k], 0);
                EXPECT_LE(part.to[k], part.plane.cell[k]);
            }
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(mean[c], 1, 1e-12) << int(p.subpixels) << " " << c;
            EXPECT_NEAR(shares[c], 1, 1e-12);
        }
    }
    EXPECT_DOUBLE_EQ(gain(panel(SubpixelLayout::rgb_stripe, 0.5), 0), 6);
    EXPECT_DOUBLE_EQ(gain(panel(SubpixelLayout::pentile_rgbg), 1), 2);
    EXPECT_DOUBLE_EQ(peak(panel(SubpixelLayout::pentile_rgbg, 0.5)), 8);
    EXPECT_DOUBLE_EQ(peak(panel(SubpixelLayout::none, 0.25)), 4);
}

TEST(Subpixels, RepeatAfterTheLeastCell) {
    const auto cells = [](const Panel& p, int channel) {
        std::vector<std::array<int, 2>> all;
        for (const LitPart& part : lit_parts(p))
            if (part.channel == channel) all.push_back(part.plane.cell);
        return all;
    };
    using Cells = std::vector<std::array<int, 2>>;
    const Panel pentile = panel(SubpixelLayout::pentile_rgbg);
    EXPECT_EQ(cells(pentile, 1), Cells(1, {1, 1}));  // green is the same in each pixel
    EXPECT_EQ(cells(pentile, 0), Cells(2, {2, 2}));
    EXPECT_EQ(cells(panel(SubpixelLayout::delta), 0), Cells(2, {1, 2}));
    EXPECT_EQ(cells(panel(SubpixelLayout::delta), 1), Cells(3, {1, 2}));  // that of odd rows hangs over
    EXPECT_EQ(planes(pentile).size(), 1u + 4);                            // the panel; two pixels each of red and blue
    EXPECT_EQ(planes(pentile)[0], PanelPlane());
    EXPECT_EQ(planes(panel(SubpixelLayout::rgb_stripe)).size(), 1u);

    // A cell of 2 x 3 pixels of stripes is one of 1 x 1.
    Panel doubled = panel(SubpixelLayout::custom);
    doubled.custom.clear();
    doubled.subpixel_cell = {2, 3};
    for (std::int64_t i = 0; i < 2; ++i)
        for (std::int64_t j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                doubled.custom.push_back(
                    {Channel(k), {i, j}, {double(i) + k / 3.0, double(j), double(i) + (k + 1) / 3.0, double(j) + 1}});
    EXPECT_EQ(cells(doubled, 2), Cells(1, {1, 1}));
}

TEST(Subpixels, AreShownAtTheirCentroids) {
    using Point = std::array<double, 2>;
    const auto near = [](double x, double y) {
        return testing::Optional(testing::ElementsAre(testing::DoubleNear(x, 1e-12), testing::DoubleNear(y, 1e-12)));
    };
    EXPECT_THAT(centroid(panel(SubpixelLayout::rgb_stripe), 0, 5, 7), near(-1.0 / 3, 0));
    EXPECT_THAT(centroid(panel(SubpixelLayout::bgr_stripe), 0, 5, 7), near(1.0 / 3, 0));
    EXPECT_THAT(centroid(panel(SubpixelLayout::rgb_rows), 2, 5, 7), near(0, 1.0 / 3));
    const Panel pentile = panel(SubpixelLayout::pentile_rgbg, 0.6), delta = panel(SubpixelLayout::delta);
    EXPECT_THAT(centroid(pentile, 0, 4, 2), near(-0.25, 0));
    EXPECT_EQ(centroid(pentile, 0, 5, 2), std::nullopt);
    EXPECT_THAT(centroid(pentile, 2, 5, 2), near(-0.25, 0));
    EXPECT_THAT(centroid(pentile, 1, 5, 3), near(0.25, 0));
    EXPECT_THAT(centroid(delta, 2, 9, 0), near(1.0 / 3, 0));
    EXPECT_THAT(centroid(delta, 2, 9, 1), near(5.0 / 6, 0));
    EXPECT_EQ(centroid(panel(SubpixelLayout::none, 0.3), 1, 3, 3), Point{});
    EXPECT_THAT(centroid(panel(SubpixelLayout::custom), 2, 2, 1), near(-0.5, 0));
}

}  // namespace
}  // namespace lfdsim
