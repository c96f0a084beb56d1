// Advice appears where a display will disappoint, says how to mend that, and not elsewhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>
#include <random>

#include "checks/advice.h"
#include "checks/first_order.h"
#include "geometry/dark_bands.h"
#include "lenses.h"

namespace lfdsim {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> advice_for(const Display& d, const std::optional<Vec3d>& half_size = std::nullopt) {
    const Geometry g = resolve(d);
    return advice(d, g, theory(d, g), half_size);
}

/// The display of README.md.
Display tablet() {
    Display d;
    d.panel.pixels = {3840, 2160};
    d.panel.pixel_pitch_mm = 0.08;
    d.lens.kind = PlanoConvex{1.5, 0.48, 0.5, 1.4918, Facing::viewer};
    d.array.count = {320, 180};
    d.array.pitch_mm = 0.96;
    d.array.gap_mm = 3.2;
    d.diffuser = Diffuser{60, {0.9, 0.9}, Profile::box};
    d.camera.position_mm = {0, 0, 600};
    d.content.viewing_distance_mm = 600;
    return d;
}

/// Collimating lenses right before the eye.
Display near_eye() {
    Display d = tablet();
    d.panel.pixels = {1920, 1080};
    d.panel.pixel_pitch_mm = 0.01;
    d.lens = {IdealLens{{}, 3.3}, {}};
    d.array.count = {16, 9};
    d.array.pitch_mm = 1;
    d.array.gap_mm = 3.3;
    d.array.aperture = Aperture::cell;
    d.diffuser.reset();
    d.camera.position_mm = {0, 0, 21.3};
    d.content.viewing_distance_mm = 21.3;
    return d;
}

// Each type of lens is advised to use a key that it has.
TEST(Advice, OnPowerNamesKeysOfTheLens) {
    Display d = tablet();
    d.lens.as<PlanoConvex>().index = 1.04;
    EXPECT_THAT(advice_for(d), Contains(AllOf(HasSubstr("almost no power"), HasSubstr("lens.index=1.4918"))));
    d.lens.as<PlanoConvex>() = {40, 0.48, 0.5, 1.4918, Facing::viewer};
    EXPECT_THAT(advice_for(d), Contains(AllOf(HasSubstr("almost no power"), HasSubstr("smaller lens.sphere_radius_mm"))));
    d.lens.kind = IdealLens{0.48, 42};
    EXPECT_THAT(advice_for(d), Contains(AllOf(HasSubstr("almost no power"), HasSubstr("--set lens.focal_length_mm=3.2)"),
                                              testing::Not(HasSubstr("lens.index")))));
}

// Depths behind the lenses are said to be there.
TEST(Advice, OnTheNearEyeSaysWhereTheSceneIs) {
    Display d = near_eye();
    d.content.depth_mm = -60;
    EXPECT_THAT(advice_for(d), Contains(HasSubstr("the scene is 60 mm behind the lenses and 7")));
    // Where pixels are sharp only near the lenses, the depth that is advised is still one that eyes can focus on.
    d.content.depth_mm = 0;
    d.lens.kind = IdealLens{{}, 4};
    EXPECT_THAT(advice_for(d), Contains(HasSubstr("--set content.depth_mm=-102 ")));
}

// Near a pinhole the angle that joins the holes would mix the views: another distance is advised.
TEST(Advice, AnAngleThatMixesViewsIsNoRemedyForDarkBands) {
    Display d;
    d.panel.pixels = {1001, 701};
    d.panel.pixel_pitch_mm = 0.1;
    d.lens.kind = Pinhole{0.08};
    d.array.count = {85, 60};
    d.array.pitch_mm = 1.1;
    d.array.gap_mm = 2.6;
    d.array.aperture = Aperture::circle;
    d.diffuser = Diffuser{5, {6, 3}, Profile::box};
    d.camera.position_mm = {30, 10, 420};
    d.content.viewing_distance_mm = 420;
    EXPECT_THAT(advice_for(d), ElementsAre(AllOf(HasSubstr("dark bands"), HasSubstr("Use one of 2.864 degrees 22 mm in front"))));
    d.diffuser = Diffuser{22, {2.864, 2.864}, Profile::box};
    EXPECT_THAT(advice_for(d), IsEmpty());
}

// The diffuser's axes are the display's: the spread that joins lenses along axes at 45 degrees to them is sqrt(2) as wide.
TEST(Advice, ADiffuserClosesTheGapsOfRotatedArrays) {
    for (const LatticeKind lattice : {LatticeKind::square, LatticeKind::rectangle, LatticeKind::brick, LatticeKind::hexagon})
        for (const double turn : {0., 10., 45., 80., 90., 160.}) {
            Display d;
            d.panel.pixels = {900, 540};
            d.panel.pixel_pitch_mm = 0.1;
            d.lens.kind = IdealLens{0.45, 3};
            d.array.lattice = lattice;
            d.array.pitch_mm = lattice == LatticeKind::rectangle || lattice == LatticeKind::brick ? Pitch(1.5, 1.1) : Pitch(1.5);
            d.array.rotation_deg = turn;
            d.array.gap_mm = 3;
            d.array.aperture = Aperture::circle;
            d.camera.position_mm = {0, 0, 600};
            d.content.viewing_distance_mm = 600;
            const Geometry g = resolve(d);
            const std::array<double, 2> joining = joining_spread_mm(g);
            d.diffuser = Diffuser{30, {}, Profile::box};
            for (const std::size_t k : {0u, 1u}) d.diffuser->angle_deg[k] = gap_closing_angle_deg(joining[k], 30);
            EXPECT_THAT(advice_for(d), Not(Contains(HasSubstr("dark bands")))) << int(lattice) << " " << turn;
            const std::array<double, 2> contrast = band_contrast(d, resolve(d));
            if (!is_staggered(d.array)) {
                EXPECT_LT(std::max(contrast[0], contrast[1]), 0.01) << int(lattice) << " " << turn;
            }
        }
}

// Before near eyes a diffuser that joins the lenses would blur what is shown far away.
TEST(Advice, ADiffuserThatBlursTheContentIsNoRemedyForDarkBands) {
    Display d = first_order({1.3, {2000, 2000}, 15, 60, {}, LensType::plano_convex}).display;
    EXPECT_THAT(advice_for(d),
                Contains(AllOf(HasSubstr("dark bands"), HasSubstr("would blur the content"), Not(HasSubstr("--set")))));
    d.content.depth_mm = 0;
    EXPECT_THAT(advice_for(d), Not(Contains(HasSubstr("would blur the content"))));
}

// Lenses whose elemental images, at p' = p (1 + g/E), cover a whole number of pixels are as good as lenses that do.
TEST(Advice, WholePixelsUnderALensOrUnderItsElementalImage) {
    Display d;
    d.panel.pixels = {3840, 2160};
    d.panel.pixel_pitch_mm = 0.2;
    d.lens.kind = IdealLens{{}, 2};
    d.array.gap_mm = 2;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, 702};
    d.content.viewing_distance_mm = 702;
    const auto warned = Contains(HasSubstr("neither a whole number"));
    d.array.pitch_mm = Pitch(2);
    EXPECT_THAT(advice_for(d), Not(warned));
    d.array.pitch_mm = Pitch(2 / (1 + 2. / 700));
    EXPECT_THAT(advice_for(d), Not(warned));
    d.array.pitch_mm = Pitch(1.998);
    EXPECT_THAT(advice_for(d), warned);
}

