// What tracing says of displays that cannot do what they are meant for: right figures, and silence on good ones.
#include "analysis/verdicts/verdicts.h"
#include "analysis/verdicts/quick_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "analysis/crosstalk/crosstalk.h"
#include "checks/advice.h"
#include "example.h"
#include "geometry/lens_misalignment.h"
#include "lenses.h"

namespace lfdsim {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> verdicts_of(const Display& d) {
    const Geometry g = resolve(d);
    return verdicts(d, g, theory(d, g));
}

/// A lenticular sheet for prints, focused on its own back, on the cover glass of a tablet.
Display sheet_on_tablet() {
    Display d;
    d.panel.pixels = {2560, 1600};
    d.panel.pixel_pitch_mm = 0.08498;
    d.panel.layers = {{1.1, 1.5, {}}, {0.4388, 1.56, {}}};
    d.lens.kind = PlanoConvex{0.438, 0.254, 0.7, 1.56, Facing::viewer};
    d.array.lattice = LatticeKind::strips;
    d.array.pitch_mm = 0.508;
    d.array.base_z_mm = 1.5388;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 400};
    d.content.viewing_distance_mm = 400;
    return d;
}

/// A wall for eyes at 3 m, of a first-order design: f/2.6.
Display wall() {
    Display d;
    d.panel.pixels = {7680, 4320};
    d.panel.pixel_pitch_mm = 0.18736603;
    d.lens.kind = PlanoConvex{5.162592, 2.022459, 0.2022, 1.4918, Facing::viewer};
    d.array.count = {246, 138};
    d.array.pitch_mm = 5.808347;
    d.array.gap_mm = 10.87797;
    d.diffuser = Diffuser{300, {1.107754, 1.107754}, Profile::box};
    d.camera.position_mm = {0, 0, 3000};
    d.content.viewing_distance_mm = 3000;
    return d;
}

/// Ideal lenses of 12 pixels for eyes at 800 mm, which see about a pixel through each.
Display small_display() {
    Display d;
    d.panel.pixels = {1200, 800};
    d.panel.pixel_pitch_mm = 0.12;
    d.lens.kind = IdealLens{0.6, 4};
    d.array.count = {100, 66};
    d.array.pitch_mm = 1.44;
    d.array.gap_mm = 4.2;
    d.diffuser = Diffuser{84, {0.98, 0.98}, Profile::box};
    d.camera.position_mm = {0, 0, 800};
    d.content.viewing_distance_mm = 800;
    return d;
}

TEST(Verdicts, ViewsThatDoNotSeparate) {
    const Display d = sheet_on_tablet();
    EXPECT_THAT(verdicts_of(d),
                ElementsAre(AllOf(HasSubstr("views do not separate"), HasSubstr("0.474 of the 0.51 mm"),
                                  HasSubstr("focal length of 1.489 mm"), HasSubstr("lens.sphere_radius_mm = 0.833695"))));
    // What it proposes mends it: the walls begin on the sheet, so that the gap changes with the radius.
    Display focused = d;
    focused.lens.as<PlanoConvex>().sphere_radius_mm = 0.833695;
    EXPECT_THAT(verdicts_of(focused), Not(Contains(HasSubstr("views do not separate"))));
    EXPECT_NEAR(resolve(focused).focal_length_mm, resolve(focused).gap_mm, 1e-5);

    // No radius is proposed that is smaller than the aperture's.
    Display wide = analysis_example::display(40, 100);
    wide.diffuser.reset();
    wide.array.gap_mm = 0.9 * wide.array.pitch_mm[0];
    wide.lens.kind = PlanoConvex{3 * wide.array.pitch_mm[0], 0.48 * wide.array.pitch_mm[0], 0, 1.49, Facing::viewer};
    EXPECT_THAT(verdicts_of(wide), Contains(AllOf(HasSubstr("views do not separate"), HasSubstr("too small for these lenses"),
                                                  Not(HasSubstr("lens.sphere_radius_mm =")))));

    Display ideal = analysis_example::display(40, 100);
    ideal.diffuser.reset();
    ideal.lens.kind = IdealLens{{}, 0.6 * *ideal.array.gap_mm};
    EXPECT_THAT(verdicts_of(ideal), Contains(AllOf(HasSubstr("views do not separate"), HasSubstr("lens.focal_length_mm="))));

    Display holes = analysis_example::display(40, 100);
    holes.diffuser.reset();
    holes.array.aperture = Aperture::circle;
    holes.lens.kind = Pinhole{2};
    EXPECT_THAT(verdicts_of(holes), Contains(AllOf(HasSubstr("holes are too wide"), HasSubstr("lens.aperture_radius_mm=0.09"))));
    holes.lens.kind = Pinhole{0.1};
    EXPECT_THAT(verdicts_of(holes), IsEmpty());

    Display milky = analysis_example::display(40, 1000);
    milky.diffuser = Diffuser{100, {28, 28}, Profile::box};
    const std::vector<std::string> told = verdicts_of(milky);
    ASSERT_THAT(told, Contains(AllOf(HasSubstr("views do not separate"), HasSubstr("diffuser.angle_deg=["))));
    // What it proposes mends it.
    const std::string& first = told.front();
    const std::size_t at = first.find("diffuser.angle_deg=[") + 20;
    const double angle = std::stod(first.substr(at));
    milky.diffuser->angle_deg = {angle, angle};
    EXPECT_THAT(verdicts_of(milky), Not(Contains(HasSubstr("views do not separate"))));
}

