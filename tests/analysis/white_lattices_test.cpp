// Theory of a white screen on hexagons, bricks and strips, under layers, turned: against lines of sight through displays drawn at
// random.
#include "analysis/core/eye_rays.h"
#include "analysis/uniformity/luminance_theory.h"
#include "analysis/uniformity/uniformity.h"
#include "base/constants.h"
#include "checks/advice.h"
#include "geometry/dark_bands.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace lfdsim {
namespace {

class DrawLattices {
  public:
    explicit DrawLattices(unsigned seed) : random_(seed) {}

    /// `lattice` counts; lenses of f/1.5 to f/8, ideal or of glass, 1 to 4 mm apart, that mostly do not fill their cells.
    Display display(int lattice) {
        constexpr std::array kinds{LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips, LatticeKind::rectangle};
        Display d;
        const double p = even(1, 4), f = p * even(1.5, 8);
        d.array.lattice = kinds[std::size_t(lattice) % kinds.size()];
        const bool strips = is_strips(d.array), sides = differs_by_axis(d.array);
        d.array.pitch_mm = sides ? Pitch{p, p * even(0.7, 1.4)} : Pitch{p};
        const double least = d.array.pitch_mm.least();
        d.panel.pixel_pitch_mm = p / std::floor(even(8, 30));
        for (const std::size_t k : {0u, 1u})
            d.panel.pixels[k] = std::int64_t(std::ceil((k == 0 ? 32 : 24) * p / d.panel.pixel_pitch_mm));
        if (!strips) d.array.count = {std::int64_t(even(20, 36)), std::int64_t(even(16, 26))};
        d.array.gap_mm = f * even(0.97, 1.1);
        if (even(0, 1) < 0.5) (strips ? d.array.slant_deg.emplace() : d.array.rotation_deg) = even(-60, 60);
        d.array.aperture = even(0, 1) < 0.2 ? Aperture::cell : Aperture::circle;
        const double radius = least * even(0.3, 0.5);
        d.lens.kind = IdealLens{radius, f};
        if (even(0, 1) < 0.5) {
            PlanoConvex ball{std::max(f * 0.4918, 0.9 * p), radius, 0.1 * p, 1.4918, Facing::viewer};
            if (d.array.aperture == Aperture::cell) ball.aperture_radius_mm.reset();
            d.lens.kind = ball;
        }
        if (even(0, 1) < 0.25) d.lens.stop_radius_mm = least * even(0.1, 0.4);
        if (even(0, 1) < 0.4) d.panel.layers = {{*d.array.gap_mm * even(0.1, 0.4), 1.52}, {*d.array.gap_mm * 0.1, even(1.3, 1.7)}};
        if (even(0, 1) < 0.7) {
            const double above = p * even(4, 60), spread = p * even(0.1, 1.5), angle = 2 * std::atan(spread / 2 / above) / degree;
            d.diffuser = Diffuser{above, {angle, angle * even(0.4, 1.4)}, even(0, 1) < 0.3 ? Profile::gaussian : Profile::box};
        }
        d.camera.position_mm = {0, 0, even(300, 900)};
        d.content.viewing_distance_mm = d.camera.position_mm[2];
        return d;
    }

