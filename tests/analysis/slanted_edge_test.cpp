#include "analysis/resolution/slanted_edge.h"
#include "base/constants.h"

#include <gtest/gtest.h>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int width = 120, height = 200;

/// Edges that lean by `slope`, one rising and one falling, behind uneven light with dark stripes, as gaps between lenses. The share
/// of light at a distance to the right of a rising edge is `spread`; a channel is `wider` times as blurred as the one before.
template <class Spread>
std::array<std::vector<double>, 3> mtf_of(double slope, double wider, const std::vector<double>& frequencies,
                                          const Spread& spread) {
    const Edges edges{{{45.3, true}, {105.3, false}}, slope, 28};
    Image picture(width, height), white(width, height);
    const double cosine = 1 / std::sqrt(1 + slope * slope);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const float full = (column + 3 * row) % 17 < 2 ? 0 : float(0.5 + 0.001 * column);
            const double x = column + 0.5 - slope * (row + 0.5), nearer = x < 75.3 ? x - 45.3 : 105.3 - x;
            for (int c = 0; c < 3; ++c) {
                white.at(column, row)[c] = full;
                picture.at(column, row)[c] = full * float(spread(nearer * cosine / std::pow(wider, c)));
            }
        }
    EdgeSpread sum(edges.reach);
    sum.add(edges, picture, white);
    return sum.mtf(frequencies);
}

std::vector<double> frequencies() {
    std::vector<double> all;
    for (int k = 0; k <= 40; ++k) all.push_back(0.0125 * k);
    return all;
}

TEST(SlantedEdge, OfAGaussianIsAGaussian) {
    const std::vector<double> f = frequencies();
    for (const double slope : {-0.09, 0.12})
        for (const auto& curves : {mtf_of(slope, 1.5, f, [](double d) { return 0.5 * std::erfc(-d / std::sqrt(2.) / 0.8); })})
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t k = 0; k < f.size(); ++k) {
                    const double sigma = 0.8 * std::pow(1.5, c);
                    EXPECT_NEAR(curves[c][k], std::exp(-2 * std::pow(pi * sigma * f[k], 2)), 0.01) << c << " at " << f[k];
                }
}

TEST(SlantedEdge, OfABoxIsASinc) {
    const std::vector<double> f = frequencies();
    const auto curves = mtf_of(-0.12, 1, f, [](double d) { return std::clamp(0.5 + d / 5, 0., 1.); });
    for (std::size_t k = 0; k < f.size(); ++k)
        EXPECT_NEAR(curves[1][k], f[k] == 0 ? 1 : std::abs(std::sin(pi * 5 * f[k]) / (pi * 5 * f[k])), 0.01) << f[k];
}

TEST(SlantedEdge, BothSensesBlurTheSameWayRound) {  // a mirrored half would turn e^-d into its real part
    const std::vector<double> f = frequencies();
    const Edges edges{{{40.4, true}, {80.4, false}}, 0.1, 19};
    Image picture(width, height), white(width, height);
    const double cosine = 1 / std::sqrt(1.01);
    const auto right = [](double d) { return d < 0 ? 0 : 1 - std::exp(-d / 2); };  // a blur to the right only
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double x = column + 0.5 - 0.1 * (row + 0.5);
            for (int c = 0; c < 3; ++c) {
                white.at(column, row)[c] = 1;
                picture.at(column, row)[c] = float(right((x - 40.4) * cosine) - right((x - 80.4) * cosine));
            }
        }
    EdgeSpread sum(edges.reach);
    sum.add(edges, picture, white);
    const auto curves = sum.mtf(f);
    for (std::size_t k = 0; k < f.size(); ++k) EXPECT_NEAR(curves[0][k], 1 / std::sqrt(1 + std::pow(4 * pi * f[k], 2)), 0.01);
}

TEST(SlantedEdge, LightAstrayIsLostContrast) {
    const auto curves = mtf_of(0.1, 1, {0, 0.1}, [](double d) { return d > 0 ? 0.85 : 0.15; });
    EXPECT_NEAR(curves[2][0], 0.7, 1e-6);
    EXPECT_NEAR(curves[2][1], 0.7, 0.01);
}

TEST(SlantedEdge, WithoutLightThereIsNoFigure) {
    EdgeSpread sum(10);
    sum.add({{{10, true}}, 0.1, 10}, Image(30, 30), Image(30, 30));
    EXPECT_TRUE(std::isnan(sum.mtf(std::array{0.1})[0][0]));
}

TEST(SlantedEdge, FallsBelowBetweenTwoFrequencies) {
    EXPECT_DOUBLE_EQ(falls_below(std::array{0., 1., 2.}, std::array{1., 0.75, 0.25}, 0.5), 1.5);
    EXPECT_TRUE(std::isnan(falls_below(std::array{0., 1.}, std::array{1., 0.75}, 0.5)));
}

}  // namespace
}  // namespace lfdsim
