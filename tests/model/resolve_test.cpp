// Where everything stands, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "example.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

constexpr double R = 7.28, n = 1.4918, gap = 16.485;
const double cap = R - std::sqrt(R * R - 36), T = 1 + cap;

TEST(Resolve, PlanoConvexAtItsGap) {
    const Geometry g = resolve(example());
    EXPECT_NEAR(g.base_z_mm, gap - T / n, 1e-12);
    EXPECT_NEAR(g.top_z_mm, g.base_z_mm + T, 1e-12);
    EXPECT_NEAR(g.vertex_plane_mm, g.top_z_mm, 1e-12);
    EXPECT_NEAR(g.stop_z_mm, g.top_z_mm, 1e-12);
    EXPECT_NEAR(g.front_principal_mm, gap, 1e-12);
    EXPECT_NEAR(g.rear_principal_mm, g.top_z_mm, 1e-12);
    EXPECT_EQ(g.gap_mm, gap);
    EXPECT_EQ(g.clear_aperture_mm[0], 12);
    EXPECT_EQ(g.glass_radius_mm, 6);
    ASSERT_EQ(g.surfaces.size(), 2u);
    EXPECT_EQ(g.surfaces[0].curvature_per_mm, 0);
    EXPECT_NEAR(g.surfaces[1].curvature_per_mm, -1 / R, 1e-15);
    EXPECT_EQ(g.surfaces[0].index_above, n);
    EXPECT_EQ(g.surfaces[1].index_above, 1);
    EXPECT_NEAR(g.array_width_mm, 516, 1e-9);
    EXPECT_NEAR(g.panel_width_mm, 523.6224, 1e-9);
}

TEST(Resolve, PlanoConvexTurnedRoundIsMirrored) {
    Display d = example();
    d.array.gap_mm.reset();
    d.array.base_z_mm = 10;
    d.lens.as<PlanoConvex>().facing = Facing::panel;
    d.lens.stop_radius_mm = 1;
    const Geometry g = resolve(d);
    EXPECT_EQ(g.base_z_mm, 10);
    EXPECT_NEAR(g.top_z_mm, 10 + T, 1e-12);
    EXPECT_NEAR(g.gap_mm, 10, 1e-12);  // the principal plane is in the convex vertex
    EXPECT_NEAR(g.stop_z_mm, 10, 1e-12);
    EXPECT_EQ(g.clear_aperture_mm[0], 2);
    EXPECT_NEAR(g.surfaces[0].curvature_per_mm, 1 / R, 1e-15);
}

TEST(Resolve, GapAndBaseSayTheSame) {
    for (Display d : {example(), example_surfaces(), example_ideal()}) {
        const Geometry a = resolve(d);
        d.array.gap_mm.reset();
        d.array.base_z_mm = a.base_z_mm;
        const Geometry b = resolve(d);
        EXPECT_NEAR(b.gap_mm, gap, 1e-12);
        EXPECT_NEAR(b.top_z_mm, a.top_z_mm, 1e-12);
    }
}

TEST(Resolve, SquareCellsMeetAtTheirCorners) {
    Display d = example();
    d.array.aperture = Aperture::cell;
    d.lens.as<PlanoConvex>().aperture_radius_mm.reset();
    d.lens.as<PlanoConvex>().sphere_radius_mm = 9;
    const Geometry g = resolve(d);
    EXPECT_NEAR(g.glass_radius_mm, 6 * std::sqrt(2.0), 1e-12);
    EXPECT_EQ(g.clear_aperture_mm[0], 12);
    EXPECT_NEAR(g.top_z_mm - g.base_z_mm, 1 + 9 - std::sqrt(81.0 - 72.0), 1e-12);  // h + R - sqrt(R^2 - r^2)
}

// A meniscus bent towards the panel: its rims, not its vertices, are lowest.
TEST(Resolve, LowestPointMayBeARim) {
    Display d = example_surfaces();
    d.lens.as<SurfaceLens>().surfaces = {{-0.05, 0, {}, 6, 2, 1.5}, {-0.06, 0, {}, 6, 0, 1}};
    d.array.gap_mm.reset();
    d.array.base_z_mm = 3;
    const Geometry g = resolve(d);
    EXPECT_NEAR(g.surfaces[0].z_mm, 3 + 20 - std::sqrt(400.0 - 36), 1e-9);
    EXPECT_NEAR(g.top_z_mm, g.surfaces[1].z_mm, 1e-12);
}

TEST(Resolve, IdealLensIsAllInOnePlane) {
    const Geometry g = resolve(example_ideal());
    ASSERT_EQ(g.surfaces.size(), 1u);
    EXPECT_EQ(g.surfaces[0].form, SurfaceForm::thin);
    for (const double z : {g.base_z_mm, g.top_z_mm, g.vertex_plane_mm, g.front_principal_mm, g.rear_principal_mm, g.stop_z_mm})
        EXPECT_EQ(z, gap);
    EXPECT_EQ(g.focal_length_mm, 15.7);
}

