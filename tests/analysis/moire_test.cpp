// The pattern of lenses and pixels: theory against published numbers, and what single rays find against theory.
#include <gtest/gtest.h>

#include "analysis/core/measure.h"
#include "analysis/moire/eye_filter.h"
#include "analysis/moire/moire_theory.h"
#include "analysis/moire/white_lines.h"
#include "analysis/resolution/fourier.h"
#include "base/constants.h"

namespace lfdsim {
namespace {

/// Thin lenses in focus that fill their cells, before a panel of 40 mm, half of it black; the camera at `away` from the lenses.
Display in_focus(LatticeKind lattice, double pitch, double gap, double pixel, double away) {
    Display d;
    d.panel.pixel_pitch_mm = pixel;
    d.panel.pixels = {std::int64_t(40 / pixel), std::int64_t(40 / pixel)};
    d.panel.aperture_ratio = 0.5;
    d.lens.kind = IdealLens{{}, gap};
    d.array.lattice = lattice;
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, away + gap};
    d.camera.resolution = {200, 200};
    return d;
}

double apart_deg(double a, double b) { return std::abs(std::remainder(a - b, 180)); }

// Found by Fourier transforms of rendered pictures, within their bins: two of cylindrical lenses, two of square cells.
TEST(MoireTheory, BeatsAreThoseOfFourierTransforms) {
    const auto beat = [](Display d, double turn) {
        d.array.rotation_deg = turn;
        return MoireTheory(d, resolve(d), d.camera.position_mm[2]).beat(1, 0);
    };
    const Frequency a = beat(in_focus(LatticeKind::strips, 0.483, 0.66, 0.0784, 650), -7.89);
    EXPECT_NEAR(a[0], 0.467, 0.0083);
    EXPECT_NEAR(a[1], 1.708, 0.0083);
    const Frequency b = beat(in_focus(LatticeKind::strips, 1.003, 2.5, 0.2451, 700), 9.46);
    EXPECT_NEAR(b[0], 0.158, 0.0083);
    EXPECT_NEAR(b[1], -0.658, 0.0083);
    const Frequency c = beat(in_focus(LatticeKind::square, 0.961, 3.2, 0.24, 600), 0);
    EXPECT_NEAR(std::abs(c[0]), 0.02614, 0.0033);
    EXPECT_NEAR(c[1], 0, 1e-12);
    const Frequency e = beat(in_focus(LatticeKind::square, 0.961, 3.2, 0.24, 600), 3);
    EXPECT_NEAR(e[0], 0.0327, 0.0033);
    EXPECT_NEAR(e[1], -0.2092, 0.026);
}

// The lens lattice of hexagons: its harmonics are 60 degrees apart, 2/(sqrt(3) p) long.
TEST(MoireTheory, HexagonsHaveTheirReciprocalLattice) {
    const double p = 1, pixel = 0.5 * std::sqrt(3.) * p / 4;  // pixels along y fit the rows but for the eye's distance
    const Display d = in_focus(LatticeKind::hexagon, p, 2, pixel, 1000);
    const Frequency f = MoireTheory(d, resolve(d), 1002).beat(0, -1);  // rows count downwards
    EXPECT_NEAR(f[0], 0, 1e-12);
    EXPECT_NEAR(f[1], 0.002 / pixel, 1e-9);
}

TEST(Moire, TransformIsThatOfItsDefinition) {
    constexpr int n = 8;
    std::vector<std::complex<double>> v;
    for (int k = 0; k < n * n; ++k) v.emplace_back(std::sin(3.1 * k * k), std::cos(1.7 * k));
    std::vector<std::complex<double>> found = v;
    fourier(found, n);
    for (int l = 0; l < n; ++l)
        for (int k = 0; k < n; ++k) {
            std::complex<double> sum = 0;
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) sum += v[std::size_t(y * n + x)] * std::polar(1., -2 * pi * (x * k + y * l) / n);
            EXPECT_LT(std::abs(sum - found[std::size_t(l * n + k)]), 1e-12);
        }
}

