// Resolution across ideal strips, slanted and straight, against lines of sight written down anew from docs/model.md; of hexagons
// against theory.
#include "analysis/resolution/mtf.h"
#include "analysis/resolution/mtf_curves.h"
#include "analysis/resolution/mtf_theory.h"
#include "base/constants.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

namespace lfdsim {
namespace {

class Numbers {
  public:
    explicit Numbers(std::uint64_t seed) : engine_(seed) {}
    double between(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }

  private:
    std::mt19937_64 engine_;
};

/// Thin cylinders drawn at random, about 20 pixels wide, over a panel of 240 x 160 mm; images are made for the eye's distance.
Display drawn(Numbers& numbers) {
    Display d;
    d.panel.pixels = {1200, 800};
    d.panel.pixel_pitch_mm = 0.2;
    const double pitch = numbers.between(2.5, 5), gap = numbers.between(4, 9), central = numbers.between(60, 140);
    d.array.lattice = LatticeKind::strips;
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.array.slant_deg = numbers.between(-40, 40);
    d.lens.kind = IdealLens{0.5 * pitch * numbers.between(0.7, 1), 1 / (1 / gap + 1 / central)};
    d.array.aperture = numbers.between(0, 1) < 0.5 ? Aperture::cell : Aperture::circle;
    d.camera.position_mm = {0, 0, 1200};
    d.content.viewing_distance_mm = 1200;
    if (numbers.between(0, 1) < 0.4) d.diffuser = Diffuser{central, {numbers.between(0.5, 2), numbers.between(0.5, 2)}};
    return d;
}

/// How far the point shown lies from the point looked at, in the display's x and y, in a plane before the lenses.
struct Offsets {
    std::vector<double> x, y;
};

Offsets offsets(const Display& d, double depth, double angle_deg, double share) {
    Numbers numbers(7);
    const double turn = -*d.array.slant_deg * degree, c = std::cos(turn), s = std::sin(turn);
    const double gap = *d.array.gap_mm, p = d.array.pitch_mm[0], a = d.panel.pixel_pitch_mm;
    const auto& lens = d.lens.as<IdealLens>();
    const double half = d.array.aperture == Aperture::cell ? 0.5 * p : *lens.aperture_radius_mm;
    const double strips = double((*d.array.count)[0]), made_for = d.content.viewing_distance_mm;
    const double eye[2] = {1200 * std::sin(angle_deg * degree), 0}, above = 1200 * std::cos(angle_deg * degree) - gap;
    const auto axis_of = [&](double across) { return (std::floor(across / p + 0.5 * strips) + 0.5 - 0.5 * strips) * p; };
    Offsets all;
    while (all.x.size() < 100000) {
        const double at[2] = {share * numbers.between(-120, 120), share * numbers.between(-80, 80)};
        double slope[2], start[2], turned[2];
        for (int k = 0; k < 2; ++k) slope[k] = (eye[k] - at[k]) / above, start[k] = at[k], turned[k] = slope[k];
        if (d.diffuser) {
            const double u = numbers.between(-0.5, 0.5) * d.diffuser->angle_deg[0] * degree,
                         v = numbers.between(-0.5, 0.5) * d.diffuser->angle_deg[1] * degree;
            const double ix = -std::cos(u) * slope[0] - std::sin(u), iz = -std::cos(u) + std::sin(u) * slope[0];
            const double jy = -std::cos(v) * slope[1] - std::sin(v) * iz, jz = -std::sin(v) * slope[1] + std::cos(v) * iz;
            turned[0] = ix / jz, turned[1] = jy / jz;
            for (int k = 0; k < 2; ++k) start[k] += d.diffuser->distance_mm * (slope[k] - turned[k]);
        }
        // In the array's frame: the strip bends what runs across it alone.
        const double across = c * start[0] + s * start[1], along = c * start[1] - s * start[0], axis = axis_of(across),
                     q = across - axis;
        if (std::abs(q) > half) continue;
        const double seen_across = across - gap * (c * turned[0] + s * turned[1] + q / lens.focal_length_mm),
                     seen_along = along - gap * (c * turned[1] - s * turned[0]);
        const double pixel[2] = {(std::floor((c * seen_across - s * seen_along) / a) + 0.5) * a,
                                 (std::floor((s * seen_across + c * seen_along) / a) + 0.5) * a};
        if (std::abs(pixel[0]) > 120 || std::abs(pixel[1]) > 80) continue;
        // What the pixel shows: in the plane through its strip's axis, towards where that meets the line of the eyes
        const double p_across = c * pixel[0] + s * pixel[1], p_along = c * pixel[1] - s * pixel[0];
        const double owner = axis_of(p_across / (1 + gap / (made_for - gap))), m_across = (owner - p_across) / gap;
        const double eye_across = owner + m_across * (made_for - gap), eye_along = -std::tan(turn) * eye_across;
        const double m_along = (eye_along - p_along) / made_for;
        const double shown[2] = {owner + m_across * depth, p_along + m_along * (gap + depth)};
        all.x.push_back(c * shown[0] - s * shown[1] - (at[0] + depth * slope[0]));
        all.y.push_back(s * shown[0] + c * shown[1] - (at[1] + depth * slope[1]));
    }
    return all;
}

double transform(const Offsets& o, double direction_deg, double frequency) {
    std::complex<double> sum = 0;
    const double c = std::cos(direction_deg * degree), s = std::sin(direction_deg * degree);
    for (std::size_t n = 0; n < o.x.size(); ++n) sum += std::polar(1., 2 * pi * frequency * (c * o.x[n] + s * o.y[n]));
    return std::abs(sum) / double(o.x.size());
}

Subject subject_of(Display d, std::vector<double> depths) {
    const Lattice<double> lattice = resolve(d).lattice;
    d.array.count = {std::int64_t(lattice.count[0]), std::int64_t(lattice.count[1])};
    AnalysisOptions options;
    options.depths_mm = std::move(depths);
    return Subject(d, {}, options);
}

TEST(MtfOfStrips, IsThatOfTheNodalRaysDifferencesAndOfTheory) {
    Numbers numbers(20);
    int with_theory = 0;
    for (int k = 0; k < 12; ++k) {
        const Display plain = drawn(numbers);
        const double central = 1 / (1 / plain.lens.as<IdealLens>().focal_length_mm - 1 / *plain.array.gap_mm);
        const Subject s = subject_of(plain, {});
        const Display& d = s.display();
        for (const double angle : mtf_angles_deg(s)) {
            const Vec3d eye{1200 * std::sin(angle * degree), 0, 1200 * std::cos(angle * degree)};
            const SeenInColours seen = seen_in_colours(s, eye);
            for (const double depth : {0.7 * central, central, 1.4 * central}) {
                const auto where = [&] {
                    return fmt::format("display {}: pitch {}, slant {}, {} mm, {} degrees", k, d.array.pitch_mm[0],
                                       *d.array.slant_deg, depth, angle);
                };
                const MtfCurves m = mtf_curves(s, seen, depth, angle, directions(s.geometry()).front());
                ASSERT_EQ(m.missing, "") << where();
                const Offsets expected = offsets(d, depth, angle, 1);
                const double last = pixel_limit_per_mm(s, m.direction, s.geometry().vertex_plane_mm + depth);
                for (std::size_t n = 0; n < m.frequencies_per_mm.size(); n += 10) {
                    const double f = m.frequencies_per_mm[n];
                    if (f > last) break;
                    EXPECT_NEAR(m.modulation.all[n], transform(expected, -*d.array.slant_deg, f), 0.012) << where() << ", " << f;
                    if (m.has_theory()) {
                        EXPECT_NEAR(m.modulation.all[n], m.theory[n], 0.03) << where() << ", " << f;
                    }
                }
                with_theory += m.has_theory();
                if (m.has_theory() && std::isfinite(m.below(0.5).found.value)) {
                    EXPECT_NEAR(m.below(0.5).found.value, m.theory_below(0.5),
                                m.below(0.5).found.error + 0.01 * m.theory_below(0.5))
                        << where();
                }
            }
        }
    }
    EXPECT_GT(with_theory, 60);
}

// Edges in pictures lean by 7 degrees from the strips: away from the panel's columns up to 20 degrees, then towards them.
TEST(MtfOfStrips, EdgesAgreeWithLinesOfSightAtLength) {
    for (const double slant : {0., 9.4623, -18.435, 33.}) {
        Numbers numbers(3);
        Display d = drawn(numbers);
        d.array.slant_deg = slant;
        d.array.pitch_mm = 3;
        const double turn = -slant, edges_deg = turn + (std::abs(turn) > 20 ? -1 : 1) * std::copysign(7, turn);
        Subject s = subject_of(d, {50, 90});
        Job job;
        const Result result = measure_mtf(s, job);
        EXPECT_TRUE(result.figures["along"].is_null() && result.notes.contains("along"));
        ASSERT_EQ(result.figures["measurements"].size(), 6u);
        for (const Json& m : result.figures["measurements"]) {
            const double depth = m["depth_mm"], angle = m["angle_deg"];
            EXPECT_EQ(m["direction"], "across");
            EXPECT_GE(m["lenses_crossed"].get<int>(), 100);
            const double f = m["edge_mtf50_per_mm"]["green"];
            EXPECT_NEAR(transform(offsets(s.display(), depth, angle, 0.75), edges_deg, f), 0.5, 0.025)
                << slant << " " << depth << " " << angle;
            const double eye = 1200 * std::cos(angle * degree) - s.geometry().vertex_plane_mm, c = std::cos(slant * degree),
                         seen = std::sin(angle * degree) * c;
            EXPECT_NEAR(double(m["resolution_per_deg"]) / double(m["resolution_per_mm"]),
                        (eye - depth) / std::cos(angle * degree) / std::sqrt(1 - seen * seen) * degree, 1e-9);
            EXPECT_NEAR(m["pixel_image_limit_per_mm"], 0.5 * *d.array.gap_mm / (0.2 * depth * c), 1e-9);
        }
    }
}

// Out of focus a hexagon's spot is another than the rectangle's or the disk's that is as wide: at its first minimum along x' those
// are off by 0.07 and more.
TEST(MtfOfHexagons, IsThatOfTheory) {
    for (const double turn : {0., 17.}) {
        Numbers numbers(5);
        Display d = drawn(numbers);
        d.array = {};
        d.array.lattice = LatticeKind::hexagon;
        d.array.pitch_mm = 4;
        d.array.gap_mm = 8;
        d.array.rotation_deg = turn;
        d.array.aperture = Aperture::cell;
        d.panel.pixel_pitch_mm = 0.05;  // so fine that the spot limits
        d.panel.pixels = {4800, 3200};
        d.lens.kind = IdealLens{{}, 1 / (1 / 8. + 1 / 100.)};
        d.diffuser.reset();
        const Subject s = subject_of(d, {});
        const SeenInColours seen = seen_in_colours(s, {0, 0, 1200});
        for (const Direction& direction : directions(s.geometry())) {
            const MtfCurves m = mtf_curves(s, seen, 160, 0, direction);
            ASSERT_TRUE(m.has_theory() && m.missing.empty());
            for (std::size_t n = 0; n < m.frequencies_per_mm.size() && m.frequencies_per_mm[n] < 0.6; n += 4)
                EXPECT_NEAR(m.modulation.all[n], m.theory[n], 0.01) << turn << direction.name << m.frequencies_per_mm[n];
        }
    }
}

}  // namespace
}  // namespace lfdsim
