// The polynomials of elementary.h against the library's functions, with the bounds that their comments state.
#include <gtest/gtest.h>

#include "example.h"

namespace lfdsim::optics {
namespace {

constexpr int grid_steps = 2000000;
double step(double low, double high, int i) { return double(float(low + (high - low) * i / grid_steps)); }

TEST(Elementary, SineAndCosine) {
    double worst = 0;
    for (int i = 0; i <= grid_steps; ++i) {
        const double a = step(-std::numbers::pi / 2, std::numbers::pi / 2, i);
        float sine, cosine;
        sincos(float(a), false, sine, cosine);
        worst = std::max({worst, std::abs(sine - std::sin(a)), std::abs(cosine - std::cos(a))});
    }
    EXPECT_LT(worst, 1.3e-7);
}

TEST(Elementary, SineAndCosineOfSmallAngles) {
    double worst = 0;
    for (int i = 0; i <= grid_steps; ++i) {
        const double a = step(-0.05, 0.05, i);
        float sine, cosine;
        sincos(float(a), true, sine, cosine);
        worst = std::max({worst, std::abs(sine - std::sin(a)), std::abs(cosine - std::cos(a))});
    }
    EXPECT_LT(worst, 1e-7);
}

TEST(Elementary, Logarithm) {
    double worst = 0;
    for (int i = 0; i <= grid_steps; ++i) {
        for (double a : {step(0.4, 2.5, i), std::exp2(step(-120, 120, i))}) {
            const double wanted = std::log2(double(float(a)));
            worst = std::max(worst, std::abs(log2(float(a)) - wanted) / std::max(1.0, std::abs(wanted)));
        }
    }
    EXPECT_LT(worst, 2e-7);
    EXPECT_EQ(log2(1.0f), 0.0f);
}

TEST(Elementary, Exponential) {
    double worst = 0;
    for (int i = 0; i <= grid_steps; ++i) {
        const double a = step(-126, 126, i), wanted = std::exp2(a);
        worst = std::max(worst, std::abs(exp2(float(a)) - wanted) / wanted);
    }
    EXPECT_LT(worst, 2.5e-7);
    EXPECT_EQ(exp2(-1000.0f), exp2(-126.0f));
    EXPECT_EQ(exp2(1000.0f), exp2(126.0f));
}

// cos^m = 2^(m log2 cos): the logarithm's error and the product's rounding (6e-8), times m ln 2 |log2 cos|, and the exponential's,
// which does not go below 2^-126.
TEST(Elementary, Power) {
    for (float m : {0.25f, 1.0f, 2.0f, 3.5f, 20.0f}) {
        for (int i = 1; i <= 20000; ++i) {
            const double cosine = double(float(i / 20000.0)), wanted = std::pow(cosine, double(m));
            const double relative = 2.5e-7 + double(m) * std::numbers::ln2 * 2.6e-7 * std::max(1.0, std::abs(std::log2(cosine)));
            ASSERT_NEAR(double(power(float(cosine), m)), wanted, wanted * relative + 0x1p-126) << cosine << "^" << m;
        }
    }
    EXPECT_EQ(power(0.3f, 1.0f), 0.3f);
    EXPECT_EQ(power(0.3, 2.5), std::pow(0.3, 2.5));
}

// Against the library's erf: erf(y) - x, divided by the slope, is the error of y.
double error_of(double y, double x) { return (std::erf(y) - x) / (2 / std::sqrt(std::numbers::pi) * std::exp(-y * y)); }

TEST(Elementary, InverseErrorFunction) {
    double worst = 0, worst_double = 0;
    for (int i = 1; i < grid_steps; ++i) {
        const double x = step(-0.99999, 0.99999, i);
        if (x == 0) continue;
        const double y = double(erfinv(float(x)));
        worst = std::max(worst, std::abs(error_of(y, x) / y));
        if (i % 10 == 0) worst_double = std::max(worst_double, std::abs(error_of(erfinv(x), x) / erfinv(x)));
    }
    EXPECT_LT(worst, 1e-6);
    EXPECT_LT(worst_double, 1e-10);  // erf itself cancels near 1: 1e-16 / 1e-5
    EXPECT_EQ(erfinv(0.0f), 0.0f);
}

TEST(Elementary, InverseErrorFunctionIsFiniteAndOddAtItsEnds) {
    for (float x : {1.0f, 2.0f}) {
        EXPECT_GT(erfinv(x), 3.5f);
        EXPECT_LT(erfinv(x), 4.0f);
        EXPECT_EQ(erfinv(-x), -erfinv(x));
        EXPECT_NEAR(erfinv(double(x)), double(erfinv(x)), 1e-4);
    }
}

}  // namespace
}  // namespace lfdsim::optics