// Its greatest is published as at 8 cycles per degree.
TEST(Moire, TheEyeSeesMediumWavesBest) {
    double greatest = 0, at = 0;
    for (double f = 0.1; f < 60; f += 0.1)
        if (eye_filter(f) > greatest) greatest = eye_filter(at = f);
    EXPECT_NEAR(greatest, 1, 1e-5);
    EXPECT_NEAR(at, 8, 0.15);
    EXPECT_NEAR(eye_filter(0), 2.6 * 0.0192 / 0.98088, 1e-5);
    EXPECT_NEAR(eye_filter(20), 2.6 * (0.0192 + 2.28) * std::exp(-std::pow(2.28, 1.1)) / 0.98088, 1e-4);
}

Json moire_of(const Display& d) {
    Job job;
    Subject subject(d, {}, {});
    return measure_named("moire").run(subject, job).figures;
}

TEST(Moire, RaysFindTheBeatsOfTheory) {
    struct Case {
        const char* name;
        Display display;
    };
    std::vector<Case> cases{{"square, turned", in_focus(LatticeKind::square, 0.961, 3.2, 0.24, 600)},
                            {"hexagons", in_focus(LatticeKind::hexagon, 1.03, 3, 0.21, 500)},
                            {"strips, slanted", in_focus(LatticeKind::strips, 1.003, 2.5, 0.2451, 700)},
                            {"pinholes, round", in_focus(LatticeKind::square, 1.21, 3.2, 0.3, 600)},
                            {"out of focus, diffuser", in_focus(LatticeKind::rectangle, 0.95, 3.2, 0.3, 600)}};
    cases[0].display.array.rotation_deg = 3;
    cases[1].display.lens.kind = IdealLens{{}, 3.4};
    cases[1].display.array.rotation_deg = -2;
    cases[2].display.array.slant_deg = -9.46;
    cases[3].display.lens.kind = Pinhole{0.2};
    cases[3].display.array.aperture = Aperture::circle;
    cases[3].display.array.rotation_deg = 1;
    cases[4].display.lens.kind = IdealLens{{}, 3};
    cases[4].display.array.pitch_mm = {0.95, 1.13};
    cases[4].display.diffuser = Diffuser{2, {0.5, 0.8}, Profile::box};
    constexpr double chance = 1.5;  // fifteen figures, each with the error that it is within nineteen times in twenty
    for (const Case& c : cases) {
        const Json json = moire_of(c.display);
        const Json &white = json["white"], &theory = json["theory"];
        std::printf("%-24s period %8.4f +- %.4f mm (%8.4f), direction %8.3f +- %.3f deg (%8.3f), contrast %.4f +- %.4f (%.4f)\n",
                    c.name, white["period_mm"].get<double>(), white["period_mm_error"].get<double>(),
                    theory["period_mm"].get<double>(), white["direction_deg"].get<double>(),
                    white["direction_deg_error"].get<double>(), theory["direction_deg"].get<double>(),
                    white["contrast"].get<double>(), white["contrast_error"].get<double>(), theory["contrast"].get<double>());
        EXPECT_NEAR(white["period_mm"], theory["period_mm"].get<double>(), chance * white["period_mm_error"].get<double>())
            << c.name;
        EXPECT_LT(apart_deg(white["direction_deg"], theory["direction_deg"]), chance * white["direction_deg_error"].get<double>())
            << c.name;
        EXPECT_NEAR(white["contrast"], theory["contrast"].get<double>(), chance * white["contrast_error"].get<double>()) << c.name;
        EXPECT_LT(white["period_mm_error"], 0.02 * theory["period_mm"].get<double>()) << c.name;
        EXPECT_LT(white["contrast_error"], 0.02 * theory["contrast"].get<double>()) << c.name;
    }
}

