// Lines of sight against closed forms of the ideal lens, and the viewing zone against theory and a count by hand.
#include "analysis/zone/zone.h"
#include "analysis/zone/zone_search.h"

#include <gtest/gtest.h>

#include "../engine/pictures.h"

namespace lfdsim {
namespace {

constexpr double zone_eye_mm = 600;  // from the lenses

/// 41 x 23 ideal lenses before a panel of fine pixels, larger than their elemental images. Seen from zone_eye_mm before the lenses,
/// for which the elemental images are made.
Display many_lenses(double focal_length_mm) {
    Display d;
    d.panel.pixels = {9000, 6000};
    d.panel.pixel_pitch_mm = 0.025;
    d.lens.kind = IdealLens{{}, focal_length_mm};
    d.array.count = {41, 23};
    d.array.pitch_mm = 4;
    d.array.gap_mm = 8;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, zone_eye_mm + 8};
    d.content.viewing_distance_mm = zone_eye_mm + 8;
    return d;
}
/// The focal length that images the panel to the eye, so that an eye sees one point of it through a whole lens.
const double sharp_at_eye = 1 / (1 / 8. + 1 / zone_eye_mm);

Result zone_of(const Display& d, AnalysisOptions options = {}) {
    Subject subject(d, {}, options);
    Job job;
    return measure_zone(subject, job);
}

std::array<double, 2> both(const Json& json) {
    return {json.at(0).is_null() ? NAN : json.at(0).get<double>(), json.at(1).is_null() ? NAN : json.at(1).get<double>()};
}

/// Share of wrong rays for an eye at (x, z), lens by lens: the ideal lens's own equation.
double counted(const Display& d, double x, double z) {
    const double p = d.array.pitch_mm[0], g = *d.array.gap_mm, n = double(d.array.count->at(0)),
                 f = d.lens.as<IdealLens>().focal_length_mm, scale = 1 + g / (d.content.viewing_distance_mm - g);
    int wrong = 0, all = 0;
    for (double i = 0; i < n; ++i) {
        const double axis = (i + 0.5 - n / 2) * p;
        for (int k = 0; k < 1000; ++k, ++all) {
            const double q = p * ((k + 0.5) / 1000 - 0.5), slope = (x - axis - q) / (z - g) + q / f;
            const double image = std::floor((axis + q - g * slope) / (scale * p) + n / 2);
            wrong += image != i;
        }
    }
    return double(wrong) / all;
}

TEST(EyeRays, FollowTheIdealLensesEquation) {
    Display d = many_lenses(7);
    d.array.rotation_deg = 11;
    d.array.offset_mm = {0.7, -1.3};
    d.panel.emission_exponent = 2;
    const EyeRays rays(d, resolve(d));
    const double c = std::cos(11 * degree), s = std::sin(11 * degree);
    const Vec3d eye{90, -50, 500};
    Random random(3);
    for (int n = 0; n < 1000; ++n) {
        const double u = random(-1, 1), v = random(-1, 1);
        const std::array<double, 2> at{u * 41 * 2, v * 23 * 2};  // in the array's frame
        const double x = c * at[0] - s * at[1] + 0.7, y = s * at[0] + c * at[1] - 1.3;
        const double mx = (eye[0] - x) / 492, my = (eye[1] - y) / 492;
        const std::array<double, 2> slope{c * mx + s * my, c * my - s * mx};
        std::array<double, 2> axis, end;
        double slopes = 1;
        for (const std::size_t k : {0u, 1u}) {
            axis[k] = 4 * std::round(at[k] / 4);  // odd numbers of lenses
            const double m = slope[k] + (at[k] - axis[k]) / 7;
            end[k] = at[k] - 8 * m;
            slopes += m * m;
        }
        const Sight sight = rays.look_through(eye, {x, y, 8}, 0, 0);
        ASSERT_NEAR(sight.light, 1 / slopes, 1e-12);
        ASSERT_NEAR(sight.x, c * end[0] - s * end[1] + 0.7, 1e-9);
        ASSERT_NEAR(sight.y, s * end[0] + c * end[1] - 1.3, 1e-9);
        ASSERT_NEAR(sight.lens[0], c * axis[0] - s * axis[1] + 0.7, 1e-9);
        ASSERT_NEAR(sight.lens[1], s * axis[0] + c * axis[1] - 1.3, 1e-9);
    }
}

// The diffuser turns a line where it crosses it, in the display's axes.
TEST(EyeRays, AreTurnedByTheDiffuser) {
    Display d = many_lenses(7);
    d.diffuser = Diffuser{50, {6, 0}, Profile::box};
    const EyeRays rays(d, resolve(d));
    const Sight straight = rays.look_through({0, 0, 608}, {0, 0, 8}, 0, 0),
                turned = rays.look_through({0, 0, 608}, {0, 0, 8}, 0.5, 0);
    EXPECT_NEAR(straight.x, 0, 1e-12);
    const double shift = std::abs(turned.lens[0]) > 2 ? 0 : 50 * std::tan(1.5 * degree);  // stays within the lens: 1.3 mm
    ASSERT_GT(shift, 0);
    EXPECT_NEAR(std::abs(turned.x), std::abs(shift - 8 * (shift / 7 - std::tan(1.5 * degree))), 1e-9);
}

TEST(Zone, IsTheorysWhereTheLensIsSharpAtTheEye) {
    const Display d = many_lenses(sharp_at_eye);
    const Json figures = zone_of(d).figures;
    const double scale = 1 + 8 / zone_eye_mm, pixel = 0.025 / 2 / 8 / degree;  // half a pixel, degrees
    const double edge = std::atan(scale * 4 / (2 * 8)) / degree;               // elemental images are `scale` p wide
    for (const char* axis : {"horizontal", "vertical"}) {
        for (const char* share : {"wrong_1_percent_deg", "wrong_50_percent_deg"}) {
            const auto [low, high] = both(figures.at(axis).at(share));
            EXPECT_NEAR(low, -edge, pixel) << axis << share;
            EXPECT_NEAR(high, edge, pixel) << axis << share;
        }
        const double theory = figures.at(axis).at("theory_deg").at(1);
        EXPECT_NEAR(theory, edge, 1e-9);
    }
}

// Elemental images stay where they are made, and a lens that is shifted by s sees of them e s - g x/E: 0.37 pitches here.
TEST(Zone, MovesWithAShiftedArray) {
    Display d = many_lenses(sharp_at_eye);
    d.errors.shift_mm = {1.5, 0};
    const auto [low, high] = both(zone_of(d).figures.at("horizontal").at("wrong_50_percent_deg"));
    const double scale = 1 + 8 / zone_eye_mm, pixel = 0.025 / 2 / 8 / degree;
    EXPECT_NEAR(low, std::atan(scale * (1.5 - 2) / 8) / degree, 2 * pixel);
    EXPECT_NEAR(high, std::atan(scale * (1.5 + 2) / 8) / degree, 2 * pixel);
}

// Elemental images at the lens pitch: the outermost lenses, more than a hundredth of all, go first.
TEST(Zone, IsNarrowerForImagesMadeForInfinity) {
    Display d = many_lenses(sharp_at_eye);
    d.content.viewing_distance_mm = INFINITY;
    Subject subject(d, {}, {});
    const Json figures = zone_of(d).figures;
    const double expected = 0.5 * subject.theory().along[0].viewing_zone_deg;
    EXPECT_NEAR(both(figures.at("horizontal").at("wrong_1_percent_deg"))[1], expected, 0.15);
    EXPECT_NEAR(double(figures.at("horizontal").at("theory_deg").at(1)), expected, 1e-6);
    EXPECT_GT(both(figures.at("vertical").at("wrong_1_percent_deg"))[1], expected + 3);  // fewer lenses up than across
}

TEST(Zone, SharesAreThoseCountedLensByLens) {
    const Display d = many_lenses(7.6);  // central depth plane at 152 mm: the eye sees 1.6 mm of the panel through a lens
    const EyeRays rays(d, resolve(d));
    const Pickup pickup(d, resolve(d));
    const std::vector<Choice> choices = even_choices(4096);
    for (const double x : {0., 70., 100., 130., 150., 170., 300., 400.}) {
        const SightShares found = sight_shares(rays, pickup, d, {x, 0, zone_eye_mm + 8}, choices);
        EXPECT_NEAR(found.wrong, counted(d, x, zone_eye_mm + 8), 0.003) << x;
        EXPECT_LT(found.dark, 0.05) << x;  // beside the array's images
    }
    for (const double limit : both(zone_of(d).figures.at("horizontal").at("wrong_1_percent_mm"))) {
        const double pixel_mm = 0.5 * d.panel.pixel_pitch_mm * zone_eye_mm / *d.array.gap_mm;  // half of one, where the eye is
        EXPECT_LT(counted(d, std::abs(limit) - pixel_mm, zone_eye_mm + 8), 0.011) << limit;
        EXPECT_GT(counted(d, std::abs(limit) + pixel_mm, zone_eye_mm + 8), 0.009) << limit;
    }
}

// A viewer in the middle of the next zone sees the next lens's image through every lens; one at the edge sees both.
TEST(Zone, Repeats) {
    const Display d = many_lenses(sharp_at_eye);
    const EyeRays rays(d, resolve(d));
    const Pickup pickup(d, resolve(d));
    const std::vector<Choice> choices = even_choices(8192);
    const double apart = 4 * (1 + 8 / zone_eye_mm) * zone_eye_mm / 8;
    const auto seen_from = [&](double x) { return sight_shares(rays, pickup, d, {x, 0, zone_eye_mm + 8}, choices); };
    EXPECT_EQ(seen_from(0).mixed, 0);
    EXPECT_EQ(seen_from(0).wrong, 0);
    EXPECT_EQ(seen_from(apart).wrong, 1);
    EXPECT_NEAR(seen_from(apart).mixed, 1 / 41., 0.001);  // the outermost lenses have no next one
    EXPECT_NEAR(seen_from(-2 * apart).mixed, 2 / 41., 0.001);
    EXPECT_GT(seen_from(0.5 * apart).mixed, 0.2);
}

TEST(Zone, EndsAlongTheAxisWhereLensesGoWrong) {
    const Display d = many_lenses(sharp_at_eye);
    const auto [nearest, farthest] = both(zone_of(d).figures.at("distance").at("wrong_1_percent_mm"));
    EXPECT_GT(nearest, 100);
    EXPECT_LT(counted(d, 0, nearest + 3), 0.01);
    EXPECT_GT(counted(d, 0, nearest - 3), 0.01);
    EXPECT_TRUE(std::isnan(farthest));
    EXPECT_LT(counted(d, 0, 1e6), 0.01);
}

// A glued lenticular sheet of whose rays 0.84 % are wrong at 5 degrees and 1.02 % at 12 (65536 lines of sight by tests/oracle's
// tracer): where that passes 1 % is not known, and the error says so.
TEST(Zone, ErrorsReachAsFarAsTheShareStaysNearOnePercent) {
    Display d;
    d.panel.pixels = {309, 167};
    d.panel.pixel_pitch_mm = 0.128109535;
    d.panel.layers = {{13.493775774, 1.5, {}}};
    d.lens.kind = PlanoConvex{4.994505034, 2.2015895310124933, 0.782489997, 1.529775723, Facing::viewer};
    d.array.lattice = LatticeKind::strips;
    d.array.slant_deg = 18.434948823;
    d.array.pitch_mm = 2 * 2.2015895310124933;
    d.array.base_z_mm = 13.493775774;
    d.array.aperture = Aperture::cell;
    d.array.surround = Surround::plate;
    d.camera.position_mm = {0, 0, 534.597};
    d.content.viewing_distance_mm = 534.597;
    const Json horizontal = zone_of(d).figures.at("horizontal");
    const auto at = both(horizontal.at("wrong_1_percent_deg")), error = both(horizontal.at("wrong_1_percent_deg_error"));
    const auto half = both(horizontal.at("wrong_50_percent_deg")), half_error = both(horizontal.at("wrong_50_percent_deg_error"));
    for (const std::size_t side : {0u, 1u}) {
        EXPECT_NEAR(std::abs(half[side]), 13.655, half_error[side] + 0.01);
        if (std::isnan(at[side])) continue;
        EXPECT_GT(std::abs(at[side]) + error[side], 7);
        EXPECT_LT(std::abs(at[side]) - error[side], 12.6);
    }
}

TEST(Zone, SaysWhereEyesCannotBe) {
    Display d = many_lenses(7);
    d.diffuser = Diffuser{120, {2, 2}, Profile::box};
    AnalysisOptions options;
    options.viewing_distance_mm = 100;
    try {
        zone_of(d, options);
        FAIL();
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("--viewing-distance-mm"), std::string::npos) << e.what();
        EXPECT_NE(std::string(e.what()).find("128"), std::string::npos) << e.what();  // where the diffuser stands
    }
}

// A hexagon's image has a corner above its middle: theory by rows has no figure there, and says so.
TEST(Zone, HexagonsHaveNoTheoryUpwards) {
    Display d = many_lenses(sharp_at_eye);
    d.array.lattice = LatticeKind::hexagon;
    const Result result = zone_of(d);
    EXPECT_TRUE(result.figures.at("vertical").at("theory_deg").is_null());
    EXPECT_NE(result.notes.at("vertical.theory_deg").get<std::string>().find("corner"), std::string::npos);
    EXPECT_EQ(result.figures.at("horizontal").at("theory_deg").size(), 2u);
}

// No light anywhere: the lenses stand beside the panel.
TEST(Zone, OfADarkDisplayIsEmpty) {
    Display d = many_lenses(7);
    d.array.offset_mm = {600, 0};
    const Result result = zone_of(d);
    EXPECT_TRUE(result.figures.at("horizontal").at("wrong_1_percent_mm").at(0).is_null());
    EXPECT_TRUE(result.notes.contains("horizontal.wrong_1_percent_mm"));
}

}  // namespace
}  // namespace lfdsim
