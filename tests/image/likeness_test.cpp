#include "image/compare/likeness.h"

#include "image/compare/ssim.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <cmath>

namespace lfdsim {
namespace {

Image columns_and_rows(int width, int height, bool rows) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = rows ? (y % 2 ? 0.9f : 0.2f) : (x % 2 ? 0.8f : 0.1f);
    return image;
}

TEST(Likeness, ShareIsThatOfThePhotographInABlend) {
    const Image photograph = columns_and_rows(40, 30, false), ghost = columns_and_rows(40, 30, true);  // not correlated
    const Region all = Region::of({0, 0, 40, 30});
    for (const float share : {0.f, 0.3f, 1.f}) {
        Image view = photograph;
        for (std::size_t k = 0; k < ghost.rgb.size(); ++k)
            view.rgb[k] = 2 * (share * photograph.rgb[k] + (1 - share) * ghost.rgb[k]);
        EXPECT_NEAR(likeness(view, 0.5f, photograph, all, all).share, share, 1e-6);
    }
}

TEST(Likeness, IsSsimOfEachRegionOnAnyNumberOfThreads) {
    const int width = 203, height = 97;
    Image photograph(width, height), view(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                photograph.at(x, y)[c] = float(0.5 + 0.4 * std::sin(0.2 * x + 0.1 * y * c));
                view.at(x, y)[c] = float(0.5 + 0.3 * std::sin(0.21 * x + 0.1 * y * c));
            }
    const Region screen =
        Region::polygon(std::array<std::array<double, 2>, 4>{{{5, 9}, {190, 2}, {201, 95}, {11, 90}}}, width, height);
    const Region content = Region::of({40, 30, 133, 71});
    const Likeness l = likeness(view, 1, photograph, screen, content);
    const std::vector<double> values = ssim(view, photograph, std::array{screen, content});
    EXPECT_EQ(l.screen, values[0]);
    EXPECT_EQ(l.content, values[1]);
    EXPECT_NE(l.screen, l.content);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Likeness alone = likeness(view, 1, photograph, screen, content);
    EXPECT_EQ(l.screen, alone.screen);
    EXPECT_EQ(l.share, alone.share);
    EXPECT_TRUE(std::isnan(likeness(view, 1, photograph, screen, Region::of({0, 0, 10, 10})).content));
    EXPECT_TRUE(std::isnan(likeness(view, 1, Image(width, height), screen, content).share));
}

}  // namespace
}  // namespace lfdsim
