// The panel's mean light over a box: exact where a box is small, true to slopes where it is wide, black beside the panel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/pyramid.h"
#include "example.h"
#include "optics/boxes.h"

namespace lfdsim::optics {
namespace {

constexpr int panel_columns = 200, panel_rows = 90;

template <class Light>
Texels panel(Light light) {
    Texels texels(panel_columns, panel_rows);
    for (int r = 0; r < panel_rows; ++r)
        for (int c = 0; c < panel_columns; ++c)
            for (int k = 0; k < 4; ++k) texels.row(r)[4 * c + k] = k < 3 ? float(light(c, r, k)) : 0;
    return texels;
}

/// Places count from a base of which column and row are given.
std::array<float, 4> light_of(const Pyramid& pyramid, double column, double row, double wide, double high) {
    const PanelBase<float> base{40, 30, 0, 0};
    float light[1][4];
    static const Emission<float> whole{true, 0, {}};
    const PanelLevels levels = panel_levels(pyramid.levels(), {}, whole);
    light_of_boxes(levels, base, Boxes<float>{float(column - 40), float(row - 30), float(wide), float(high), 1.0f}, light);
    return {light[0][0], light[0][1], light[0][2], light[0][3]};
}

TEST(Footprint, OfASmallBoxIsTheMeanOverIt) {
    Random random(3);
    Texels texels = panel([&](int, int, int) { return random(0, 1); });
    const Pyramid pyramid(texels);
    for (int n = 0; n < 1000; ++n) {
        const double wide = random(0.02, 1), high = random(0.02, 1), column = random(-1, panel_columns + 1),
                     row = random(-1, panel_rows + 1);
        double wanted = 0;
        for (int c = int(std::floor(column)) - 1; c <= int(column) + 1; ++c)
            for (int r = int(std::floor(row)) - 1; r <= int(row) + 1; ++r) {
                if (c < 0 || r < 0 || c >= panel_columns || r >= panel_rows) continue;
                const double across = std::min(column + wide / 2, c + 1.0) - std::max(column - wide / 2, double(c)),
                             down = std::min(row + high / 2, r + 1.0) - std::max(row - high / 2, double(r));
                wanted += std::max(across, 0.0) * std::max(down, 0.0) / (wide * high) * double(texels.row(r)[4 * c + 1]);
            }
        EXPECT_NEAR(light_of(pyramid, column, row, wide, high)[1], wanted, 2e-3)
            << column << ", " << row << ", " << wide << " x " << high;
    }
}

TEST(Footprint, OfAnyWideBoxFollowsASlope) {
    const Texels texels = panel([](int c, int r, int k) { return k == 2 ? (r + 0.5) / panel_rows : (c + 0.5) / panel_columns; });
    const Pyramid pyramid(texels);
    Random random(4);
    for (int n = 0; n < 1000; ++n) {
        const double size = random(2.01, 15.9), column = random(40, 150), row = random(30, 60);
        const auto light = light_of(pyramid, column, row, size, size);
        EXPECT_NEAR(light[0], column / panel_columns, 1e-5) << size;
        EXPECT_NEAR(light[2], row / panel_rows, 1e-5) << size;
        EXPECT_EQ(light[3], 0);
    }
}

TEST(Footprint, BesideThePanelIsBlack) {
    const Texels texels = panel([](int, int, int) { return 1; });
    const Pyramid pyramid(texels);
    for (const double size : {0.0, 0.5, 3.0, 40.0, 1e30}) {
        for (const auto& [column, row] : {std::pair{-1e3, 20.0}, {1e3, 20.0}, {20.0, -1e3}, {20.0, 1e3}, {-1e30, 0.0}}) {
            const float light = light_of(pyramid, column, row, size, size)[0];
            EXPECT_EQ(light, 0) << size << " at " << column << ", " << row;
        }
    }
}

}  // namespace
}  // namespace lfdsim::optics