// Stripes behind a slanted sheet: each colour has the beat of the lattices' frequencies; where all beats of a colour are too fine
// for the eye there is none.
struct SlantedSheet {
    double pitch, gap, pixel, eye, slant;
    SubpixelLayout layout;
    bool seen;
};
void expect_beats_in_each_colour(std::initializer_list<SlantedSheet> sheets) {
    for (const SlantedSheet& c : sheets) {
        Display d = in_focus(LatticeKind::strips, c.pitch, c.gap, c.pixel, c.eye);
        d.panel.subpixels = c.layout;
        d.panel.aperture_ratio = 1;
        d.array.slant_deg = c.slant;
        const Json json = moire_of(d);
        for (const char* channel : {"r", "g", "b"}) {
            const Json &white = json["white"][channel], &theory = json["theory"][channel];
            if (!c.seen) {
                EXPECT_EQ(theory["contrast"], 0) << c.slant;
                EXPECT_TRUE(white["period_mm"].is_null()) << c.slant << ": " << white.dump();
                continue;
            }
            // Vertical stripes: only their waves' first component across the strips is sampled.
            const double a = c.slant * degree, q = (1 + c.gap / (c.eye - resolve(d).rear_principal_mm)) / c.pixel,
                         n = std::round(c.pitch * q * std::cos(a)),
                         along = (1 + resolve(d).reduced_vertex_plane_mm / (c.eye - resolve(d).vertex_plane_mm)) / c.pixel;
            const double period = 1 / std::hypot(q * std::cos(a) - n / c.pitch, along * std::sin(a));
            EXPECT_NEAR(theory["period_mm"], period, 1e-3 * period) << c.slant;
            EXPECT_NEAR(white["period_mm"], period, 0.02 * period) << c.slant << channel;
            EXPECT_LT(apart_deg(white["direction_deg"], theory["direction_deg"]), 2) << c.slant << channel;
            EXPECT_NEAR(white["contrast"], theory["contrast"].get<double>(), 1.5 * white["contrast_error"].get<double>());
            EXPECT_LT(white["contrast_error"], 0.02 * white["contrast"].get<double>()) << c.slant << channel;
        }
    }
}
TEST(Moire, ColoursHaveTheBeatsOfTheory) {
    expect_beats_in_each_colour({{1.003, 2.5, 0.2451, 700, 2.5, SubpixelLayout::rgb_stripe, true}});
}
TEST(Moire, ColoursHaveTheBeatsOfTheoryAtLength) {
    expect_beats_in_each_colour({{0.83, 2.2, 0.24, 600, -5, SubpixelLayout::bgr_stripe, true},
                                 {0.6, 1.5, 0.05, 400, 40, SubpixelLayout::rgb_stripe, false}});
}

// Under glass that disperses the luminance is that of three colours, each of which takes its own path.
TEST(Moire, LuminanceIsTheSumOfColoursInTheirOwnLight) {
    Display d = in_focus(LatticeKind::square, 0.961, 3.2, 0.24, 600);
    d.panel.subpixels = SubpixelLayout::rgb_stripe;
    d.panel.layers = {{3, {}, Glass{"", Formula::nd_vd, {1.6, 12}}}};
    const Geometry green = resolve(d);
    const WhiteSeen white(d, green, {luminance_weights}), colours(d, green, {only(0), only(1), only(2)});
    EXPECT_EQ(white.paths(), 3u);
    std::vector<WhiteLight> all, one;
    const Vec3d eye{0, 0, 603};
    for (double x = -15; x < 15; x += 0.173) {
        white.look(eye, x, 0.4 * x, 0, 0, all);
        colours.look(eye, x, 0.4 * x, 0, 0, one);
        WhiteLight sum;
        for (std::size_t c = 0; c < 3; ++c) {
            sum.plain += luminance_weights[c] * one[c].plain;
            sum.seen += luminance_weights[c] * one[c].seen;
        }
        EXPECT_NEAR(all[0].plain, sum.plain, 1e-12) << x;
        EXPECT_NEAR(all[0].seen, sum.seen, 1e-12) << x;
    }
    const EyeRays red(d, resolve(d, d.panel.wavelengths_nm[0])), blue(d, resolve(d, d.panel.wavelengths_nm[2]));
    const Vec3d aside{14, 0, green.vertex_plane_mm};
    EXPECT_GT(std::abs(red.look_through(eye, aside, 0, 0).x - blue.look_through(eye, aside, 0, 0).x), 1e-4);
}

TEST(Moire, ThereIsNoneWithoutABlackMatrix) {
    Display d = in_focus(LatticeKind::square, 0.961, 3.2, 0.24, 600);
    d.panel.aperture_ratio = 1;
    const Json json = moire_of(d);
    EXPECT_EQ(json["white"]["contrast"], 0);
    EXPECT_TRUE(json["white"]["period_mm"].is_null() && json["white"]["direction_deg"].is_null());
    EXPECT_EQ(json["theory"]["contrast"], 0);
    EXPECT_TRUE(json["theory"]["period_mm"].is_null());
}

}  // namespace
}  // namespace lfdsim
