// The panel's mean light over a box of any size against the sum over its pixels in double precision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/estimator/box_means.h"
#include "engine/estimator/panel_planes.h"
#include "example.h"

namespace lfdsim::optics {
namespace {

constexpr std::uint32_t base_column = 40, base_row = 30;

template <class Light>
Texels panel(int columns, int rows, Light light) {
    Texels texels(columns, rows);
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c)
            for (int k = 0; k < 4; ++k) texels.row(r)[4 * c + k] = k < 3 ? float(light(c, r, k)) : 0;
    return texels;
}

/// Places count from the panel's corner.
struct Box {
    double column, row, wide, high;
};

std::array<float, 4> light_of(const SummedPanel& panel, const Box& box) {
    Light<float> light;
    add_boxes(planes_of(panel)[0], PanelBase<float>{base_column, base_row, 0, 0},
              Boxes<float>{float(box.column - base_column), float(box.row - base_row), float(box.wide), float(box.high), 1.0f},
              light);
    return {light.sum[0], light.sum[1], light.sum[2], light.sum[3]};
}

double mean_over(Texels& texels, const Box& box, int colour) {
    const auto part = [](double middle, double size, std::int64_t pixel) {
        return std::max(std::min(middle + size / 2, double(pixel) + 1) - std::max(middle - size / 2, double(pixel)), 0.0);
    };
    double sum = 0;
    for (std::int64_t r = 0; r < texels.rows(); ++r) {
        const double down = part(box.row, box.high, r);
        if (down == 0) continue;
        for (std::int64_t c = 0; c < texels.columns(); ++c)
            sum += part(box.column, box.wide, c) * down * double(texels.row(r)[4 * c + colour]);
    }
    return sum / (box.wide * box.high);
}

/// Lengths from `least` to `most`, as many of each order of magnitude.
double length(Random& random, double least, double most) { return least * std::pow(most / least, random(0, 1)); }

TEST(Boxes, HaveTheMeanOfTheirPixels) {
    Random random(3);
    Texels texels = panel(200, 90, [&](int, int, int) { return random(0, 1); });
    const SummedPanel summed(texels);
    double largest = 0;
    for (int n = 0; n < 2000; ++n) {
        const Box box{random(-5, 205), random(-5, 95), length(random, 0.002, 300), length(random, 0.002, 300)};
        const double error = std::abs(double(light_of(summed, box)[1]) - mean_over(texels, box, 1));
        // Places are given in single precision: 1e-5 pixels of 200, which counts by the width of the box.
        largest = std::max(largest, error * std::min(std::min(box.wide, box.high), 1.0));
    }
    EXPECT_LT(largest, 3e-5);
}

// A narrow box is as exact as a wide one, and of black there is nothing, not even rounding.
TEST(Boxes, OfOneLightHaveThatLight) {
    for (const double level : {0.0, 3.0350e-4, 1.0}) {
        Texels texels = panel(200, 90, [&](int c, int, int) { return c < 100 ? 1 : level; });
        const SummedPanel summed(texels);
        Random random(5);
        for (int n = 0; n < 500; ++n) {
            const Box box{random(130, 170), random(20, 70), length(random, 0.001, 59), length(random, 0.001, 39)};
            // A step of the table is 2e-6.
            if (level == 0 || level == 1)
                EXPECT_NEAR(light_of(summed, box)[0], level, level * 1e-6) << box.wide << " x " << box.high;
            else
                EXPECT_NEAR(light_of(summed, box)[0], level, 1e-6) << box.wide << " x " << box.high;
        }
    }
}

// Light above white takes coarser steps, none of which is lost.
TEST(Boxes, OfLightAboveWhite) {
    Random random(6);
    Texels texels = panel(60, 50, [&](int, int, int) { return random(0, 1000); });
    const SummedPanel summed(texels);
    for (int n = 0; n < 200; ++n) {
        const Box box{random(0, 60), random(0, 50), length(random, 1.1, 80), length(random, 1.1, 80)};
        EXPECT_NEAR(light_of(summed, box)[2], mean_over(texels, box, 2), 0.02);
    }
}

// Beyond 2^31 units a box is cut: white would come out dark, or negative.
TEST(Boxes, OfMoreThanATableHoldsAreCut) {
    Texels texels = panel(2100, 1200, [](int c, int r, int k) {
        return k == 0 ? 1 : k == 1 ? (c + 0.5) / 2100 : (r / 40 + c / 40) % 2;
    });
    const SummedPanel summed(texels);
    for (const Box& box :
         {Box{1000, 600, 64, 64}, {1000, 600, 65.5, 64}, {1000, 600, 1, 1190}, {1050, 600, 2090, 3}, {1000, 600, 700, 900}}) {
        const auto light = light_of(summed, box);
        EXPECT_NEAR(light[0], 1, 1e-5) << box.wide << " x " << box.high;
        EXPECT_NEAR(light[1], mean_over(texels, box, 1), 1e-4) << box.wide << " x " << box.high;
        EXPECT_NEAR(light[2], mean_over(texels, box, 2), 1e-4) << box.wide << " x " << box.high;
    }
    // Pieces stand for what lies between them: 16 x 16 of 64 x 64 pixels.
    const Box all{1050, 600, 2100, 1200};
    EXPECT_NEAR(light_of(summed, all)[1], 0.5, 1e-4);
    EXPECT_NEAR(light_of(summed, all)[2], mean_over(texels, all, 2), 0.03);
    const Box beyond{1050, 600, 8400, 1200};
    EXPECT_NEAR(light_of(summed, beyond)[0], 0.25, 1e-4);
}

TEST(Boxes, BesideThePanelAreBlack) {
    const Texels texels = panel(200, 90, [](int, int, int) { return 1; });
    const SummedPanel summed(texels);
    for (const double size : {0.0, 0.5, 3.0, 40.0}) {
        for (const auto& [column, row] : {std::pair{-1e3, 20.0}, {1e3, 20.0}, {20.0, -1e3}, {20.0, 1e3}, {-1e30, 0.0}}) {
            const float light = light_of(summed, {column, row, size, size})[0];
            EXPECT_EQ(light, 0) << size << " at " << column << ", " << row;
        }
    }
    EXPECT_LT(light_of(summed, {-1e3, 20, 1e30, 1e30})[0], 1e-20);
}

}  // namespace
}  // namespace lfdsim::optics
