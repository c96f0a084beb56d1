// The light of a panel's channels, and what a display is in light of another wavelength.
#include <gtest/gtest.h>

#include <cmath>

#include "display/colour.h"
#include "example.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

Display glassy(Glass glass) {
    Display d = example();
    d.lens.as<PlanoConvex>().index.reset();
    d.lens.as<PlanoConvex>().glass = std::move(glass);
    return d;
}
Glass named(const char* name) { return shipped_glass(name)->glass; }

// Quadrature with K nodes is exact for polynomials of degree 2 K - 1: moments of the normal distribution.
TEST(Colour, NodesHaveTheMomentsOfTheSpectrum) {
    Display d = example();
    d.panel.primary_widths_nm = {20, 30, 40};
    for (const int K : {2, 3, 5, 8, 17, 32}) {
        d.render.wavelength_samples = K;
        for (int c = 0; c < 3; ++c) {
            const double sigma = (*d.panel.primary_widths_nm)[std::size_t(c)] / (2 * std::sqrt(2 * std::log(2.)));
            const std::vector<Node> nodes = wavelengths_of(d, c);
            ASSERT_EQ(nodes.size(), std::size_t(K));
            double moment = 1;  // (2 m - 1)!!
            for (int m = 0; m < K; ++m, moment *= 2 * m - 1) {
                double even = 0, odd = 0;
                for (const auto& [nm, weight] : nodes) {
                    const double x = (nm - d.panel.wavelengths_nm[std::size_t(c)]) / sigma;
                    even += weight * std::pow(x, 2 * m);
                    odd += weight * std::pow(x, 2 * m + 1);
                }
                EXPECT_NEAR(even / moment, 1, 1e-11) << "K " << K << ", degree " << 2 * m;
                EXPECT_NEAR(odd / moment, 0, 1e-9) << "K " << K << ", degree " << 2 * m + 1;
            }
            for (std::size_t k = 1; k < nodes.size(); ++k) EXPECT_GT(nodes[k].wavelength_nm, nodes[k - 1].wavelength_nm);
        }
    }
}

// The classical nodes: for K = 3 at 0 and sqrt(3) sigma with weights 2/3 and 1/6.
TEST(Colour, ThreeNodes) {
    Display d = example();
    d.panel.primary_widths_nm = {20, 20, 20};
    d.render.wavelength_samples = 3;
    const std::vector<Node> nodes = wavelengths_of(d, 1);
    EXPECT_EQ(nodes[1].wavelength_nm, 549.1);
    EXPECT_NEAR(nodes[1].weight, 2. / 3, 1e-14);
    EXPECT_NEAR(nodes[2].wavelength_nm, 549.1 + std::sqrt(3.) * 20 / 2.3548200450309493, 1e-10);
    EXPECT_NEAR(nodes[2].weight, 1. / 6, 1e-14);
    d.render.wavelength_samples = 1;
    ASSERT_EQ(wavelengths_of(d, 2).size(), 1u);
    EXPECT_EQ(wavelengths_of(d, 2)[0].wavelength_nm, 464.2);
    EXPECT_EQ(wavelengths_of(d, 2)[0].weight, 1);
}

TEST(Colour, OnlyGlassesOnTheWayOfLightDisperse) {
    EXPECT_FALSE(disperses(example()));
    EXPECT_TRUE(disperses(glassy(named("PMMA"))));
    EXPECT_FALSE(disperses(glassy({"", Formula::cauchy, {1.5, 0, 0}})));
    Display d = example_surfaces();
    d.lens.as<SurfaceLens>().surfaces.back() = {-0.129517, 0, {}, 6, 0, {}, named("PC")};  // after the last surface is air
    EXPECT_FALSE(disperses(d));
    d = example_ideal();
    EXPECT_FALSE(disperses(d));
    d.panel.layers = {{1, {}, named("N-BK7")}};
    EXPECT_TRUE(disperses(d));
    d.panel.wavelengths_nm = {550, 550, 550};
    EXPECT_FALSE(disperses(d));
    d.panel.primary_widths_nm = {20, 20, 20};
    d.render.wavelength_samples = 2;
    EXPECT_TRUE(disperses(d));
}

// f = R/(n - 1) at each wavelength; nothing moves, and green is green.
TEST(Colour, PlanoConvexLensAtEachWavelength) {
    const Glass pmma = named("PMMA");
    const Display d = glassy(pmma);
    const Geometry green = resolve(d);
    for (const double nm : {464.2, 486.1327, 549.1, 611.4, 656.2725}) {
        const Geometry g = resolve(d, nm);
        const double n = index_of(pmma, nm), R = 7.28, T = 1 + R - std::sqrt(R * R - 36);
        EXPECT_NEAR(g.focal_length_mm, R / (n - 1), 1e-9);
        EXPECT_NEAR(g.front_principal_mm, green.base_z_mm + T / n, 1e-9);
        EXPECT_NEAR(g.gap_mm, g.front_principal_mm, 1e-9);
        EXPECT_NEAR(g.reduced_vertex_plane_mm, green.base_z_mm + T / n, 1e-9);
        EXPECT_EQ(g.surfaces[0].index_above, n);
        for (std::size_t k = 0; k < g.surfaces.size(); ++k) EXPECT_EQ(g.surfaces[k].z_mm, green.surfaces[k].z_mm);
        EXPECT_EQ(g.base_z_mm, green.base_z_mm);
        EXPECT_EQ(g.top_z_mm, green.top_z_mm);
        EXPECT_EQ(g.vertex_plane_mm, green.vertex_plane_mm);
        EXPECT_EQ(g.content_depth_mm, green.content_depth_mm);
    }
    EXPECT_EQ(green.gap_mm, 16.485);  // as described, for green
    const Geometry again = resolve(d, d.panel.wavelengths_nm[green_channel]);
    EXPECT_EQ(again.gap_mm, green.gap_mm);
    EXPECT_EQ(again.focal_length_mm, green.focal_length_mm);
    EXPECT_EQ(again.front_principal_mm, green.front_principal_mm);
}

