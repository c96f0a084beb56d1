// Paraxial theory: the figures of the ready displays, limits, and viewing zones by counting lenses.
#include <gtest/gtest.h>

#include <cmath>

#include "base/constants.h"
#include "example.h"
#include "geometry/geometry.h"
#include "geometry/screen.h"
#include "geometry/sharp_range.h"

namespace lfdsim {
namespace {

Theory theory_of(const Display& d) { return theory(d, resolve(d)); }

struct Figures {
    const char* name;
    Display display;
    double f, central_depth, pixel_image, near, far;  // marginal planes as published: L -/+ |L| P_I / D
};

// Along its own x a rectangular lattice is a square one of that pitch, as far as theory goes by the pitch; the depth of field is
// that of the wider aperture.
TEST(Theory, RectanglesAreSquaresOfEachPitch) {
    Display d = example_ideal();
    d.array.aperture = Aperture::cell;
    d.array.count = {32, 20};
    d.diffuser = Diffuser{100, {1, 1}, Profile::box};
    const auto of_square = [&](double pitch, std::size_t axis) {
        Display square = d;
        square.array.pitch_mm = pitch;
        square.array.count->fill(d.array.count->at(axis));
        return theory_of(square);
    };
    const Theory across = of_square(12, 0), up = of_square(9, 1);
    d.array.lattice = LatticeKind::rectangle;
    d.array.pitch_mm = {12, 9};
    const Theory t = theory_of(d);
    for (double AxisTheory::*figure :
         {&AxisTheory::fov_deg, &AxisTheory::fov_elemental_deg, &AxisTheory::views, &AxisTheory::view_step_deg,
          &AxisTheory::viewing_zone_deg, &AxisTheory::viewing_zone_parallel_deg, &AxisTheory::eyebox_mm,
          &AxisTheory::elemental_pitch_mm, &AxisTheory::lens_sampling_limit_per_mm, &AxisTheory::gap_closing_diffuser_deg,
          &AxisTheory::gap_closing_here_deg}) {
        EXPECT_EQ(t.along[0].*figure, across.along[0].*figure);
        EXPECT_EQ(t.along[1].*figure, up.along[1].*figure);
    }
    EXPECT_EQ(t.depth_of_field_mm, across.depth_of_field_mm);
    EXPECT_EQ(t.depth_near_per_mm, across.depth_near_per_mm);
    EXPECT_EQ(resolve(d).clear_aperture_mm, (std::array{12., 9.}));
}

// An array that is stretched is one of that pitch: cells, and with them D, are wider; holes of round lenses are not.
TEST(Theory, AStretchedArrayIsOneOfItsPitch) {
    for (const Aperture aperture : {Aperture::cell, Aperture::circle}) {
        Display built = example_ideal(), pitched = built;
        built.array.aperture = pitched.array.aperture = aperture;
        built.errors.pitch_ppm = 4000;
        pitched.array.pitch_mm = 12 * 1.004;
        const Geometry a = resolve(built), b = resolve(pitched);
        const Theory s = theory(built, a), t = theory(pitched, b);
        EXPECT_NEAR(a.clear_aperture_mm[0], b.clear_aperture_mm[0], 1e-12);
        EXPECT_NEAR(s.depth_near_per_mm, t.depth_near_per_mm, 1e-15);
        EXPECT_NEAR(s.depth_of_field_mm, t.depth_of_field_mm, 1e-9);
        EXPECT_NEAR(s.along[0].views, t.along[0].views, 1e-12);
        EXPECT_NEAR(s.along[0].viewing_zone_deg, t.along[0].viewing_zone_deg, 1e-9);
        EXPECT_NEAR(sharp_by_lens(a, s, 2000).in_front.high, sharp_by_lens(b, t, 2000).in_front.high, 1e-9);
    }
}

// Lenses beside the panel show nothing: the whole screen is what lies before the panel.
TEST(Theory, TheZoneIsOfLensesBeforeThePanel) {
    Display d = example_ideal();
    d.content.viewing_distance_mm = 3000;  // made for another distance: each lens more across narrows the zone
    d.array.count = {43, 24};
    const double within = theory_of(d).along[0].viewing_zone_deg;
    d.array.count = {73, 44};
    const Geometry g = resolve(d);
    EXPECT_EQ(lenses_across(g, 0), std::ceil(g.panel_width_mm / 12));
    d.array.count = {std::int64_t(lenses_across(g, 0)), 24};
    const double before = theory_of(d).along[0].viewing_zone_deg;
    d.array.count = {73, 44};
    EXPECT_EQ(theory_of(d).along[0].viewing_zone_deg, before);
    EXPECT_LT(before, within);
}

// Half a unit in the last place that is given.
TEST(Theory, DesktopDisplays) {
    Display stopped = example();
    stopped.lens.stop_radius_mm = 1.1595;
    Display ideal = example_ideal();
    ideal.array.aperture = Aperture::cell;
    for (const Figures& want :
         {Figures{"stopped", stopped, 14.803, 145.1, 1.200, 70, 220}, Figures{"ideal", ideal, 15.700, 329.7, 2.727, 254.8, 404.6},
          Figures{"asphere", example_surfaces(), 15.699, 329.5, 2.725, 254.6, 404.3}}) {
        const Theory t = theory_of(want.display);
        EXPECT_NEAR(t.along[0].fov_deg, 40.0, 0.05) << want.name;
        EXPECT_NEAR(t.focal_length_mm, want.f, 5e-4) << want.name;
        EXPECT_NEAR(t.central_depth_mm, want.central_depth, 0.05) << want.name;
        EXPECT_NEAR(t.pixel_image_mm, want.pixel_image, 5e-4) << want.name;
        EXPECT_NEAR(t.central_depth_mm - 0.5 * t.depth_of_field_mm, want.near, 0.2) << want.name;
        EXPECT_NEAR(t.depth_of_field_mm, want.far - want.near, 0.2) << want.name;
        EXPECT_NEAR(t.along[0].views, 88, 0.01) << want.name;
        EXPECT_NEAR(t.along[0].view_step_deg, 40.0 / 88, 1e-3) << want.name;
    }
    EXPECT_NEAR(theory_of(stopped).along[0].gap_closing_diffuser_deg, 4.74, 5e-3);
    EXPECT_NEAR(theory_of(ideal).along[0].gap_closing_diffuser_deg, 2.085, 5e-4);
    EXPECT_TRUE(std::isnan(theory_of(ideal).along[0].gap_closing_here_deg));
    ideal.diffuser = Diffuser{100, {1, 1}, Profile::box};
    EXPECT_NEAR(theory_of(ideal).along[0].gap_closing_here_deg, 2 * std::atan(0.06) / degree, 1e-9);
}

// Both forms of the depth of field, and both resolution limits.
TEST(Theory, FormsAgree) {
    const Display d = example_ideal();
    const Theory t = theory_of(d);
    const double L = t.central_depth_mm;
    EXPECT_NEAR(t.depth_of_field_mm, 4 * std::tan(t.along[0].fov_deg * degree / 2) * L * L / (t.along[0].views * 12), 1e-9);
    EXPECT_NEAR(t.along[0].lens_sampling_limit_per_mm, 1.0 / 24, 1e-15);
    EXPECT_NEAR(t.pixel_image_limit_per_mm, 16.485 / (2 * 0.13636 * L), 1e-12);
    EXPECT_NEAR(t.along[0].elemental_pitch_mm, 12 * (1 + 16.485 / (2000 - 16.485)), 1e-12);
}

TEST(Theory, CollimatedLens) {
    Display d = example_ideal();
    d.array.gap_mm = 15.7;
    const Theory t = theory_of(d);
    EXPECT_TRUE(std::isinf(t.central_depth_mm) && std::isinf(t.pixel_image_mm) && std::isinf(t.depth_of_field_mm));
    EXPECT_NEAR(depth_mm(t.depth_near_per_mm), 12 * 15.7 / 0.13636, 1e-9);  // where a pixel's image a z/g has grown to D
    EXPECT_EQ(t.depth_far_per_mm, -t.depth_near_per_mm);                    // and as far behind the lenses
    EXPECT_EQ(t.along[0].gap_closing_diffuser_deg, 0);
    EXPECT_EQ(t.pixel_image_limit_per_mm, 0);
}

TEST(Theory, VirtualCentralDepthPlane) {
    Display d = example_ideal();
    d.array.gap_mm = 15;
    const Theory t = theory_of(d);
    const double L = 1 / (1 / 15.7 - 1 / 15.0);
    EXPECT_LT(t.central_depth_mm, 0);
    EXPECT_NEAR(t.central_depth_mm, L, 1e-9);
    EXPECT_NEAR(t.pixel_image_mm, 0.13636 * -L / 15, 1e-9);
    EXPECT_NEAR(t.depth_near_per_mm, 1 / L + 0.13636 / (15 * t.gap_mm / 15 * resolve(d).clear_aperture_mm[0]), 1e-15);
    EXPECT_NEAR(t.depth_far_per_mm, 2 / L - t.depth_near_per_mm, 1e-15);
}

// At both ends, whatever L, a lens's spot D |1 - z/L| is as wide as a panel pixel's image a |z|/g; between them in 1/z it is
// narrower.
TEST(Theory, DepthOfFieldIsOneIntervalOfInverseDepths) {
    Display d = example_ideal();
    d.array.aperture = Aperture::cell;
    double before = -INFINITY;
    for (const double gap : {3., 9., 14.9, 15.5, 15.69, 15.6999, 15.7, 15.7001, 15.71, 15.9, 16.485, 20., 60.}) {
        d.array.gap_mm = gap;
        const Theory t = theory_of(d);
        const double f = d.lens.as<IdealLens>().focal_length_mm, inverse_L = gap == f ? 0 : 1 / f - 1 / gap;
        const auto excess = [&](double per_mm) { return 12 * std::abs(per_mm - inverse_L) - 0.13636 / gap; };  // over |z|
        EXPECT_NEAR(excess(t.depth_near_per_mm), 0, 1e-12) << gap;
        EXPECT_NEAR(excess(t.depth_far_per_mm), 0, 1e-12) << gap;
        EXPECT_LT(t.depth_far_per_mm, t.depth_near_per_mm);
        EXPECT_LT(excess(inverse_L), 0);
        EXPECT_TRUE(inverse_L == 0 || is_sharp(t, 1 / inverse_L));
        EXPECT_GT(t.depth_near_per_mm + t.depth_far_per_mm, before);  // continuous and rising through the collimated lens
        before = t.depth_near_per_mm + t.depth_far_per_mm;
    }
}

TEST(Theory, FieldOfViewOfWholeElementalImages) {
    Display d = example_ideal();
    d.camera.position_mm = {0, 0, 600};
    const Theory t = theory_of(d);
    EXPECT_NEAR(t.along[0].fov_elemental_deg, 2 * std::atan(12 * (1 + 16.485 / (2000 - 16.485)) / (2 * 16.485)) / degree, 1e-12);
    EXPECT_NEAR(t.along[0].eyebox_mm, 2 * (600 - 16.485) * std::tan(t.along[0].fov_elemental_deg / 2 * degree), 1e-9);
    d.content.viewing_distance_mm = INFINITY;
    EXPECT_EQ(theory_of(d).along[0].fov_elemental_deg, theory_of(d).along[0].fov_deg);
}

// The widest angle from which every lens of a row shows its own elemental image, by following lines through lens centres.
double counted_zone_deg(const Display& d, const Geometry& g, double elemental_pitch, double eye_z) {
    const double p = d.array.pitch_mm[0], above = eye_z - g.rear_principal_mm;
    const auto all_show_their_own = [&](double X) {
        for (std::int64_t i = 0; i < d.array.count->at(0); ++i) {
            const double k = double(i) + 0.5 - double(d.array.count->at(0)) / 2, lens = k * p;
            const double seen = lens - g.gap_mm * (X - lens) / above;
            if (std::abs(seen - k * elemental_pitch) > elemental_pitch / 2) return false;
        }
        return true;
    };
    if (!all_show_their_own(0)) return 0;
    double inside = 0, outside = above;
    for (int i = 0; i < 60; ++i) (all_show_their_own((inside + outside) / 2) ? inside : outside) = (inside + outside) / 2;
    return 2 * std::atan(inside / above) / degree;
}

TEST(Theory, ViewingZonesByCountingLenses) {
    Display d = example_ideal();
    Geometry g = resolve(d);
    Theory t = theory(d, g);
    EXPECT_NEAR(t.along[0].viewing_zone_deg, t.along[0].fov_elemental_deg, 1e-9);
    EXPECT_NEAR(t.along[0].viewing_zone_deg, counted_zone_deg(d, g, t.along[0].elemental_pitch_mm, 2000), 1e-6);
    EXPECT_NEAR(t.along[0].viewing_zone_parallel_deg, counted_zone_deg(d, g, 12, 2000), 1e-6);
    EXPECT_GT(t.along[0].viewing_zone_parallel_deg, 20);

    // made for infinity, seen by the camera
    d.content.viewing_distance_mm = INFINITY;
    d.camera.position_mm = {0, 0, 1500};
    t = theory(d, g = resolve(d));
    EXPECT_EQ(t.along[0].elemental_pitch_mm, 12);
    EXPECT_NEAR(t.along[0].viewing_zone_deg, counted_zone_deg(d, g, 12, 1500), 1e-6);

    d.array.count = {400, 24};  // too wide to be seen as a whole, on a panel as wide
    d.panel.pixels = {40000, 2160};
    d.content.viewing_distance_mm = 2000;
    EXPECT_EQ(theory_of(d).along[0].viewing_zone_parallel_deg, 0);
}

}  // namespace
}  // namespace lfdsim