TEST(Resolve, CameraDefaults) {
    Display d = example();
    EXPECT_NEAR(resolve(d).frame_width_mm, 1.03 * 3840 * 0.13636, 1e-9);
    EXPECT_EQ(resolve(d).focus_distance_mm, 2000);
    d.panel.pixels = {2160, 3840};  // upright: the height decides
    EXPECT_NEAR(resolve(d).frame_width_mm, 1.03 * 3840 * 0.13636 * 16 / 9, 1e-9);
    d.camera.fov_deg = 90;
    d.camera.position_mm = {300, 0, 400};
    EXPECT_NEAR(resolve(d).frame_width_mm, 1000, 1e-9);
    d.camera.pupil_diameter_mm = 4;
    d.camera.focus_distance_mm = 123;
    EXPECT_EQ(resolve(d).focus_distance_mm, 123);
}

TEST(Resolve, ContentStandsOnTheCentralDepthPlaneWithinReach) {
    Display d = example_ideal();
    EXPECT_NEAR(resolve(d).content_depth_mm, 15.7 * gap / (gap - 15.7), 1e-9);
    EXPECT_NEAR(resolve(d).content_height_mm.value(), 2160 * 0.13636 / 2, 1e-12);
    d.array.gap_mm = 15;  // virtual: behind the lenses
    EXPECT_NEAR(resolve(d).content_depth_mm, 15.7 * 15 / (15 - 15.7), 1e-9);
    d.array.gap_mm = 15.7;  // collimated
    EXPECT_EQ(resolve(d).content_depth_mm, 0);
    d.array.gap_mm = 15.8;  // 2480 mm, behind the viewer
    EXPECT_EQ(resolve(d).content_depth_mm, 0);
    SceneObject object;
    object.model = "a.obj";
    object.height_mm = 3;
    for (const double z : {-40., 100., 7.}) d.content.objects.push_back(object), d.content.objects.back().position_mm[2] = z;
    EXPECT_EQ(resolve(d).content_depth_mm, 30);  // objects stand where they say
    EXPECT_FALSE(resolve(d).content_height_mm);
    d.content.height_mm = 12;
    EXPECT_EQ(resolve(d).content_height_mm, 12);
    d.content.depth_mm = -7;
    EXPECT_EQ(resolve(d).content_depth_mm, -7);
}

// Facing the panel the rear principal plane lies T/n inside the flat face; depth counts from the face.
TEST(Resolve, ContentDepthCountsFromTheVertexPlane) {
    Display d = example();
    d.lens.as<PlanoConvex>().facing = Facing::panel;
    const Geometry g = resolve(d);
    EXPECT_NEAR(g.content_depth_mm, theory(d, g).central_depth_mm - T / n, 1e-9);
}

// An array that is rotated, moved and at another gap by its errors is the array that is described so (docs/model.md, "Errors"), on
// every lattice: strips are as long as the panel reaches along them.
TEST(Resolve, ErrorsOfTheWholeArrayAreThoseOfADescription) {
    for (const LatticeKind lattice :
         {LatticeKind::square, LatticeKind::rectangle, LatticeKind::hexagon, LatticeKind::brick, LatticeKind::strips}) {
        Display errors = example_ideal();
        errors.array.lattice = lattice;
        errors.array.count = {43, lattice == LatticeKind::strips ? 1 : 24};
        errors.array.rotation_deg = 3;
        Display described = errors;
        errors.errors.shift_mm = {0.5, -0.25};
        errors.errors.gap_mm = 0.125;
        errors.errors.rotation_deg = 12;
        described.array.offset_mm = {0.5, -0.25};
        described.array.gap_mm = *described.array.gap_mm + 0.125;
        described.array.rotation_deg = 15;
        const Geometry a = resolve(errors), b = resolve(described);
        EXPECT_EQ(a.array_width_mm, b.array_width_mm) << int(lattice);
        EXPECT_EQ(a.array_height_mm, b.array_height_mm) << int(lattice);
        EXPECT_EQ(a.turn_deg, b.turn_deg);
        EXPECT_EQ(a.gap_mm, b.gap_mm);
        EXPECT_EQ(a.vertex_plane_mm, b.vertex_plane_mm);
        for (std::size_t k = 0; k < 2; ++k) {
            EXPECT_EQ(a.lattice.pitch[k], b.lattice.pitch[k]) << int(lattice);
            EXPECT_EQ(a.lattice.offset[k], b.lattice.offset[k]);
            EXPECT_EQ(a.lattice.count[k], b.lattice.count[k]);
            EXPECT_EQ(a.clear_aperture_mm[k], b.clear_aperture_mm[k]);
        }
    }
}

// An ideal lens that fills its cell grows with the pitch, as an error or described.
TEST(Resolve, IdealLensesGrowWithTheirCells) {
    Display errors = example_ideal();
    errors.array.aperture = Aperture::cell;
    Display described = errors;
    errors.errors.pitch_ppm = 20000;
    described.array.pitch_mm = 12 * 1.02;
    const Geometry a = resolve(errors), b = resolve(described);
    EXPECT_NEAR(a.glass_radius_mm, b.glass_radius_mm, 1e-12);
    EXPECT_NEAR(a.clear_aperture_mm[0], b.clear_aperture_mm[0], 1e-12);
}

}  // namespace
}  // namespace lfdsim