/// Returns the two angles that a text advises for the diffuser.
std::array<double, 2> advised_angles(const std::string& text) {
    const std::size_t at = text.find("diffuser.angle_deg=[") + 20;
    return {std::stod(text.substr(at)), std::stod(text.substr(text.find(',', at) + 1))};
}

// Views mix across alone, and the angle upwards stays: less of it would leave dark bands.
TEST(Verdicts, ADiffuserIsWeakenedAlongTheAxisAtFault) {
    Display d = small_display();
    d.diffuser->angle_deg = {20, 0.98};
    const std::vector<std::string> told = verdicts_of(d);
    ASSERT_THAT(told, ElementsAre(HasSubstr("views do not separate")));
    d.diffuser->angle_deg = advised_angles(told[0]);
    EXPECT_EQ(d.diffuser->angle_deg[1], 0.98);
    EXPECT_THAT(verdicts_of(d), IsEmpty());
    EXPECT_THAT(advice(d, resolve(d), theory(d, resolve(d))), IsEmpty());
}

// Most of what a wide diffuser turns aside misses the array: its angle falls faster than what an eye sees at once.
TEST(Verdicts, AWideDiffuserIsWeakenedEnough) {
    for (const double degrees : {60., 40., 20.}) {
        Display d = small_display();
        d.panel.pixels = {240, 150};
        d.array.count = {20, 12};
        d.diffuser->angle_deg = {degrees, 0.98};
        const std::vector<std::string> told = verdicts_of(d);
        ASSERT_THAT(told, Contains(HasSubstr("views do not separate")));
        d.diffuser->angle_deg = advised_angles(told[0]);
        EXPECT_EQ(d.diffuser->angle_deg[1], 0.98);
        EXPECT_THAT(verdicts_of(d), Not(Contains(HasSubstr("views do not separate")))) << degrees;
    }
}

// Before a near eye lenses that are focused on the panel are no remedy: they must image it to the eye.
TEST(Verdicts, ANearEyeNeedsThePanelsImage) {
    Display d = small_display();
    d.diffuser.reset();
    d.lens.as<IdealLens>() = {0.72, 20};
    d.camera.position_mm[2] = d.content.viewing_distance_mm = 7.2;
    const std::vector<std::string> told = verdicts_of(d);
    ASSERT_THAT(told, Contains(AllOf(HasSubstr("not at the eye"), HasSubstr("lens.focal_length_mm=1.75"))));
    d.lens.as<IdealLens>().focal_length_mm = 1.75;
    EXPECT_THAT(verdicts_of(d), Not(Contains(HasSubstr("views do not separate"))));
}

