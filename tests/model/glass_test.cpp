// Dispersion formulas against indices computed elsewhere, and the glasses that ship against what their makers print.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "display/glass.h"
#include "published_glasses.h"

namespace lfdsim {
namespace {

constexpr double d = 587.5618, F = 486.1327, C = 656.2725;

Glass glass(Formula formula, std::vector<double> coefficients) { return {"", formula, std::move(coefficients)}; }

struct Known {
    const char* name;
    double nd, nF, nC, vd;
};

// Computed from the same coefficients by another program.
TEST(Glass, KnownIndices) {
    for (const Known& k : {Known{"N-BK7", 1.5168000, 1.5223763, 1.5143223, 64.167},
                           {"PMMA", 1.4925274, 1.4983632, 1.4900668, 59.367},
                           {"PC", 1.5854699, 1.5994387, 1.5798638, 29.909},
                           {"PS", 1.5904811, 1.6040785, 1.5849486, 30.867},
                           {"480R", 1.5252790, 1.5318903, 1.5225021, 55.951},
                           {"COP", 1.5311602, 1.5378293, 1.5283518, 56.044},
                           {"COC", 1.5337325, 1.5404826, 1.5309903, 56.228},
                           {"PDMS", 1.4302922, 1.4371075, 1.4274242, 44.436}}) {
        const ShippedGlass* shipped = shipped_glass(k.name);
        ASSERT_TRUE(shipped) << k.name;
        EXPECT_NEAR(index_of(shipped->glass, d), k.nd, 6e-8) << k.name;
        EXPECT_NEAR(index_of(shipped->glass, F), k.nF, 6e-8) << k.name;
        EXPECT_NEAR(index_of(shipped->glass, C), k.nC, 6e-8) << k.name;
        EXPECT_NEAR(abbe_number(shipped->glass), k.vd, 6e-4) << k.name;
    }
}

// Each formula by hand, at a wavelength of half a micrometre: l^2 = 1/4.
TEST(Glass, Formulas) {
    const auto n = [](Formula formula, std::vector<double> c) { return index_of(glass(formula, std::move(c)), 500); };
    EXPECT_DOUBLE_EQ(n(Formula::cauchy, {1.5, 0.01, 0.001}), 1.5 + 0.04 + 0.016);
    EXPECT_DOUBLE_EQ(n(Formula::conrady, {1.4, 0.02, 0.001}), 1.4 + 0.04 + 0.001 * std::pow(2, 3.5));
    const double L = 1 / (0.25 - 0.028);
    EXPECT_DOUBLE_EQ(n(Formula::herzberger, {1.4, 0.01, 0.001, 0.02, 0.03, 0.04}),
                     1.4 + 0.01 * L + 0.001 * L * L + 0.005 + 0.03 / 16 + 0.04 / 64);
    EXPECT_DOUBLE_EQ(n(Formula::sellmeier, {1, 0.05, 0.5, -0.75}), std::sqrt(1 + 0.25 / 0.2 + 0.125));
    EXPECT_DOUBLE_EQ(n(Formula::resonances, {2, 1, 0.05}), std::sqrt(2 + 0.25 / 0.2));
    EXPECT_DOUBLE_EQ(n(Formula::sellmeier_2, {0.2, 1, 0.1, 0.3, 0.2}), std::sqrt(1.2 + 0.25 / 0.24 + 0.3 / 0.21));
    EXPECT_DOUBLE_EQ(n(Formula::handbook_1, {2, 0.01, 0.05, 0.02}), std::sqrt(2 + 0.05 - 0.005));
    EXPECT_DOUBLE_EQ(n(Formula::handbook_2, {1.5, 1, 0.05, 0.02}), std::sqrt(1.5 + 1.25 - 0.005));
    EXPECT_DOUBLE_EQ(n(Formula::power_series, {2, 0, 0.1, 2, 0.01, -2, 0.001, -8}), std::sqrt(2 + 0.025 + 0.04 + 0.256));
    EXPECT_TRUE(std::isnan(n(Formula::unknown, {1.5})));
    EXPECT_TRUE(std::isnan(n(Formula::herzberger, {1.4})));
}

TEST(Glass, IndexAndAbbeNumberAreMet) {
    const Glass pmma = glass(Formula::nd_vd, {1.4918, 57.4});
    EXPECT_DOUBLE_EQ(index_of(pmma, d), 1.4918);
    EXPECT_NEAR(index_of(pmma, F) - index_of(pmma, C), 0.4918 / 57.4, 1e-15);
    EXPECT_NEAR(abbe_number(pmma), 57.4, 1e-10);
    // A + B/l^2: linear in the inverse square
    const auto x = [](double nm) { return 1 / (nm * nm); };
    const double slope = (index_of(pmma, F) - index_of(pmma, C)) / (x(F) - x(C));
    EXPECT_NEAR(index_of(pmma, 611.4), 1.4918 + slope * (x(611.4) - x(d)), 1e-14);
}

TEST(Glass, ShipsAsPrinted) {
    for (const PublishedGlass& p : published_glasses) {
        const ShippedGlass* shipped = shipped_glass(p.name);
        ASSERT_TRUE(shipped) << p.name;
        EXPECT_NEAR(index_of(shipped->glass, d), p.nd, 6e-6) << p.name;
        EXPECT_NEAR(abbe_number(shipped->glass), p.vd, 0.009) << p.name;
    }
    // what has no maker's figures: indices of tables of physics, to their digits
    EXPECT_NEAR(index_of(shipped_glass("WATER")->glass, 589.3), 1.33299, 2e-5);  // against air
    EXPECT_NEAR(index_of(shipped_glass("B270")->glass, d), 1.5230, 1e-4);
    EXPECT_NEAR(abbe_number(shipped_glass("B270")->glass), 58.5, 0.1);
    EXPECT_NEAR(index_of(shipped_glass("SILICA")->glass, d), 1.45846, 6e-6);
    EXPECT_NEAR(abbe_number(shipped_glass("SILICA")->glass), 67.82, 0.01);
    EXPECT_NEAR(index_of(shipped_glass("CAF2")->glass, d), 1.43385, 1e-5);
    EXPECT_NEAR(abbe_number(shipped_glass("CAF2")->glass), 94.99, 0.02);
}

TEST(Glass, EachIsOneOfItsNameAndHoldsInItsRange) {
    std::set<std::string> names;
    std::size_t figures = 0;
    for (const auto& [glass, source, successor] : shipped_glasses()) {
        EXPECT_TRUE(names.insert(glass.name).second) << glass.name;
        EXPECT_FALSE(source.empty()) << glass.name;
        EXPECT_EQ(shipped_glass(glass.name)->glass, glass);
        if (!successor.empty()) {
            Glass named = shipped_glass(successor)->glass;
            named.name = glass.name;
            EXPECT_EQ(named, glass);
        }
        for (int k = 0; k <= 100; ++k) {
            const double nm = glass.range_nm[0] + (glass.range_nm[1] - glass.range_nm[0]) * k / 100, n = index_of(glass, nm);
            EXPECT_TRUE(n > 1.1 && n < 2.5) << glass.name << " at " << nm << " nm: " << n;
        }
        for (const double nm : {464.2, 549.1, 611.4}) EXPECT_TRUE(glass.covers(nm)) << glass.name;
        ++figures;
    }
    EXPECT_GE(figures, 60u);
}

TEST(Glass, NamesInAnyCase) {
    EXPECT_EQ(shipped_glass("n-bk7"), shipped_glass("N-BK7"));
    EXPECT_EQ(shipped_glass("pmma")->glass.name, "PMMA");
    EXPECT_EQ(index_of(shipped_glass("BK7")->glass, d), index_of(shipped_glass("N-BK7")->glass, d));
    EXPECT_FALSE(shipped_glass(""));
    EXPECT_FALSE(shipped_glass("N-BK"));
}

}  // namespace
}  // namespace lfdsim