  private:
    double even(double low, double high) { return low + (high - low) * double(random_()) / double(std::mt19937::max()); }
    std::mt19937 random_;
};

std::string told(int n, const Display& d) {
    return fmt::format("display {}: lattice {}, turn {}, lens {}, stop {}, layers {}, diffuser {}", n, int(d.array.lattice),
                       d.array.turn_deg(), int(d.lens.type()), d.lens.stop_radius_mm.value_or(0), d.panel.layers.size(),
                       bool(d.diffuser));
}

TEST(WhiteLattices, LuminanceIsThatOfTheoryAtLength) {
    DrawLattices draw(31);
    int glass = 0;
    for (int n = 0; n < 12; ++n) {
        const Display d = draw.display(n);
        if (!validate(d).empty()) continue;
        const Geometry g = resolve(d);
        Job job;
        Parts parts(job, 0, 1 << 20, 0);
        const double eye = d.camera.position_mm[2];
        const Estimate found = screen_luminance(EyeRays(d, g), d, g, {0, 0, eye}, parts).mean();
        const TheoryFigure theory = luminance_over_panel(d, g, eye);
        glass += !d.lens.is_thin();
        EXPECT_NEAR(found.value / theory.value, 1, 0.005 + found.error / theory.value) << told(n, d);
    }
    EXPECT_GT(glass, 2);
}

TEST(WhiteLattices, BandsAreThoseOfTheoryAtLength) {
    DrawLattices draw(32);
    constexpr int displays = 14;
    int with_bands = 0, measured = 0;
    std::vector<double> differences;
    for (int n = 0; n < displays; ++n) {
        Display d = draw.display(n);
        d.camera.position_mm[2] = d.content.viewing_distance_mm = 5000;   // waves in theory are those from far away
        d.panel.pixels = {d.panel.pixels[0] * 2, d.panel.pixels[1] * 2};  // nothing is lost beside the panel
        d.array.count.reset();
        if (!validate(d).empty()) continue;
        const Geometry g = resolve(d);
        Job job;
        Parts parts(job, 0, 1 << 20, 0);
        const PitchLuminance pitch = pitch_luminance(EyeRays(d, g), d, g, d.camera.position_mm, parts);
        const std::array<double, 2> theory = band_contrast(d, g);
        for (int axis = 0; axis < imaging_axes(d.array); ++axis) {
            const Estimate found = michelson(pitch.profile(axis));
            differences.push_back(std::abs(found.value - theory[std::size_t(axis)]));
            EXPECT_NEAR(found.value, theory[std::size_t(axis)], 0.03 + found.error) << told(n, d) << ", axis " << axis;
            with_bands += found.value > visible_band_contrast;
            ++measured;
        }
        if (is_strips(d.array)) {
            EXPECT_TRUE(std::isnan(theory[1]));
        }
    }
    std::sort(differences.begin(), differences.end());
    std::printf("%d contrasts, %d above 0.1; they differ by %.4f in the median, %.4f at most\n", measured, with_bands,
                differences[differences.size() / 2], differences.back());
    EXPECT_LT(differences[differences.size() / 2], 0.006);
    EXPECT_GT(with_bands, measured / 4);
    EXPECT_LT(with_bands, measured - 2);
}

// What advice suggests leaves no bands, on arrays that are not turned and on strips of any slant.
TEST(WhiteLattices, TheDiffuserThatIsAdvisedJoinsTheLenses) {
    DrawLattices draw(33);
    int advised = 0;
    for (int n = 0; n < 60; ++n) {
        Display d = draw.display(n);
        if (!is_strips(d.array)) d.array.rotation_deg = 0;
        if (!d.diffuser) d.diffuser.emplace();
        d.diffuser->profile = Profile::box;
        if (!validate(d).empty()) continue;
        const Geometry g = resolve(d);
        const std::array<double, 2> joining = joining_spread_mm(g);
        for (const std::size_t k : {0u, 1u}) {
            const double height = *g.diffuser_z_mm - aperture_plane_mm(d, g, is_strips(d.array) ? 0 : k);
            if (joining[k] > 0) d.diffuser->angle_deg[k] = gap_closing_angle_deg(joining[k], height);
        }
        const std::array<double, 2> contrast = band_contrast(d, g);
        EXPECT_LT(contrast[0], 0.02) << told(n, d);
        if (!is_strips(d.array)) {
            EXPECT_LT(contrast[1], 0.02) << told(n, d);
        }

        d.diffuser->angle_deg = {0.01, 0.01};
        const std::vector<std::string> all = advice(d, g, theory(d, g));
        const std::array<double, 2> dark = band_contrast(d, g);
        const bool bands = std::max(dark[0], is_strips(d.array) ? 0 : dark[1]) > visible_band_contrast;
        const bool warned = std::any_of(all.begin(), all.end(), [](const std::string& s) { return s.starts_with("dark bands"); });
        EXPECT_EQ(bands, warned) << told(n, d);
        advised += warned;
    }
    EXPECT_GT(advised, 20);
}

}  // namespace
}  // namespace lfdsim