// What moves a scene away from the eye ends the advice.
TEST(Advice, ASceneBehindTheEyeIsMovedAwayFromIt) {
    for (const double eye : {60., 400.})
        for (const double depth : {-20., 0., 0.9 * eye, 2 * eye}) {
            Display d = first_order({5, {1200, 800}, 30, eye, {}, LensType::ideal}).display;
            d.content.depth_mm = depth;
            const Geometry g = resolve(d);
            const Vec3d half{50, 50, 85};
            std::string told;
            for (const std::string& text : advice(d, g, theory(d, g), half))
                if (text.find("is behind the eye") != text.npos) told = text;
            ASSERT_EQ(told.empty(), depth + 85 < eye - g.vertex_plane_mm) << eye << " " << depth;
            if (told.empty()) continue;
            const std::string key = "content.depth_mm=";
            d.content.depth_mm = std::stod(told.substr(told.find(key) + key.size()));
            EXPECT_LT(*d.content.depth_mm + 85, eye - g.vertex_plane_mm) << told;
        }
}

TEST(Advice, NoneForReadyDisplays) {
    EXPECT_THAT(advice_for(tablet()), IsEmpty());
    for (const char* name : {"clear", "ideal", "plate", "asphere", "spherical", "stopped"})
        EXPECT_THAT(advice_for(lens_examples::shipped(std::string("desktop-") + name)), IsEmpty()) << name;
    for (const char* name : {"asphere-bare", "asphere-weak-diffuser"})
        EXPECT_THAT(advice_for(lens_examples::shipped(std::string("desktop-") + name)), ElementsAre(HasSubstr("dark bands")))
            << name;
}

