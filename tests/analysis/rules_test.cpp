#include "analysis/rules.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// From -20 to 20 in steps of 1.
template <class Value>
Curve curve(Value value, double error = 0) {
    Curve c{{}, {}, error};
    for (int k = -20; k <= 20; ++k) {
        c.at.push_back(k);
        c.value.push_back(value(double(k)));
    }
    return c;
}

TEST(Rules, ThresholdIsInterpolatedAndCarriesTheCurvesError) {
    const Curve tent = curve([](double x) { return 1 - 0.02 * std::abs(x - 1); }, 0.004);
    const Interval i = where_at_least(tent, 0, 0.85);
    EXPECT_NEAR(i.low.at, -6.5, 1e-12);
    EXPECT_NEAR(i.high.at, 8.5, 1e-12);
    EXPECT_NEAR(i.high.error, 0.004 / 0.02, 1e-12);
    EXPECT_FALSE(i.empty);
}

TEST(Rules, WithoutACrossingTheIntervalIsUnbounded) {
    const Interval i = where_at_least(curve([](double) { return 0.9; }), 0, 0.85);
    EXPECT_TRUE(std::isnan(i.low.at) && std::isnan(i.high.at));
    EXPECT_TRUE(limits_json(i)[0].is_null());
}

TEST(Rules, TheIntervalIsTheConnectedOne) {
    const Interval i = where_at_least(curve([](double x) { return std::abs(x) == 5 ? 0. : 1.; }), 0, 0.5);
    EXPECT_NEAR(i.low.at, -4.5, 1e-12);
    EXPECT_NEAR(i.high.at, 4.5, 1e-12);
}

TEST(Rules, EmptyWhereTheCentreBreaksTheRule) {
    const Interval i = where_at_least(curve([](double) { return 0.8; }), 0, 0.85);
    EXPECT_TRUE(i.empty);
    EXPECT_EQ(i.low.at, 0);
    EXPECT_EQ(i.high.at, 0);
}

// The slope of 1 - 0.001 x^2 is 0.002 |x|: 0.005 at 2.5, exactly, as slopes stand half-way between places.
TEST(Rules, SteadyWhereSlopesAreSmall) {
    const Interval i = where_steady(curve([](double x) { return 1 - 0.001 * x * x; }), 0, 0.005);
    EXPECT_NEAR(i.low.at, -2.5, 1e-9);
    EXPECT_NEAR(i.high.at, 2.5, 1e-9);
}

TEST(Rules, EdgeIsHalfWayDownTheFall) {
    // from 1 to 0.2 between 10 and 14 on the right, between -7 and -9 on the left
    const auto fall = [](double x) { return x > 0 ? std::clamp((14 - x) / 4, 0., 1.) : std::clamp((x + 9) / 2, 0., 1.); };
    const Interval i = where_edge(curve([&](double x) { return 0.2 + 0.8 * fall(x); }, 0.004), 0, 6, 5);
    EXPECT_NEAR(i.low.at, -8, 1e-9);
    EXPECT_NEAR(i.high.at, 12, 1e-9);
    EXPECT_NEAR(i.high.error, 0.004 / 0.2, 1e-9);
}

TEST(Rules, EdgeOfACurveThatRisesBeforeAndFallsOnAfter) {
    const auto value = [](double x) { return std::abs(x) <= 12 ? 0.8 + 0.01 * std::abs(x) : 0.6 - 0.02 * (std::abs(x) - 13); };
    // 0.92 at 12, 0.6 at 13, and 0.5 within 5 beyond: half-way is 0.71
    const Interval i = where_edge(curve(value), 0, 8, 5);
    EXPECT_NEAR(i.high.at, 12 + 0.21 / 0.32, 1e-9);
    EXPECT_NEAR(i.low.at, -i.high.at, 1e-12);
}

TEST(Rules, NoEdgeWhereNothingFallsClearly) {
    const Interval flat = where_edge(curve([](double) { return 0.9; }), 0, 8, 4);
    EXPECT_TRUE(std::isnan(flat.low.at) && std::isnan(flat.high.at));
    const Interval noisy = where_edge(curve([](double x) { return std::abs(x) > 10 ? 0.8 : 0.9; }, 0.03), 0, 8, 4);
    EXPECT_TRUE(std::isnan(noisy.low.at) && std::isnan(noisy.high.at));
}

}  // namespace
}  // namespace lfdsim