// The stop that is advised against aberration is one with which views separate.
TEST(Verdicts, AStopSeparatesViewsThatAberrationMixes) {
    Display d = lens_examples::shipped("desktop-spherical");
    d.lens.as<PlanoConvex>() = {6.2, 6, 1, 1.4918, Facing::panel};
    d.array.gap_mm = 12.6;
    d.diffuser.reset();
    const std::vector<std::string> told = verdicts_of(d);
    ASSERT_THAT(told,
                Contains(AllOf(HasSubstr("views do not separate"), HasSubstr("aberration is the cause"), HasSubstr("a stop"))));
    d.lens.stop_radius_mm = std::stod(told[0].substr(told[0].find("stop_radius_mm=") + 15));
    EXPECT_THAT(verdicts_of(d), Not(Contains(HasSubstr("views do not separate"))));
}

// An array whose height is given has no gap of its own, and cannot be given one beside it.
TEST(Verdicts, AGapIsAdvisedInPlaceOfTheHeight) {
    Display d = small_display();
    d.lens.as<IdealLens>().focal_length_mm = 2;
    EXPECT_THAT(verdicts_of(d), Contains(HasSubstr("(--set array.gap_mm=2)")));
    d.array.gap_mm.reset();
    d.array.base_z_mm = 4.2;
    EXPECT_THAT(verdicts_of(d), Contains(HasSubstr("(--set array.base_z_mm=none array.gap_mm=2)")));
}

// Bricks whose field of view is narrower upwards than across: the diffuser takes a quarter of each at most.
TEST(Verdicts, ADiffuserAgainstColoursTakesAQuarterOfEachField) {
    Display d = small_display();
    d.panel.pixels = {1500, 1000};
    d.panel.pixel_pitch_mm = 0.1;
    d.panel.subpixels = SubpixelLayout::pentile_rgbg;
    d.panel.aperture_ratio = 0.4;
    d.lens.kind = IdealLens{{}, 3};
    d.array.lattice = LatticeKind::brick;
    d.array.aperture = Aperture::cell;
    d.array.count.reset();
    d.array.pitch_mm = {1.2, 0.7};
    d.array.gap_mm = 3.15;
    d.array.rotation_deg = 3;
    d.diffuser = Diffuser{63, {1.1, 0.65}, Profile::box};
    d.camera.position_mm = {50, -20, 500};
    d.content.viewing_distance_mm = 500;
    const std::vector<std::string> told = verdicts_of(d);
    ASSERT_THAT(told, Contains(AllOf(HasSubstr("red, green and blue apart"), HasSubstr("diffuser.angle_deg="))));
    const std::array<double, 2> angles = advised_angles(told.back());
    for (const std::size_t k : {0u, 1u}) EXPECT_LE(angles[k], 0.251 * theory(d, resolve(d)).along[k].fov_deg) << k;
    d.diffuser = Diffuser{std::stod(told.back().substr(told.back().find("distance_mm=") + 12)), angles, Profile::box};
    EXPECT_THAT(verdicts_of(d), Not(Contains(HasSubstr("red, green and blue apart"))));
}

TEST(Verdicts, AberrationThatMixesTheEyes) {
    const Display d = wall();
    EXPECT_THAT(verdicts_of(d), ElementsAre(AllOf(HasSubstr("aberration mixes"), HasSubstr("lens.stop_radius_mm="))));
    Display perfect = d;
    perfect.lens.kind = IdealLens{2.022459, resolve(d).focal_length_mm};
    EXPECT_THAT(verdicts_of(perfect), IsEmpty());
}

/// Returns what the measure of crosstalk says of the worse eye, and of theory.
std::array<double, 2> measured_between_eyes(const Display& d) {
    Subject subject(d, {}, {});
    Job job;
    const Json eyes = measure_crosstalk(subject, job).figures.at("between_eyes");
    const std::string worse = eyes.at("left_eye_percent") > eyes.at("right_eye_percent") ? "left_eye_" : "right_eye_";
    return {eyes.at(worse + "percent"), eyes.at(worse + "theory_percent")};
}

// The verdict's figure is the measure's: of whole pixels, and of the worse eye.
TEST(Verdicts, CrosstalkIsTheMeasures) {
    Display shifted = small_display();
    shifted.errors.shift_mm = {0.18, 0};
    for (const Display& d : {wall(), shifted}) {
        const auto [traced, in_theory] = measured_between_eyes(d);
        const auto mixed = between_eyes_percent(d, resolve(d));
        ASSERT_TRUE(mixed);
        EXPECT_NEAR(mixed->traced / (100 + mixed->traced), traced / (100 + traced), 0.02);
        EXPECT_NEAR(mixed->theory / (100 + mixed->theory), in_theory / (100 + in_theory), 0.02);
    }
}