/// Displays by first-order design, from a telephone to a wall: the panel holds the elemental images, the diffuser stands on the
/// central depth plane and joins the lenses there.
Display sane(std::mt19937& random) {
    const auto even = [&](double low, double high) { return low + (high - low) * double(random()) / double(std::mt19937::max()); };
    const double eye = 300 * std::pow(20, even(0, 1)), width = eye * even(0.2, 0.9), central = eye * even(0.03, 0.33);
    Display d;
    d.array.count = {std::int64_t(even(20, 200)), 0};
    d.array.count->at(1) = std::int64_t(double(d.array.count->at(0)) * even(0.5, 0.7));
    const double p = width / double(d.array.count->at(0)), gap = p * even(1.2, 5), views = std::floor(even(8, 80));
    d.array.pitch_mm = p;
    d.array.gap_mm = gap;
    d.lens.kind = IdealLens{p * even(0.4, 0.5), 1 / (1 / gap + 1 / central)};
    d.panel.pixel_pitch_mm = p / views;
    for (const std::size_t k : {0u, 1u})
        d.panel.pixels[k] = std::int64_t(double(d.array.count->at(k)) * views * (1 + gap / eye) * even(1, 1.05)) + 1;
    const double angle = 2 * std::atan(p / 2 / central) * 180 / std::numbers::pi;
    d.diffuser = Diffuser{central, {angle, angle}, even(0, 1) < 0.5 ? Profile::box : Profile::gaussian};
    d.camera.position_mm = {0, 0, eye};
    d.content.viewing_distance_mm = eye * even(0.99, 1.01);
    return d;
}

TEST(Advice, NoneForSaneDisplays) {
    std::mt19937 random(3);
    for (int n = 0; n < 60; ++n) EXPECT_THAT(advice_for(sane(random)), IsEmpty()) << n;
}

/// Each fault by itself gives its sentence, with the remedy.
TEST(Advice, ForEachFault) {
    struct Fault {
        const char *words, *remedy;
        Display start;
        std::function<void(Display&)> make;
    } faults[] = {
        {"moved by 100, 0 mm", "array.offset_mm=[0, 0]", tablet(),
         [](Display& d) {
             d.array.offset_mm = {100, 0};
         }},
        {"moved by 100, 0 mm and turned by 0 degrees with its errors", "errors.shift_mm=[0, 0]", tablet(),
         [](Display& d) {
             d.errors.shift_mm = {100, 0};
             d.content.made_for = MadeFor::built;
         }},
        {"turned by 60 degrees", "array.rotation_deg=0", tablet(), [](Display& d) { d.array.rotation_deg = 60; }},
        {"elemental images for a viewer at 25 mm", "array.count=[2", tablet(),
         [](Display& d) { d.diffuser.reset(), d.content.viewing_distance_mm = d.camera.position_mm[2] = 25; }},
        {"smaller than a panel pixel", "array.pitch_mm", tablet(), [](Display& d) { d.panel.pixel_pitch_mm = 1; }},
        {"less than two panel pixels", "panel.pixel_pitch_mm", tablet(), [](Display& d) { d.panel.pixel_pitch_mm = 0.5; }},
        {"almost no power (focal length inf", "lens.index", tablet(), [](Display& d) { d.lens.as<PlanoConvex>().index = 1; }},
        {"almost no power", "lens.index", tablet(), [](Display& d) { d.lens.as<PlanoConvex>().index = 1.04; }},
        {"stronger than 30 degrees", "diffuser.distance_mm", tablet(),
         [](Display& d) {
             d.diffuser = Diffuser{0.5, {40, 40}, {}};
         }},
        {"is behind the eye", "content.depth_mm", tablet(), [](Display& d) { d.content.depth_mm = 700; }},
        {"larger than the display", "content.height_mm", tablet(), [](Display& d) { d.content.height_mm = 200; }},
        {"larger than the display", "content.height_mm", tablet(), [](Display& d) { d.content.depth_mm = 400; }},
        {"the scene is small", "content.height_mm=77", tablet(), [](Display& d) { d.content.height_mm = 9; }},
        {"nearer than eyes can focus", "content.depth_mm=-1500", near_eye(), [](Display&) {}},
        {"nearer than eyes can focus", "content.depth_mm=149", tablet(), [](Display& d) { d.content.depth_mm = 520; }},
        // The lenses of a meniscus lie before its principal planes.
        {"is inside the display", "camera.position_mm", tablet(),
         [](Display& d) {
             d.lens = {SurfaceLens{{{-0.2, 0, {}, 0.48, 4, 1.5}, {-0.2, 0, {}, 0.48, 0, 1}}}, {}};
             d.array.gap_mm = 40;
             d.diffuser.reset();
             d.camera.position_mm = {0, 0, 40};
         }},
        {"puts the viewer of the elemental images inside the display", "content.viewing_distance_mm=600", tablet(),
         [](Display& d) { d.content.viewing_distance_mm = 50; }},
        {"are for a viewer 2000 mm from the panel", "content.viewing_distance_mm=500", tablet(),
         [](Display& d) {
             d.camera.position_mm = {0, 0, 500}, d.content.viewing_distance_mm = 2000;
         }},
        {"are for a viewer at infinity", "content.viewing_distance_mm=600", tablet(),
         [](Display& d) { d.content.viewing_distance_mm = INFINITY; }},
        {"dark bands", "diffuser.angle_deg=[0.9", tablet(),
         [](Display& d) {
             d.diffuser->angle_deg = {0.3, 0.9};
         }},
        {"dark bands", "diffuser.distance_mm=", tablet(), [](Display& d) { d.diffuser.reset(); }},
    };
    for (const Fault& fault : faults) {
        Display d = fault.start;
        fault.make(d);
        EXPECT_THAT(advice_for(d), Contains(AllOf(HasSubstr(fault.words), HasSubstr(fault.remedy))));
    }
}

