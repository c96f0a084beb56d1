// Whole lenses traced against Gaussian optics, known spot widths, the ideal lens's closed form and the laws of Hamiltonian optics.
#include <gtest/gtest.h>

#include "example.h"
#include "files/description/display_file.h"

namespace lfdsim::optics {
namespace {

Display shipped(const std::string& name) { return read_display(LFDSIM_SOURCE_DIR "/displays/" + name + ".toml"); }

/// A lens by itself, as rays coming down meet it: of a display, or, mirrored in z, of the same display seen from its panel, so that
/// the tracer, which only goes down, follows light from the panel to the viewer.
struct Bench {
    TracedDisplay<double> scene;
    double first_z, last_z;  // vertices, mm from the plane z = 0

    explicit Bench(const Display& d) : scene(make_traced_display<double>(d, resolve(d))) {
        scene.fresnel = Fresnel::none;
        first_z = scene.surface[0].z;
        last_z = scene.surface[scene.surface_count - 1].z;
    }

    /// Follows a ray from its place to the vertex plane of the last surface and back out to the plane z = `end`. False if it is
    /// lost.
    bool follow(Ray<double>& ray, double end) const {
        Passage<double> passage{ray, {0, 0}, 1, true};
        double vertex = 0;  // of the surface that way.ray.at.z counts from
        for (int k = 0; k < scene.surface_count; ++k) {
            const SurfaceData<double>& s = scene.surface[k];
            pose(passage.ray, vertex, s.z);
            vertex = s.z;
            const Hit<double> hit = meet(s.shape, s, passage.ray);
            passage.alive = passage.alive && hit.ok;
            refract_down<Facts{}>(scene, s.shape, s, hit, passage);
        }
        pose(passage.ray, vertex, end);
        ray = passage.ray;
        return passage.alive;
    }