// Errors of the whole array show one eye what is meant for the other one; lenses without aberration are not to blame.
TEST(Verdicts, ErrorsOfAssemblyThatMixTheEyes) {
    Display shifted = small_display(), turned = shifted, tilted = shifted, strips = shifted;
    shifted.errors.shift_mm = {0.7, 0};
    turned.errors.rotation_deg = 2;
    tilted.errors.wedge_deg = {0, 3};
    strips.array.lattice = LatticeKind::strips;
    strips.array.count.reset();
    strips.errors.shift_mm = {0.35, 0};
    for (const Display& d : {shifted, turned, tilted, strips}) {
        EXPECT_THAT(verdicts_of(d), ElementsAre(AllOf(HasSubstr("errors of assembly"), HasSubstr(" 0 % without them"),
                                                      HasSubstr("content.made_for"), Not(HasSubstr("aberration")))));
        EXPECT_THAT(verdicts_of(without_errors(d)), IsEmpty());
    }
    shifted.content.made_for = MadeFor::built;
    EXPECT_THAT(verdicts_of(shifted), IsEmpty());
}

// An eye at the border of the viewing zone sees as much of the neighbouring elemental images.
TEST(Verdicts, EyesAtTheEndsOfTheViewingZone) {
    Display d = small_display();
    d.camera.position_mm[2] = d.content.viewing_distance_mm = 65.5 * 4.2 / 1.44;
    EXPECT_THAT(verdicts_of(d), Contains(AllOf(HasSubstr("see nearly the same"), HasSubstr("zone is only 65.5 mm wide"))));
}

// In a narrower one each lens shows one of the eyes its neighbour's image, but near eyes look one by one.
TEST(Verdicts, EyesThatDoNotFitIntoTheViewingZone) {
    Display d = small_display();
    d.camera.position_mm[2] = d.content.viewing_distance_mm = 45 * 4.2 / 1.44;
    const auto narrow = Contains(HasSubstr("do not fit into the viewing zone: it is only 45 mm wide"));
    EXPECT_THAT(verdicts_of(d), Not(narrow));  // at 131 mm
    d.array.gap_mm = 2.2 * *d.array.gap_mm;
    d.lens.kind = IdealLens{0.6, *d.array.gap_mm};
    d.camera.position_mm[2] = d.content.viewing_distance_mm = 45 * *d.array.gap_mm / 1.44;
    EXPECT_THAT(verdicts_of(d), narrow);
}

// Of third order: eight times the blur for twice the aperture; none of an ideal lens.
TEST(Verdicts, SphericalAberration) {
    Display d = lens_examples::shipped("desktop-spherical");
    const auto of_radius = [&](double mm) {
        Display slow = d;
        slow.lens.as<PlanoConvex>().aperture_radius_mm = mm;
        return blur(slow, resolve(slow))->pixels;
    };
    EXPECT_NEAR(of_radius(1.2) / of_radius(0.6), 8, 0.2);
    EXPECT_THAT(verdicts_of(d),
                Contains(AllOf(HasSubstr("spherical aberration"), HasSubstr("no depth is sharp"),
                               HasSubstr("268.5 to 426.3 mm in front of the lenses would be"), HasSubstr("stop of"))));
    d.lens.stop_radius_mm = 2.5;  // about what it proposes
    EXPECT_THAT(verdicts_of(d), Not(Contains(HasSubstr("spherical aberration"))));
    const Display ideal = lens_examples::shipped("desktop-ideal");
    EXPECT_LT(blur(ideal, resolve(ideal))->full_pixels, 1e-9);
}