// What the sentence of a near-eye display proposes mends it.
TEST(Advice, NearEyeSceneFarAway) {
    Display d = near_eye();
    d.content.depth_mm = -1500;
    d.content.height_mm = 250;
    EXPECT_THAT(advice_for(d), IsEmpty());
}

// A pupil out of focus joins lenses that do not fill their cells; a pinhole, or one that looks at the lenses, does not.
TEST(Advice, PupilJoinsLenses) {
    Display d = near_eye();
    d.content.depth_mm = -1500;
    d.content.height_mm = 250;
    d.array.aperture = Aperture::circle;
    d.lens.as<IdealLens>().aperture_radius_mm = 0.25;
    const auto bands = Contains(HasSubstr("dark bands between the lenses"));
    EXPECT_THAT(advice_for(d), bands);
    d.camera.pupil_diameter_mm = 4;
    d.camera.focus_distance_mm = 1500;
    EXPECT_THAT(advice_for(d), IsEmpty());
    d.camera.focus_distance_mm = 18;
    EXPECT_THAT(advice_for(d), bands);
}

// The depths that it names are the named intervals of the depth of field, cut at the viewer, 580 mm in front of the lenses.
TEST(Advice, ContentOutsideTheDepthOfField) {
    Display d = read_display(LFDSIM_SOURCE_DIR "/displays/desktop-ideal.toml");
    d.content.depth_mm = 100;
    EXPECT_THAT(advice_for(d),
                Contains(AllOf(HasSubstr("by the pixel (from 268"), HasSubstr("to 426"), HasSubstr("within that by the lens"))));
    d.camera.position_mm = {0, 0, 400};
    d.content.viewing_distance_mm = 400;
    EXPECT_THAT(advice_for(d), Contains(AllOf(HasSubstr("mm in front of the lenses to the viewer)"), Not(HasSubstr("426")))));
    d.content.depth_mm = -300;
    EXPECT_THAT(advice_for(d),
                Contains(HasSubstr("and outside that by the lens (from 0 mm in front of the lenses to the viewer)")));
}

// A model's width and depth are known once it has been read.
TEST(Advice, OfTheModelItself) {
    EXPECT_THAT(advice_for(tablet(), Vec3d{100, 40, 60}), IsEmpty());
    EXPECT_THAT(advice_for(tablet(), Vec3d{200, 40, 60}), Contains(HasSubstr("larger than the display")));
    EXPECT_THAT(advice_for(tablet(), Vec3d{100, 40, 700}), Contains(HasSubstr("is behind the eye")));
}

}  // namespace
}  // namespace lfdsim
