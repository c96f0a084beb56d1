#include "analysis/resolution/mtf.h"
#include "analysis/resolution/line_spread.h"
#include "analysis/resolution/mtf_curves.h"
#include "analysis/resolution/mtf_resolution.h"
#include "base/constants.h"
#include "checks/first_order.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <cmath>
#include <complex>
#include <random>

namespace lfdsim {
namespace {

/// 40 x 30 ideal lenses with 20 x 20 views, seen from 1500 mm; the central depth plane 120 mm before them.
Display ideal_display() {
    Display d;
    d.panel.pixels = {800, 600};
    d.panel.pixel_pitch_mm = 0.25;
    d.lens.kind = IdealLens{{}, 1 / (1 / 8. + 1 / 120.)};
    d.array.count = {40, 30};
    d.array.pitch_mm = 5;
    d.array.gap_mm = 8;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 1500};
    d.content.viewing_distance_mm = 1500;
    return d;
}

/// The blur of what an ideal display shows at a depth before the lenses, in double and by itself: for lines of sight through a
/// share of the screen, where the nodal ray of the panel pixel seen crosses that depth less where the line of sight does.
struct Difference {
    std::vector<double> x, y;
};
Difference differences(const Display& d, double depth, double angle_deg, double share) {
    std::mt19937_64 engine(1);
    const auto uniform = [&](double low, double high) { return low + (high - low) * double(engine() >> 11) * 0x1p-53; };
    const double gap = *d.array.gap_mm, p = d.array.pitch_mm[0], a = d.panel.pixel_pitch_mm,
                 f = d.lens.as<IdealLens>().focal_length_mm;
    const double eye_x = 1500 * std::sin(angle_deg * degree), eye_z = 1500 * std::cos(angle_deg * degree) - gap;  // from the lenses
    Difference all;
    while (all.x.size() < 100000) {
        const double at[2] = {share * uniform(-100, 100),
                              share * uniform(-75, 75)};  // where the line of sight would meet the lenses
        double slope[2] = {(eye_x - at[0]) / eye_z, (0 - at[1]) / eye_z}, place[2], result[2];
        for (int k = 0; k < 2; ++k) place[k] = at[k] + depth * slope[k];
        double start[2] = {at[0], at[1]}, turned[2] = {slope[0], slope[1]};
        if (d.diffuser) {  // rotations about y, then about x, of the direction down
            const double distance = d.diffuser->distance_mm;
            const double u = uniform(-0.5, 0.5) * d.diffuser->angle_deg[0] * degree,
                         v = uniform(-0.5, 0.5) * d.diffuser->angle_deg[1] * degree;
            const double i[3] = {-slope[0], -slope[1], -1};
            const double ix = std::cos(u) * i[0] + std::sin(u) * i[2], iz = std::cos(u) * i[2] - std::sin(u) * i[0];
            const double jy = std::cos(v) * i[1] - std::sin(v) * iz, jz = std::sin(v) * i[1] + std::cos(v) * iz;
            turned[0] = ix / jz, turned[1] = jy / jz;
            for (int k = 0; k < 2; ++k) start[k] = at[k] + distance * (slope[k] - turned[k]);
        }
        double q[2], axis[2];
        for (int k = 0; k < 2; ++k) {
            axis[k] = (std::floor(start[k] / p) + 0.5) * p;  // an even number of lenses
            q[k] = start[k] - axis[k];
        }
        if (d.array.aperture == Aperture::circle && std::hypot(q[0], q[1]) > *d.lens.as<IdealLens>().aperture_radius_mm) continue;
        for (int k = 0; k < 2; ++k) {
            const double seen = start[k] - gap * (turned[k] + q[k] / f);
            const double pixel = (std::floor(seen / a) + 0.5) * a;
            const double owner = (std::floor(pixel / (1 + gap / (1500 - gap)) / p) + 0.5) * p;
            result[k] = owner + depth * (owner - pixel) / gap - place[k];
        }
        all.x.push_back(result[0]);
        all.y.push_back(result[1]);
    }
    return all;
}

class Counting : public Job {
  public:
    std::int64_t done = 0;
    void advance(std::int64_t n) override { done += n; }
};

const std::vector<double>& column(const DataTable& t, const std::string& name) {
    for (const Column& c : t.columns)
        if (c.name == name) return c.values;
    throw std::out_of_range(name);
}
const DataTable& table(const Result& r, const std::string& name) {
    for (const DataTable& t : r.tables)
        if (t.name == name) return t;
    throw std::out_of_range(name);
}

/// The Fourier transform of a histogram of differences, across lines that lean by a slant (radians) from the vertical or, not
/// horizontal, from the horizontal.
double transform(const Difference& d, bool horizontal, double slant, double frequency) {
    std::complex<double> sum = 0;
    for (std::size_t n = 0; n < d.x.size(); ++n) {
        const double across =
            horizontal ? d.x[n] * std::cos(slant) - d.y[n] * std::sin(slant) : d.x[n] * std::sin(slant) - d.y[n] * std::cos(slant);
        sum += std::polar(1., 2 * pi * frequency * across);
    }
    return std::abs(sum) / double(d.x.size());
}

/// Every curve agrees with the transform of the differences, up to the pixel limit g / 2 a z: that of lines of sight within 0.01,
/// that of slanted edges within 0.02.
void agrees(const Display& d, const std::vector<double>& depths) {
    AnalysisOptions options;
    options.depths_mm = depths;
    Subject subject(d, {}, options);
    Counting job;
    const Result result = measure_mtf(subject, job);
    EXPECT_EQ(job.done, mtf_steps(subject));
    for (const Json& m : result.figures["measurements"]) EXPECT_GE(m["lenses_crossed"].get<int>(), 200);
    const double slant = result.figures["slant_deg"].get<double>() * degree;
    for (const bool horizontal : {true, false}) {
        const DataTable& t = table(result, horizontal ? "mtf_horizontal" : "mtf_vertical");
        const std::vector<double>&z = column(t, "depth_mm"), &angle = column(t, "angle_deg"), &f = column(t, "frequency_per_mm"),
              &lines = column(t, "modulation"), &edges = column(t, "edge_green");
        Difference whole, middle;
        for (std::size_t k = 0; k < z.size(); ++k) {
            if (f[k] == 0) whole = differences(d, z[k], angle[k], 1), middle = differences(d, z[k], angle[k], 0.75);
            if (f[k] > 0.5 * *d.array.gap_mm / (d.panel.pixel_pitch_mm * z[k]) || k % 20 != 0) continue;
            const auto where = [&] {
                return fmt::format("{} mm, {} degrees, {} per mm{}", z[k], angle[k], f[k], horizontal ? "" : ", vertical");
            };
            EXPECT_NEAR(lines[k], transform(whole, horizontal, 0, f[k]), 0.01) << where();
            EXPECT_NEAR(edges[k], transform(middle, horizontal, slant, f[k]), 0.02) << where();
        }
    }
}

TEST(Mtf, OfSquareLensesIsThatOfTheNodalRaysDifferences) { agrees(ideal_display(), {70, 120, 180}); }

TEST(Mtf, OfRoundLensesToo) {
    Display d = ideal_display();
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 2.4;
    agrees(d, {120, 170});
}

TEST(Mtf, BehindADiffuserToo) {
    Display d = ideal_display();
    d.diffuser = Diffuser{120, {2.4, 1.6}, Profile::box};
    agrees(d, {80, 170});
}

// At the lenses there is none; at the central depth plane and half as far again the pixels' images limit it, and farther
// out all of the blur together.
TEST(Mtf, ResolutionIsTheLeastOfMtf50AndTheLimits) {
    AnalysisOptions options;
    options.depths_mm = {0, 120, 190, 400};
    Subject subject(ideal_display(), {}, options);
    Counting job;
    const Result result = measure_mtf(subject, job);
    for (const Json& m : result.figures["measurements"]) {
        const double depth = m["depth_mm"];
        if (depth == 0) {
            EXPECT_TRUE(m["resolution_per_mm"].is_null() && m["limited_by"].is_null() && m["mtf50_per_mm"]["green"].is_null());
            EXPECT_EQ(m["pixel_image_limit_per_mm"], "infinite");
            EXPECT_TRUE(result.notes.contains("measurements.0"));
            continue;
        }
        const double angle = m["angle_deg"], eye = 1500 * std::cos(angle * degree) - 8, mtf50 = m["mtf50_per_mm"]["green"],
                     error = m["mtf50_per_mm_error"]["green"], lens = 0.1 / std::abs(1 - depth / 120),
                     pixel = 0.5 * 8 / 0.25 / depth;
        if (depth == 120)
            EXPECT_TRUE(m["lens_sampling_limit_per_mm"] == "infinite" || m["lens_sampling_limit_per_mm"] > 1e9);
        else
            EXPECT_NEAR(m["lens_sampling_limit_per_mm"], lens, 1e-9);
        EXPECT_NEAR(m["pixel_image_limit_per_mm"], pixel, 1e-9);
        EXPECT_NEAR(m["resolution_per_mm"], std::min({mtf50, lens, pixel}), 1e-9);
        EXPECT_EQ(m["limited_by"], depth == 400 ? "mtf50" : "pixel image") << mtf50;
        EXPECT_NEAR(mtf50, m["theory_mtf50_per_mm"], error) << depth << " " << angle << " " << m["direction"];
        EXPECT_LT(error, 0.05 * mtf50);
        EXPECT_NEAR(m["edge_mtf50_per_mm"]["green"], mtf50, 0.05 * mtf50) << depth << " " << angle << " " << m["direction"];
        const double foreshortened = m["direction"] == "horizontal" ? std::cos(angle * degree) : 1;
        EXPECT_NEAR(double(m["resolution_per_deg"]) / double(m["resolution_per_mm"]),
                    (eye - depth) / std::cos(angle * degree) / foreshortened * degree, 1e-9);
    }
}

// Seen from the edge of the field, fast spheres show a narrow core in a halo as wide as the screen: modulation is then followed as
// far as the lenses' own limit, or the limit would be called the resolution of what nobody has looked at.
TEST(Mtf, IsFollowedToOneHalfOrToTheLensesLimit) {
    const Subject s(first_order({17, {3000, 2000}, 38, 620, {}, LensType::plano_convex}).display, {}, {});
    const double angle = 15.12, x = 620 * std::sin(angle * degree), z = 620 * std::cos(angle * degree);
    const MtfCurves m = mtf_curves(s, seen_in_colours(s, {x, 0, z}), 62, angle, directions(s.geometry()).front());
    ASSERT_EQ(m.missing, "");
    EXPECT_GT(m.spread_mm, 20);  // the halo
    EXPECT_NEAR(m.below(0.5).found.value, 0.106, 0.003);
    EXPECT_EQ(resolution(s, m).limited_by, std::string("mtf50"));
}

// A curve that comes down to the level and turns back may fall below it there or only where it comes down again: its error tells.
TEST(Mtf, ACurveThatGrazesTheLevelIsAsUnsureAsItIs) {
    const auto grazing = [](double by, double end) {
        MtfCurves m{};
        m.frequencies_per_mm = {0, 1, 2, 3, 4};
        m.modulation.all = {1, 0.5 + by, 0.8, 0.6, end};
        for (std::size_t k = 0; k < m.modulation.without.size(); ++k) {
            m.modulation.without[k] = m.modulation.all;
            for (double& y : m.modulation.without[k]) y += k % 2 ? 0.001 : -0.001;  // errors of 0.0063
        }
        return m.below(0.5);
    };
    const LimitingFrequency clear = grazing(0.02, 0.2), above = grazing(0.002, 0.2), below = grazing(-0.002, 0.2),
                            perhaps = grazing(0.002, 0.51), never = grazing(0.02, 0.51);
    EXPECT_NEAR(clear.found.value, 3.25, 1e-12);
    EXPECT_LT(clear.found.error, 0.02);
    EXPECT_NEAR(above.found.value, 3.25, 1e-12);
    EXPECT_NEAR(above.found.value - above.found.error, 1, 0.01);
    EXPECT_NEAR(below.found.value, 1, 0.01);
    EXPECT_NEAR(below.found.value + below.found.error, 3.25, 0.02);
    EXPECT_TRUE(std::isnan(perhaps.found.value));
    EXPECT_NEAR(perhaps.least, 1, 0.01);
    EXPECT_TRUE(std::isnan(never.found.value) && std::isnan(never.least));
}

TEST(Mtf, WithoutALensToSeeThroughIsNull) {
    Display d = ideal_display();
    d.array.offset_mm = {5000, 0};
    AnalysisOptions options;
    options.depths_mm = {120};
    Subject subject(d, {}, options);
    Counting job;
    const Result result = measure_mtf(subject, job);
    EXPECT_TRUE(result.figures["measurements"][0]["mtf50_per_mm"]["red"].is_null());
}

TEST(Mtf, RefusesEdgesBehindTheEye) {
    AnalysisOptions options;
    options.depths_mm = {1490};
    Subject subject(ideal_display(), {}, options);
    Counting job;
    EXPECT_THROW(measure_mtf(subject, job), InputError);
    AnalysisOptions inside;
    inside.viewing_distance_mm = 7;
    Subject near(ideal_display(), {}, inside);
    EXPECT_THROW(measure_mtf(near, job), InputError);
}

TEST(Mtf, StopsWhenAsked) {
    class Cancelled : public Job {
        bool cancelled() const override { return true; }
    } job;
    Subject subject(ideal_display(), {}, {});
    EXPECT_THROW(measure_mtf(subject, job), Stopped);
}

TEST(Mtf, DepthsHoldTheCentralDepthPlane) {
    Subject subject(ideal_display(), {}, {});
    const std::vector<double> depths = mtf_depths_mm(subject);
    ASSERT_EQ(depths.size(), 9u);
    EXPECT_NEAR(depths[4], 120, 1e-9);
    EXPECT_TRUE(std::is_sorted(depths.begin(), depths.end()));
}

}  // namespace
}  // namespace lfdsim