// As a display of constant indices: the same surfaces at the same places, of layers and glued lenses, too.
TEST(Colour, AtOneWavelengthNothingMoves) {
    Display layered = glassy(named("PC"));
    layered.panel.layers = {{1.1, {}, named("N-BK7")}, {0.3, 1.47, {}}};
    layered.array.gap_mm = 17;
    Display glued = layered;
    glued.array.gap_mm.reset();
    glued.array.base_z_mm = 1.4;
    Display air = example_surfaces();
    air.lens.as<SurfaceLens>().surfaces[0].index.reset();
    air.lens.as<SurfaceLens>().surfaces[0].glass = named("F2");
    air.glass_catalogues = {"none.agf"};
    for (const Display& d : {glassy(named("PMMA")), layered, glued, air})
        for (const double nm : {464.2, 549.1, 611.4}) {
            const Display one = at_wavelength(d, nm);
            EXPECT_FALSE(disperses(one));
            EXPECT_TRUE(one.glass_catalogues.empty());
            const Geometry wanted = resolve(d, nm), g = resolve(one);
            EXPECT_EQ(g.glued, wanted.glued);
            for (std::size_t k = 0; k < g.surfaces.size(); ++k) {
                EXPECT_NEAR(g.surfaces[k].z_mm, wanted.surfaces[k].z_mm, 1e-12);
                EXPECT_EQ(g.surfaces[k].index_below, wanted.surfaces[k].index_below);
                EXPECT_EQ(g.surfaces[k].index_above, wanted.surfaces[k].index_above);
            }
            for (std::size_t k = 0; k < g.layers.size(); ++k) EXPECT_EQ(g.layers[k].index, wanted.layers[k].index);
            EXPECT_NEAR(g.focal_length_mm, wanted.focal_length_mm, 1e-12);
            EXPECT_NEAR(g.gap_mm, wanted.gap_mm, 1e-12);
        }
}

// 1/f of two touching lenses of N-BK7 and F2, thick: the lensmaker's equation for each, and the distance of their principal planes.
TEST(Colour, DoubletAtEachWavelength) {
    Display d = example_surfaces();
    const double c[] = {0.03, -0.045, -0.02}, t[] = {4, 2};
    d.lens = {
        SurfaceLens{{{c[0], 0, {}, 5, t[0], {}, named("N-BK7")}, {c[1], 0, {}, 5, t[1], {}, named("F2")}, {c[2], 0, {}, 5, 0}}},
        {}};
    for (const double nm : {464.2, 549.1, 611.4}) {
        const double n1 = index_of(named("N-BK7"), nm), n2 = index_of(named("F2"), nm);
        const double p[] = {c[0] * (n1 - 1), c[1] * (n2 - n1), c[2] * (1 - n2)}, e[] = {t[0] / n1, t[1] / n2};
        // Gaussian brackets: power of three refractions apart by reduced distances
        const double power =
            p[0] + p[1] + p[2] - e[0] * p[0] * (p[1] + p[2]) - e[1] * p[2] * (p[0] + p[1]) + e[0] * e[1] * p[0] * p[1] * p[2];
        EXPECT_NEAR(resolve(d, nm).focal_length_mm * power, 1, 1e-12) << nm;
    }
}

TEST(Colour, LayersAndGlueFollowTheWavelength) {
    Display d = glassy(named("PC"));
    d.panel.layers = {{1, 1.5, {}}, {2, {}, named("N-BK7")}};
    d.array.gap_mm.reset();
    d.array.base_z_mm = 3;
    const Geometry green = resolve(d), blue = resolve(d, 464.2);
    ASSERT_TRUE(green.glued && blue.glued);
    EXPECT_EQ(blue.layers[0].index, 1.5);
    EXPECT_EQ(blue.layers[1].index, index_of(named("N-BK7"), 464.2));
    EXPECT_EQ(blue.surfaces.front().index_below, blue.layers[1].index);
    const double R = 7.28, T = 1 + R - std::sqrt(R * R - 36);
    EXPECT_NEAR(blue.gap_mm, 1 / 1.5 + 2 / blue.layers[1].index + T / index_of(named("PC"), 464.2), 1e-9);
    EXPECT_NEAR(green.gap_mm, 1 / 1.5 + 2 / green.layers[1].index + T / index_of(named("PC"), 549.1), 1e-9);
}

TEST(Colour, IndicesWithoutDispersionAreTheSameToTheLastBit) {
    for (Display d : {example(), example_surfaces(), example_ideal()}) {
        d.panel.layers = {{1.1, 1.52, {}}, {0.3, 1.41, {}}};
        const Geometry green = resolve(d), blue = resolve(d, 464.2);
        EXPECT_EQ(blue.gap_mm, green.gap_mm);
        EXPECT_EQ(blue.focal_length_mm, green.focal_length_mm);
        EXPECT_EQ(blue.front_principal_mm, green.front_principal_mm);
        EXPECT_EQ(blue.rear_principal_mm, green.rear_principal_mm);
        EXPECT_EQ(blue.reduced_vertex_plane_mm, green.reduced_vertex_plane_mm);
        EXPECT_EQ(theory(d, blue).central_depth_mm, theory(d, green).central_depth_mm);
    }
}

}  // namespace
}  // namespace lfdsim
