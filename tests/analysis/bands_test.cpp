// Dark bands between lenses: the closed form against lines of sight through displays drawn at random.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "analysis/core/eye_rays.h"
#include "analysis/uniformity/uniformity.h"
#include "base/constants.h"
#include "checks/advice.h"
#include "geometry/dark_bands.h"

namespace lfdsim {
namespace {

/// Displays of all sizes: lenses of 0.2 to 60 mm, round or square, with or without a stop, ideal or of glass, in black, clear or in
/// a plate, f/1.2 to f/12; a diffuser near or far that spreads light over a twentieth of the pitch to three of it.
class Draw {
  public:
    explicit Draw(unsigned seed) : random_(seed) {}

    Display display() {
        Display d;
        const double p = log_even(0.2, 60), f = p * log_even(1.2, 12);
        d.array.count = {24, 16};
        d.array.pitch_mm = p;
        d.panel.pixel_pitch_mm = p / std::floor(even(8, 60));
        for (const std::size_t k : {0u, 1u})
            d.panel.pixels[k] = std::int64_t(std::ceil(1.2 * double(d.array.count->at(k)) * p / d.panel.pixel_pitch_mm));
        d.array.gap_mm = f * even(0.97, 1.15);
        d.array.aperture = even(0, 1) < 0.25 ? Aperture::cell : Aperture::circle;
        std::optional<double> radius;
        if (even(0, 1) < 0.5) {
            if (d.array.aperture == Aperture::circle) radius = p * even(0.3, 0.5);
            d.lens.kind = IdealLens{radius, f};
        } else {
            PlanoConvex ball{std::max(f * 0.4918, 0.72 * p), {}, 0.1 * p, 1.4918, Facing::viewer};
            if (even(0, 1) < 0.3) d.array.surround = even(0, 1) < 0.5 ? Surround::clear : Surround::plate;
            if (even(0, 1) < 0.2) ball.facing = Facing::panel;
            if (d.array.aperture == Aperture::circle) ball.aperture_radius_mm = p * even(0.3, 0.5);
            d.lens.kind = ball;
        }
        if (even(0, 1) < 0.25) d.lens.stop_radius_mm = p * even(0.05, 0.3);
        if (even(0, 1) < 0.9) {
            const double above = p * log_even(0.7, 100), spread = p * log_even(0.05, 3);
            const double angle = std::min(2 * std::atan(spread / 2 / above) / degree, 60.);
            d.diffuser =
                Diffuser{above, {angle, angle * (even(0, 1) < 0.3 ? 0.4 : 1)}, even(0, 1) < 0.3 ? Profile::gaussian : Profile::box};
        }
        if (even(0, 1) < 0.2) d.array.rotation_deg = even(-50, 50);
        const double size = double(d.array.count->at(0)) * p;
        const double nearest = d.diffuser ? d.diffuser->distance_mm : 0;
        d.camera.position_mm = {0, 0, *d.array.gap_mm + 2 * p + nearest + size * log_even(0.8, 10)};
        d.content.viewing_distance_mm = d.camera.position_mm[2];
        return d;
    }