TEST(Verdicts, ColoursThatStayApart) {
    Display upright = lens_examples::shipped("tablet-lenticular");
    upright.array.slant_deg = 0;
    EXPECT_THAT(verdicts_of(upright), Contains(AllOf(HasSubstr("red, green and blue apart"), HasSubstr("rgb_rows"))));
    Display bare = lens_examples::shipped("hexagon");
    bare.diffuser.reset();
    EXPECT_THAT(verdicts_of(bare), Contains(AllOf(HasSubstr("red, green and blue apart"), HasSubstr("diffuser.angle_deg="))));
    // Two pixels under each lens: an eye sees one colour.
    Display two = upright;
    const double a = two.panel.pixel_pitch_mm, gap = a * 400 / 65;
    two.panel.layers.clear();
    two.array.surround = Surround::opaque;
    two.array.gap_mm = gap;
    two.array.base_z_mm.reset();
    two.lens = {IdealLens{{}, gap}, {}};
    two.array.pitch_mm = 2 * a / (1 + gap / 400);
    two.diffuser.reset();
    two.camera.position_mm = {0, 0, 400 + gap};
    two.content.viewing_distance_mm = 400 + gap;
    EXPECT_THAT(verdicts_of(two), Contains(HasSubstr("has one tint")));
}

// Lenses four pixels wide before a panel whose middle is a pixel's: every fourth pixel stands on the border of two of them.
TEST(Verdicts, PixelsOnTheBorderOfTwoLenses) {
    const auto border = Contains(HasSubstr("lie on the border of two lenses"));
    for (const LatticeKind lattice : {LatticeKind::strips, LatticeKind::square, LatticeKind::hexagon, LatticeKind::brick}) {
        Display d;
        d.panel.pixels = {81, 60};
        d.panel.pixel_pitch_mm = 0.1;
        d.array.lattice = lattice;
        d.array.count = {20, lattice == LatticeKind::strips ? 1 : 12};
        d.array.gap_mm = 1;
        d.array.pitch_mm = 4 * 0.1 / (1 + 1 / 400.);
        d.array.aperture = Aperture::cell;
        d.lens.kind = IdealLens{{}, 1};
        d.camera.position_mm = {0, 0, 401};
        d.content.viewing_distance_mm = 401;
        EXPECT_THAT(verdicts_of(d),
                    Contains(AllOf(HasSubstr("of the pixels lie on the border of two lenses"),
                                   HasSubstr("--set 'array.offset_mm=[0.05, 0]'"), HasSubstr("--set 'panel.pixels=[82, 60]'"))))
            << int(lattice);
        Display even = d, moved = d;
        even.panel.pixels[0] = 82;
        moved.array.offset_mm = {0.05, 0};
        EXPECT_THAT(verdicts_of(even), Not(border)) << int(lattice);
        EXPECT_THAT(verdicts_of(moved), Not(border)) << int(lattice);
        // Subpixels of stripes stand beside the pixel's centre, but green.
        d.panel.subpixels = SubpixelLayout::rgb_stripe;
        EXPECT_EQ(testing::Matches(border)(verdicts_of(d)), false) << int(lattice);
        d.content.sampling = ContentSampling::pixel;
        EXPECT_THAT(verdicts_of(d), border) << int(lattice);
    }
}

TEST(Verdicts, NoneOnGoodDisplays) {
    for (const char* name :
         {"barrier", "hexagon", "tablet-lenticular", "desktop-asphere", "desktop-asphere-bare", "desktop-asphere-colour",
          "desktop-clear", "desktop-doublet", "desktop-ideal", "desktop-plate", "desktop-stopped"})
        EXPECT_THAT(verdicts_of(lens_examples::shipped(name)), IsEmpty()) << name;
}

// Nothing is said, and nothing fails, where an eye sees nothing.
TEST(Verdicts, EyesInsideTheDisplay) {
    Display d = wall();  // whose lenses lie before their principal planes
    d.lens = {SurfaceLens{{{-0.2, 0, {}, 0.48, 4, 1.5}, {-0.2, 0, {}, 0.48, 0, 1}}}, {}};
    d.array.gap_mm = 40;
    d.diffuser.reset();
    d.camera.position_mm = {0, 0, 40};
    EXPECT_FALSE(seen_at_once(d, resolve(d)));
    EXPECT_FALSE(between_eyes_percent(d, resolve(d)));
    verdicts_of(d);
}

}  // namespace
}  // namespace lfdsim
