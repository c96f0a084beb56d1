// The camera's rays, as they cross the display's first plane, against rays drawn in plain geometry.
#include <gtest/gtest.h>

#include "example.h"

namespace lfdsim::optics {
namespace {

using Point3 = std::array<double, 3>;

Display oblique() {
    Display d = example();
    d.array.count = {101, 61};
    d.array.rotation_deg = 12;
    d.array.lattice = LatticeKind::rectangle;
    d.array.pitch_mm = {d.array.pitch_mm[0], 1.25 * d.array.pitch_mm[0]};
    d.array.offset_mm = {0.7, -0.3};
    d.camera.position_mm = {150, -60, 320};
    d.camera.target_mm = {4, -3, 0};
    d.camera.up = {0.1, 1, 0.05};
    d.camera.pupil_diameter_mm = 4;
    d.camera.focus_distance_mm = 300;
    d.camera.pixel_filter = PixelFilter::box;
    return d;
}

/// Where a ray is in the display's frame, given its place from the axis of its base lens in the array's.
template <class F>
Point3 place(const Display& d, const RayOrigin& view, const PixelRays<F>& pixel, F x, F y) {
    const double i = -double(pixel.extent.low_i), j = -double(pixel.extent.low_j);  // the base lens
    const double ax = double(x) + (i + 0.5 - 0.5 * view.lattice.count[0]) * d.array.pitch_mm[0];
    const double ay = double(y) + (j + 0.5 - 0.5 * view.lattice.count[1]) * d.array.pitch_mm[1];
    const double c = std::cos(d.array.rotation_deg * degree), s = std::sin(d.array.rotation_deg * degree);
    return {c * ax - s * ay + d.array.offset_mm[0], s * ax + c * ay + d.array.offset_mm[1], view.start_z};
}

/// The ray from pupil point (u, v) mm that meets the pinhole's ray through frame point (x, y) pixels in the plane of focus.
void draw(const Display& d, double x, double y, double u, double v, Point3& from, Point3& through) {
    const Geometry g = resolve(d);
    Point3 forward, right, up;
    double distance = 0;
    for (int k = 0; k < 3; ++k) forward[k] = d.camera.target_mm[k] - d.camera.position_mm[k], distance += forward[k] * forward[k];
    distance = std::sqrt(distance);
    for (double& a : forward) a /= distance;
    auto cross = [](const Point3& a, const Point3& b) {
        return Point3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    right = cross(forward, d.camera.up);
    const double length = std::hypot(right[0], right[1], right[2]);
    for (double& a : right) a /= length;
    up = cross(right, forward);
    const double pixel = g.frame_width_mm / double(d.camera.resolution[0]);
    const double fx = (x - double(d.camera.resolution[0]) / 2) * pixel, fy = (double(d.camera.resolution[1]) / 2 - y) * pixel;
    const double k = g.focus_distance_mm / distance;
    for (int a = 0; a < 3; ++a) {
        from[a] = d.camera.position_mm[a] + right[a] * u + up[a] * v;
        through[a] = d.camera.position_mm[a] + k * (forward[a] * distance + right[a] * fx + up[a] * fy);
    }
}

template <class F>
void check_displaced(double bound_mm, double bound) {
    const Display d = oblique();
    const Geometry g = resolve(d);
    const RayOrigin view = make_ray_origin(d, g);
    Random random(2);
    for (int n = 0; n < 2000; ++n) {
        const int column = int(random(0, 160)), row = int(random(0, 112));
        const double jx = random(-1, 1), jy = random(-1, 1), u = random(-0.7, 0.7), v = random(-0.7, 0.7);
        const PixelRays<F> pixel = pixel_rays<F>(view, column, row);
        const Ray<F> ray = displaced(view, pixel, F(jx), F(jy), F(u), F(v));
        Point3 from, through;
        draw(d, column + 0.5 + jx / 2, row + 0.5 - jy / 2, 2 * u, 2 * v, from, through);
        const double t = (view.start_z - from[2]) / (through[2] - from[2]);
        const Point3 at = place(d, view, pixel, ray.at.x, ray.at.y);
        const double length = std::hypot(through[0] - from[0], through[1] - from[1], through[2] - from[2]);
        const double to[3] = {double(ray.to.x), double(ray.to.y), double(ray.to.z)};
        for (int a = 0; a < 3; ++a) {
            ASSERT_NEAR(at[a], from[a] + t * (through[a] - from[a]), bound_mm);
            ASSERT_NEAR(to[a], (through[a] - from[a]) / length, bound);
        }
    }
}

// Without jitter the place is exact to the rounding of a number below the pitch; with it, by the float rounding of a way of some
// millimetres that the ray moved.
TEST(Camera, PixelCentres) {
    Display d = oblique();
    const Geometry g = resolve(d);
    const RayOrigin view = make_ray_origin(d, g);
    for (int row = 0; row < 112; row += 7) {
        for (int column = 0; column < 160; column += 7) {
            Point3 from, through;
            draw(d, column + 0.5, row + 0.5, 0, 0, from, through);
            const double t = (view.start_z - from[2]) / (through[2] - from[2]);
            const PixelRays<float> narrow = pixel_rays<float>(view, column, row);
            const PixelRays<double> wide = pixel_rays<double>(view, column, row);
            ASSERT_TRUE(narrow.alive && wide.alive);
            // from the axis nearest to the block's centre: half a pitch and the way over two pixels at most
            const double reach = 2 + 3 * view.pixel_mm;
            ASSERT_LE(std::abs(wide.x), reach);
            ASSERT_LE(std::abs(wide.y), 1.25 * reach);
            for (int a = 0; a < 2; ++a) {
                const double wanted = from[a] + t * (through[a] - from[a]);
                ASSERT_NEAR(place(d, view, wide, wide.x, wide.y)[a], wanted, 1e-11);
                ASSERT_NEAR(place(d, view, narrow, narrow.x, narrow.y)[a], wanted, 2e-7);
            }
        }
    }
}

TEST(Camera, JitterAndPupilInDouble) { check_displaced<double>(1e-11, 1e-14); }
TEST(Camera, JitterAndPupilInFloat) { check_displaced<float>(3e-6, 3e-7); }

// The base lens's axis meets the panel where plain geometry says.
TEST(Camera, PanelBase) {
    const Display d = oblique();
    const RayOrigin view = make_ray_origin(d, resolve(d));
    for (int column = 0; column < 160; column += 9) {
        const PixelRays<double> pixel = pixel_rays<double>(view, column, 50);
        const Point3 axis = place(d, view, pixel, 0.0, 0.0);
        EXPECT_NEAR(std::int32_t(pixel.base.column) + pixel.base.column_rest, (axis[0] + 20) / 0.25, 1e-10);
        EXPECT_NEAR(std::int32_t(pixel.base.row) + pixel.base.row_rest, (14 - axis[1]) / 0.25, 1e-10);
    }
}

TEST(Camera, RaysThatLookAwayEndAtOnce) {
    Display d = example();
    d.camera.target_mm = {0, 0, 500};
    d.camera.up = {0, 1, 0};
    const RayOrigin view = make_ray_origin(d, resolve(d));
    for (int column = 0; column < 160; ++column) EXPECT_FALSE(pixel_rays<float>(view, column, 50).alive);
}

// Shirley and Chiu's map keeps areas: equal shares in rings of equal area and in sectors.
TEST(Camera, PupilIsEvenlyFilled) {
    Sampler<float> sampler(Sampling::random, sampler_dimensions, 0, 1);
    std::vector<int> counts(16 * 16);
    for (; sampler.sample < 200000; ++sampler.sample) {
        float x, y;
        disk(sampler(4), sampler(5), x, y);
        const double r2 = double(x) * double(x) + double(y) * double(y);
        ASSERT_LE(r2, 1 + 1e-6);
        ++counts[bin(r2, 16) * 16 + bin(std::atan2(double(y), double(x)) / (360 * degree) + 0.5, 16)];
    }
    EXPECT_LT(chi_square(counts), unlikely);
}

}  // namespace
}  // namespace lfdsim::optics
