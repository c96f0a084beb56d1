#include "analysis/fov/thresholds.h"

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
    EXPECT_NEAR(i.high.error, std::hypot(0.004 / 0.02, 0.5), 1e-12);  // and half a step
    EXPECT_FALSE(i.empty);
}

// An interval about 10 whose lower end, 8, is known to 5 only: it is no place below 0, and does not reach there.
TEST(Rules, AnUncertainEndStaysOnItsSide) {
    Curve c{{-10, 0, 5, 10, 15, 20}, {0.2, 0.3, 0.7, 1, 0.9, 0.2}, 0.3};
    const Interval i = where_at_least(c, 10, 0.85);
    ASSERT_TRUE(std::isnan(i.low.at));
    EXPECT_NEAR(i.low.place(), 7.5, 1e-12);
    EXPECT_FALSE(i.low.searched_out);
    EXPECT_TRUE(on_side_of_zero(i, false, "none").empty);
    EXPECT_TRUE(std::isnan(on_side_of_zero(i, true, "none").low.at));
    c.value = {0.9, 0.9, 0.9, 1, 0.9, 0.9};
    const Interval all = where_at_least(c, 10, 0.85);
    EXPECT_TRUE(all.low.searched_out && all.high.searched_out);
    const Interval below = on_side_of_zero(all, false, "none");
    EXPECT_TRUE(std::isnan(below.low.at));
    EXPECT_EQ(below.high.at, 0);
}

TEST(Rules, WithoutACrossingItSaysHowFarItWasSearched) {
    const Interval i = where_at_least(curve([](double) { return 0.9; }), 0, 0.85);
    EXPECT_TRUE(std::isnan(i.low.at) && std::isnan(i.high.at));
    EXPECT_TRUE(std::isnan(figure_of(i).numbers[0]));
    EXPECT_NE(i.high.missing.find("20"), std::string::npos);
}

TEST(Rules, AnErrorAsLargeAsTheFigureLeavesNone) {
    const Interval i = known({{-0.5, 0.5, {}}, {2.5, 0.5, {}}}, 0), aside = known({{8, 1, {}}, {11, 1.5, {}}}, 10);
    EXPECT_TRUE(std::isnan(i.low.at) && std::isnan(i.low.error) && std::isnan(aside.high.at));
    EXPECT_NE(i.low.missing.find("than its error of 0.5"), std::string::npos);
    EXPECT_EQ(i.high.at, 2.5);
    EXPECT_EQ(aside.low.at, 8);
    EXPECT_EQ(known({{0, 0, {}}, {1, 0, {}}}, 0).low.at, 0);  // an end that is known, at the centre
}

TEST(Rules, TheIntervalIsTheConnectedOne) {
    const Interval i = where_at_least(curve([](double x) { return std::abs(x) == 5 ? 0. : 1.; }), 0, 0.5);
    EXPECT_NEAR(i.low.at, -4.5, 1e-12);
    EXPECT_NEAR(i.high.at, 4.5, 1e-12);
}

TEST(Rules, EmptyWhereTheCentreBreaksTheRule) {
    const Interval i = where_at_least(curve([](double) { return 0.8; }), 0, 0.85);
    EXPECT_TRUE(i.empty);
    EXPECT_TRUE(std::isnan(i.low.at) && std::isnan(i.high.at));
    EXPECT_FALSE(i.low.missing.empty());
}

// The slope of 1 - 0.001 x^2 is 0.002 |x|: 0.005 at 2.5, exactly, as slopes stand half-way between places.
TEST(Rules, SteadyWhereSlopesAreSmall) {
    const Interval i = where_steady(curve([](double x) { return 1 - 0.001 * x * x; }), 0, 0.005);
    EXPECT_NEAR(i.low.at, -2.5, 1e-9);
    EXPECT_NEAR(i.high.at, 2.5, 1e-9);
}

TEST(Rules, EdgeIsHalfWayDownTheFall) {
    // from 1 to 0.2 between 9 and 13 on the right, between -9 and -13 on the left
    const auto fall = [](double x) { return std::clamp((13 - std::abs(x)) / 4, 0., 1.); };
    const Interval i = where_it_falls(curve([&](double x) { return 0.2 + 0.8 * fall(x); }, 0.004), {-10.5, 10.5, 3});
    EXPECT_NEAR(i.low.at, -11, 1e-9);
    EXPECT_NEAR(i.high.at, 11, 1e-9);
    // noise, half a step, and half a degree from where it was expected
    EXPECT_NEAR(i.high.error, std::hypot(0.004 / 0.2, 0.5, 0.5), 1e-9);
}

TEST(Rules, WhatLiesToOneSideIsInTheError) {
    const Interval i = where_it_falls(curve([](double x) { return x > -9 && x < 11 ? 1. : 0.; }), {-10, 10, 2});
    EXPECT_NEAR(i.low.at, -9 + 0.5, 0.51);
    EXPECT_NEAR(i.low.error, std::hypot(0.5, i.low.at + 10, 0.5 * (i.low.at + i.high.at)), 1e-9);
}

// A steeper fall elsewhere, as where a scene leaves the screen or a repeated view begins, is not the one looked for.
TEST(Rules, AFallElsewhereIsNone) {
    const auto value = [](double x) { return std::abs(x) < 2.5 ? 1. : std::abs(x) < 15.5 ? 0.5 : 0.3; };
    const Interval i = where_it_falls(curve(value), {-15, 15, 2});
    EXPECT_NEAR(i.high.at, 15.5, 1e-9);
    const Interval none = where_it_falls(curve(value), {-9, 9, 2});
    EXPECT_TRUE(std::isnan(none.low.at));
    EXPECT_NE(none.high.missing.find("no clear fall"), std::string::npos);
}

TEST(Rules, AFallThatIsNotSustainedIsNone) {
    const auto value = [](double x) { return std::abs(x) < 9.5 ? 1. : std::abs(x) == 12 ? 0.9 : 0.2; };
    const Interval i = where_it_falls(curve(value), {-10, 10, 2});
    EXPECT_TRUE(std::isnan(i.high.at));
    EXPECT_NE(i.high.missing.find("3 times"), std::string::npos);
}

TEST(Rules, NoEdgeWhereNothingFallsClearly) {
    const Interval flat = where_it_falls(curve([](double) { return 0.9; }), {-10, 10, 2});
    EXPECT_TRUE(std::isnan(flat.low.at) && std::isnan(flat.high.at));
    const Interval noisy = where_it_falls(curve([](double x) { return std::abs(x) > 10 ? 0.8 : 0.9; }, 0.03), {-10, 10, 2});
    EXPECT_TRUE(std::isnan(noisy.low.at) && std::isnan(noisy.high.at));
    const Interval outside = where_it_falls(curve([](double x) { return std::abs(x) > 19 ? 0. : 1.; }), {-19, 19, 2});
    EXPECT_NE(outside.high.missing.find("too few"), std::string::npos);
}

}  // namespace
}  // namespace lfdsim