  private:
    static void pose(Ray<double>& ray, double origin, double z) {
        const double t = (z - origin - ray.at.z) / ray.to.z;
        ray.at = {ray.at.x + ray.to.x * t, ray.at.y + ray.to.y * t, 0};
    }
};

/// The display's lens turned over: its surfaces in reverse order and mirrored in z. The panel is then at z = first_z + distance.
Display mirrored(const Display& d) {
    const Geometry g = resolve(d);
    std::vector<Surface> surfaces;
    for (std::size_t k = g.surfaces.size(); k-- > 0;) {
        const PlacedSurface& s = g.surfaces[k];
        Surface m{-s.curvature_per_mm, s.conic, s.even_asphere, s.semi_aperture_mm};
        for (double& a : m.even_asphere) a = -a;
        if (k > 0) m.distance_mm = s.z_mm - g.surfaces[k - 1].z_mm, m.index = s.index_below;
        surfaces.push_back(m);
    }
    return with_surfaces(surfaces);
}

/// Full width of the fan of rays from the panel's point on the axis through the whole aperture, where it meets the plane that is
/// `distance` above the last vertex.
double spot_width(const Display& d, double distance) {
    const Geometry g = resolve(d);
    const Bench bench(mirrored(d));
    const double panel = bench.first_z + g.surfaces.front().z_mm;  // mirrored: the panel stands above the lens
    double low = 1e9, high = -1e9;
    for (int i = -20000; i <= 20000; ++i) {
        const double slope = 0.6 * i / 20000, length = std::hypot(slope, 1);
        const Ray<double> start{{0, 0, panel}, {slope / length, 0, -1 / length}};
        Ray<double> at_stop = start, ray = start;
        if (!bench.follow(at_stop, bench.last_z) || !bench.follow(ray, bench.last_z - distance)) continue;
        if (d.lens.stop_radius_mm && std::abs(at_stop.at.x) > *d.lens.stop_radius_mm) continue;
        low = std::min(low, ray.at.x);
        high = std::max(high, ray.at.x);
    }
    return high - low;
}

// Height over slope of a ray parallel to the axis: f = R/(n - 1) and an error that falls with the square of the height.
TEST(Lens, FocalLengthIsGaussInTheLimit) {
    for (Facing facing : {Facing::viewer, Facing::panel}) {
        Display d = example();
        d.lens.as<PlanoConvex>().facing = facing;
        const Bench bench(d);
        const double f = d.lens.as<PlanoConvex>().sphere_radius_mm / (*d.lens.as<PlanoConvex>().index - 1);
        auto error = [&](double height) {
            Ray<double> ray{{height, 0, 50}, {0, 0, -1}};
            EXPECT_TRUE(bench.follow(ray, 0));
            return height * ray.to.z / ray.to.x - f;
        };
        for (double height = 0.4; height > 0.01; height /= 2) {
            // the next term goes with the fourth power, relative to the first of the order of (h/R)^2
            EXPECT_NEAR(error(height) / error(height / 2), 4, 40 * height * height / 9) << height;
        }
        EXPECT_NEAR(error(1e-3), 0, 1e-5);
    }
}

// The cap of a plano-convex lens meets its wall at height h whatever the ball's radius. (As the 2019 paper prints it, the ball is
// centred on the flat face, which holds for R^2 = r^2 + h^2 alone.)
TEST(Lens, CapMeetsTheWall) {
    for (double R : {2.0, 2.0615528128088303, 3.0, 10.0}) {
        Display d = example();
        d.lens.as<PlanoConvex>().sphere_radius_mm = R;
        d.lens.as<PlanoConvex>().cylinder_height_mm = R == 2 ? 0 : 0.5;
        const Geometry g = resolve(d);
        const TracedDisplay<double> scene = make_traced_display<double>(d, g);
        const double centre = g.base_z_mm + d.lens.as<PlanoConvex>().cylinder_height_mm - std::sqrt(R * R - 4);
        EXPECT_NEAR(scene.surface[0].z, centre + R, 1e-12);
        EXPECT_NEAR(scene.surface[0].z + scene.surface[0].rim, g.base_z_mm + d.lens.as<PlanoConvex>().cylinder_height_mm, 1e-12);
        EXPECT_NEAR(scene.surface[0].curvature, -1 / R, 1e-15);
        EXPECT_NEAR(scene.surface[1].z, g.base_z_mm, 1e-12);
        EXPECT_EQ(scene.surface[1].curvature, 0);
    }
}

TEST(Lens, FocalPointsOfAllSurfacesTogether) {
    for (const char* name : {"desktop-stopped", "desktop-asphere", "desktop-spherical"}) {
        const Display d = shipped(name);
        const Geometry g = resolve(d);
        Ray<double> ray{{1e-3, 0, 100}, {0, 0, -1}};
        ASSERT_TRUE(Bench(d).follow(ray, 0));
        const double focus = ray.at.x / ray.to.x * -ray.to.z;  // z at which it crosses the axis: x falls with it
        EXPECT_NEAR(focus, g.front_principal_mm - g.focal_length_mm, 1e-5) << name;
    }
}

// Widths from an independent exact trace. The asphere's move by 0.1 mm for 5 micrometres of gap, the sphere's is of two digits.
TEST(Lens, SpotWidths) {
    struct Case {
        const char* name;
        double depth, widths[3];
    };
    for (const Case& c :
         {Case{"desktop-stopped", 145, {1.108, 0.187, 1.483}}, Case{"desktop-asphere", 329.9, {2.60, 0.41, 3.21}}}) {
        const Display d = shipped(c.name);
        const double L = theory(d, resolve(d)).central_depth_mm;
        EXPECT_NEAR(L, c.depth, 0.5);
        for (int k = 0; k < 3; ++k) {
            const double width = spot_width(d, c.depth + 75 * (k - 1));
            EXPECT_NEAR(width / c.widths[k], 1, 0.01) << c.name << " " << width;
        }
    }
    EXPECT_NEAR(spot_width(shipped("desktop-spherical"), 329.9) / 114, 1, 0.01);
}

// Refraction preserves the symplectic form of position and optical momentum (x, y, n tx, n ty): M^T J M = J for the derivative M of
// every map from plane to plane, and so its determinant is 1. Central differences of 1e-4: error of the order 1e-8 times third
// derivatives of the map and rounding 1e-15 / 1e-4.
TEST(Lens, PhaseSpaceIsPreserved) {
    auto determinant_and_form = [](const Bench& bench, double x, double y, double px, double py, double end) {
        auto map = [&](const std::array<double, 4>& v) {
            Ray<double> ray{{v[0], v[1], bench.first_z + 5}, {v[2], v[3], -std::sqrt(1 - v[2] * v[2] - v[3] * v[3])}};
            EXPECT_TRUE(bench.follow(ray, end));
            return std::array<double, 4>{ray.at.x, ray.at.y, ray.to.x, ray.to.y};
        };
        const std::array<double, 4> start{x, y, px, py};
        double m[4][4];
        for (int k = 0; k < 4; ++k) {
            constexpr double h = 1e-4;
            std::array<double, 4> a = start, b = start;
            a[k] -= h;
            b[k] += h;
            const auto from = map(a), to = map(b);
            for (int i = 0; i < 4; ++i) m[i][k] = (to[i] - from[i]) / (2 * h);
        }
        for (int a = 0; a < 4; ++a) {
            for (int b = 0; b < 4; ++b) {
                const double form = m[0][a] * m[2][b] - m[2][a] * m[0][b] + m[1][a] * m[3][b] - m[3][a] * m[1][b];
                const double wanted = (a + 2 == b) - (b + 2 == a);
                EXPECT_NEAR(form, wanted, 2e-6) << a << b;
            }
        }
    };
    const std::vector<Display> lenses = {
        example(), shipped("desktop-stopped"), shipped("desktop-asphere"), mirrored(shipped("desktop-asphere")),
        with_surfaces({{0.01, 0, {}, 5, 4, 1.6}, {-0.05, -0.5, {}, 5, 2, 1.8}, {-0.03, 0, {1e-5}, 5}})};
    Random random(3);
    for (const Display& d : lenses) {
        const Bench bench(d);
        for (int n = 0; n < 20; ++n) {
            const double px = random(-0.15, 0.15), py = random(-0.15, 0.15);
            // aimed at a place 1 mm or less from the vertex
            determinant_and_form(bench, random(-1, 1) - 5 * px, random(-1, 1) - 5 * py, px, py, 0);
        }
    }
}

/// One ideal lens on the axis before a fine panel; the ray's panel pixel.
PanelHit<double> through_ideal(const Display& d, double x, double y, double slope_x, double slope_y) {
    const TracedDisplay<double> scene = make_traced_display<double>(d, resolve(d));
    const double length = std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
    const Extent<double> extent{0, 0, 0, 0};
    const PanelBase<double> base{std::uint32_t(d.panel.pixels[0] / 2), std::uint32_t(d.panel.pixels[1] / 2), 0, 0};
    const Ray<double> ray{{x, y, 0}, {-slope_x / length, -slope_y / length, -1 / length}};
    return panel_pixel(scene, base, trace_ideal(scene, extent, base, Passage<double>{ray, {0, 0}, 1, true}));
}

// A line of slope m = dx/dz that passes the lens at q leaves towards the panel with slope m + q/f, and lands at q - g (m + q/f):
// the principal ray goes straight on, parallel rays meet in the focal plane, those through the viewer-side focus come down upright.
TEST(IdealLens, ClosedForm) {
    Display d = example();
    d.lens = {IdealLens{3, 9}, {}};
    d.panel.pixels = {40000, 40000};
    d.panel.pixel_pitch_mm = 0.0005;
    d.array.count = {1, 1};
    d.array.pitch_mm = 6;
    Random random(5);
    const double f = 9;
    for (double gap : {9.0, 10.5}) {
        d.array.gap_mm = gap;
        auto lands = [&](double qx, double qy, double mx, double my, double x, double y) {
            const PanelHit<double> hit = through_ideal(d, qx, qy, mx, my);
            ASSERT_TRUE(hit.lit);
            EXPECT_EQ(hit.weight, 1);
            // the pixel whose middle is within half a pixel, and rounding
            EXPECT_NEAR((hit.pixel % 40000 + 0.5 - 20000) * 0.0005, x, 0.00025 + 1e-9);
            EXPECT_NEAR((20000 - (hit.pixel / 40000 + 0.5)) * 0.0005, y, 0.00025 + 1e-9);
        };
        for (int n = 0; n < 100; ++n) {
            const double mx = random(-0.5, 0.5), my = random(-0.5, 0.5), qx = random(-1.9, 1.9), qy = random(-1.9, 1.9);
            lands(0, 0, mx, my, -gap * mx, -gap * my);
            lands(qx, qy, -qx / f, -qy / f, qx, qy);
            if (gap == f) lands(qx, qy, mx, my, -f * mx, -f * my);
            lands(qx, qy, mx, my, qx - gap * (mx + qx / f), qy - gap * (my + qy / f));
        }
        EXPECT_TRUE(through_ideal(d, 2.12, 2.12, 0, 0).lit);
        EXPECT_FALSE(through_ideal(d, 2.13, 2.13, 0, 0).lit);  // beyond the radius of 3 mm
    }
}

}  // namespace
}  // namespace lfdsim::optics