  private:
    double even(double low, double high) { return low + (high - low) * double(random_()) / double(std::mt19937::max()); }
    double log_even(double low, double high) { return low * std::pow(high / low, even(0, 1)); }
    std::mt19937 random_;
};

/// Michelson contrast along x' and y' of what an eye sees of a white panel over a pitch, in 32 steps, over the middle half of the
/// screen.
std::array<double, 2> seen_contrast(const Display& d, const Geometry& g) {
    const EyeRays rays(d, g);
    const auto bin = [](double number) { return std::min(std::size_t((0.5 + 0.5 * number) * 32), std::size_t(31)); };
    const double pitch = g.lattice.pitch[0];
    const auto axis = [&](double number, std::int64_t lenses) {  // of a lens
        return (std::floor(0.5 * number * 0.5 * double(lenses)) + 0.5) * pitch;
    };
    std::array<std::vector<double>, 2> light{std::vector<double>(32), std::vector<double>(32)};
    for (const Choice& c : even_choices((1 << 16) * rays.more_for(d.camera.position_mm))) {
        const Vec3d at = rays.point(axis(c[4], d.array.count->at(0)) + 0.5 * pitch * c[0],
                                    axis(c[5], d.array.count->at(1)) + 0.5 * pitch * c[1]);
        const double seen = rays.look_through(d.camera.position_mm, at, c[2], c[3]).light;
        for (const std::size_t k : {0u, 1u}) light[k][bin(c[k])] += seen;
    }
    return {michelson(light[0]), michelson(light[1])};
}

// The warning stands where bands are seen, and only there.
TEST(Bands, AreForeseenAndAdvisedOf) {
    Draw draw(15);
    constexpr int displays = 40;
    int agree = 0, with_bands = 0;
    std::vector<double> differences;
    for (int n = 0; n < displays; ++n) {
        const Display d = draw.display();
        const Geometry g = resolve(d);
        const auto [across, up] = seen_contrast(d, g);
        const auto [across_expected, up_expected] = band_contrast(d, g);
        differences.push_back(std::max(std::abs(across - across_expected), std::abs(up - up_expected)));
        const std::vector<std::string> all = advice(d, g, theory(d, g));
        const double contrast = std::max(across, up);
        const bool seen = contrast > visible_band_contrast, doubtful = std::abs(contrast - visible_band_contrast) < 0.01;
        const bool told = std::any_of(all.begin(), all.end(), [](const std::string& s) { return s.starts_with("dark bands"); });
        agree += seen == told || doubtful;  // chance alone makes as much
        with_bands += seen;
        if (seen != told && !doubtful)
            std::printf("display %d: contrast %.3f and %.3f, by theory %.3f and %.3f\n", n, across, up, across_expected,
                        up_expected);
    }
    std::sort(differences.begin(), differences.end());
    std::printf("%d of %d agree, %d have bands; contrast differs by %.3f in the median, %.3f at most for 38\n", agree, displays,
                with_bands, differences[displays / 2], differences[37]);
    EXPECT_GE(agree, 38);
    EXPECT_GT(with_bands, 10);
    EXPECT_LT(with_bands, 30);
    EXPECT_LT(differences[displays / 2], 0.01);
    EXPECT_LT(differences[37], 0.05);
}

// What sums of cosines leave of an even light is no contrast.
TEST(Bands, OfFilledCellsAreNone) {
    Draw draw(8);
    for (int n = 0; n < 40; ++n) {
        Display d = draw.display();
        d.array.aperture = Aperture::cell;
        d.array.surround = Surround::opaque;
        d.lens.kind = IdealLens{{}, d.array.gap_mm.value()};
        d.lens.stop_radius_mm.reset();
        EXPECT_EQ(band_contrast(d, resolve(d)), (std::array<double, 2>{0, 0})) << n;
    }
}

// One lens pitch of spread joins round lenses of any size; the angle follows from the diffuser's own distance.
TEST(Bands, OnePitchOfSpreadClosesThem) {
    Draw draw(7);
    for (int n = 0; n < 40; ++n) {
        Display d = draw.display();
        if (!d.diffuser) d.diffuser.emplace();
        d.diffuser->distance_mm = d.array.pitch_mm[0] * (2 + n);
        d.camera.position_mm = {0, 0, 1e5};
        const Geometry g = resolve(d);
        const double angle = gap_closing_angle_deg(d.array.pitch_mm[0], *g.diffuser_z_mm - aperture_plane_mm(d, g, 0));
        d.array.rotation_deg = 0;
        d.diffuser->angle_deg = {angle, angle};
        for (const double contrast : band_contrast(d, resolve(d))) EXPECT_LT(contrast, 0.06) << n;
    }
}

// An array that errors stretch and turn has the bands of one that is described so.
TEST(Bands, OfAStretchedAndTurnedArrayAreThoseOfItsPitchAndTurn) {
    for (const LatticeKind lattice :
         {LatticeKind::square, LatticeKind::rectangle, LatticeKind::brick, LatticeKind::hexagon, LatticeKind::strips})
        for (const Aperture aperture : {Aperture::circle, Aperture::cell}) {
            const bool strips = lattice == LatticeKind::strips, round = aperture == Aperture::circle;
            Display described;
            described.panel.pixels = {400, 300};
            described.panel.pixel_pitch_mm = 0.1;
            described.lens.kind = PlanoConvex{2.4, round ? 0.5 : 1.1, 0.5, 1.5, Facing::viewer};
            if (!round) described.lens.stop_radius_mm = 0.5;
            described.array.lattice = lattice;
            described.array.aperture = aperture;
            described.array.count = {24, strips ? 1 : 16};
            described.array.gap_mm = 4.3;
            described.array.pitch_mm = lattice == LatticeKind::rectangle ? Pitch(1.3, 1.1) : Pitch(1.3);
            described.diffuser = Diffuser{60, {0.8, 0.5}, Profile::box};
            Display built = described;
            built.errors.pitch_ppm = 1e5;
            built.errors.rotation_deg = 7;
            for (double& pitch : described.array.pitch_mm) pitch *= 1.1;
            (strips ? described.array.slant_deg.emplace() : described.array.rotation_deg) = strips ? -7 : 7;
            const Geometry g = resolve(built), expected = resolve(described);
            for (const std::size_t k : {0u, 1u}) {
                if (strips && k == 1) continue;
                EXPECT_NEAR(aperture_plane_mm(built, g, k), aperture_plane_mm(described, expected, k), 1e-12);
                EXPECT_GT(band_contrast(built, g)[k], 0.05);
                EXPECT_NEAR(band_contrast(built, g)[k], band_contrast(described, expected)[k], 1e-9) << int(lattice) << round << k;
            }
        }
}

// Lenses of glass keep their size when errors stretch their cells: the cells' corners are then dark. A line at x along a cell of
// half side h is lit where it passes the disk of radius R, for the share min(1, sqrt(R^2 - x^2)/h). Ideal lenses fill the cells as
// built.
TEST(Bands, OfCellsThatOutgrowTheirLensesAreInTheCorners) {
    for (const double ppm : {3e4, 1e5}) {
        Display d;
        d.panel.pixels = {600, 400};
        d.panel.pixel_pitch_mm = 0.1;
        d.array.count = {24, 16};
        d.array.pitch_mm = 2;
        d.array.gap_mm = 6.2;
        d.array.aperture = Aperture::cell;
        d.lens.kind = PlanoConvex{3, {}, 0.2, 1.5, Facing::viewer};
        d.camera.position_mm = {0, 0, 20000};
        d.errors.pitch_ppm = ppm;
        const double R = std::sqrt(2), h = 1 + 1e-6 * ppm, step = h / 16;
        double border = 0;  // the mean over the outermost of 32 steps
        for (int k = 0; k < 1000; ++k)
            border += std::min(1., std::sqrt(R * R - std::pow(h - step * (k + 0.5) / 1000, 2)) / h) / 1000;
        const double expected = (1 - border) / (1 + border);
        EXPECT_NEAR(band_contrast(d, resolve(d))[0], expected, 0.003) << ppm;
        EXPECT_NEAR(seen_contrast(d, resolve(d))[0], expected, 0.01) << ppm;

        d.lens.kind = IdealLens{{}, 6};
        EXPECT_EQ(band_contrast(d, resolve(d))[0], 0) << ppm;
        EXPECT_EQ(seen_contrast(d, resolve(d))[0], 0) << ppm;
        EXPECT_NEAR(resolve(d).clear_aperture_mm[0], 2 * h, 1e-12) << ppm;
        d.errors.wedge_deg = {1e-6, 0};  // lenses are searched for, each in its place
        EXPECT_EQ(seen_contrast(d, resolve(d))[0], 0) << ppm;
    }
}

}  // namespace
}  // namespace lfdsim
