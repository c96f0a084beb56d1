// Refraction and the meeting of rays with surfaces, held against their laws for float and double.
#include <gtest/gtest.h>

#include "example.h"

namespace lfdsim::optics {
namespace {

using V = Vec3<double>;
V cross_product(V a, V b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(V a) { return std::sqrt(dot(a, a)); }
V unit(V a) { return {a.x / length(a), a.y / length(a), a.z / length(a)}; }
V minus(V a, V b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class F>
V wide(Vec3<F> a) {
    return {double(a.x), double(a.y), double(a.z)};
}

const std::vector<Surface> first_surfaces = {
    {0, 0, {}, 6},                                   // plane
    {-1 / 7.28, 0, {}, 6},                           // sphere, convex to the viewer
    {1 / 15.0, 0, {}, 6},                            // sphere, concave
    {-0.129517, -0.3635, {}, 6},                     // ellipsoid
    {1 / 20.0, -2, {}, 6},                           // hyperboloid
    {-0.129517, -0.3635, {4.972e-5, 1.2486e-6}, 6},  // asphere of the desktop displays
    {0, 0, {-2e-4, 1e-6}, 6},                        // asphere on a plane
};

/// The scene of a lens with a flat back, glass of index 1.5 and this front, which rays coming down meet first.
template <class F>
TracedDisplay<F> lens_with(const Surface& front) {
    const Display d = with_surfaces({{0, 0, {}, 6, 5, 1.5}, front});
    return make_traced_display<F>(d, resolve(d));
}

/// The unit normal by the textbook derivative of the sag, independent of the tracer's.
V normal_at(const Surface& s, double x, double y) {
    const double r = std::hypot(x, y), c = s.curvature_per_mm;
    double slope = c * r / std::sqrt(1 - (1 + s.conic) * c * c * r * r);
    for (std::size_t i = 0; i < s.even_asphere.size(); ++i)
        slope += (2 * double(i) + 4) * s.even_asphere[i] * std::pow(r, 2 * double(i) + 3);
    return r == 0 ? V{0, 0, 1} : unit({-slope * x / r, -slope * y / r, 1});
}

/// Calls check(front, scene, target, normal, ray) for random points of each surface and rays that come to them from the viewer's
/// side, with a cosine of at least 0.1 (below, the square root in Snell's law magnifies rounding). The ray stands in the vertex
/// plane.
template <class F, class Check>
void for_each_ray(Check check) {
    Random random(1);
    for (const Surface& front : first_surfaces) {
        const TracedDisplay<F> scene = lens_with<F>(front);
        for (int n = 0; n < 4000; ++n) {
            const double r = 5.99 * std::sqrt(random(0, 1)), turn = random(0, 360) * degree;
            const double x = r * std::cos(turn), y = r * std::sin(turn);
            const V target{x, y, sag_mm(front.curvature_per_mm, front.conic, front.even_asphere, r)};
            const V to = unit({random(-1.7, 1.7), random(-1.7, 1.7), -1}), normal = normal_at(front, x, y);
            if (-dot(to, normal) < 0.1) continue;
            const double back = -target.z / to.z;
            check(front, scene, target, normal,
                  Ray<F>{{F(x + to.x * back), F(y + to.y * back), F(0)}, {F(to.x), F(to.y), F(to.z)}});
        }
    }
}

template <class F>
struct Laws : testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Laws, Reals);

// Rounding of coordinates up to 20 mm, some ten times, along rays that meet the surface with a cosine of 0.1.
template <class F>
constexpr double bound_mm = sizeof(F) == 4 ? 1e-5 : 1e-12;
// Rounding of a direction: some ten roundings of numbers up to 1.5, magnified by the cosines' 10.
template <class F>
constexpr double bound = sizeof(F) == 4 ? 5e-6 : 1e-14;

TYPED_TEST(Laws, EveryRayMeetsItsTargetOnTheSurface) {
    using F = TypeParam;
    for_each_ray<F>([](const Surface& front, const TracedDisplay<F>& scene, V target, V normal, const Ray<F>& ray) {
        const Hit<F> hit = meet(scene.surface[0].shape, scene.surface[0], ray);
        ASSERT_TRUE(hit.ok) << "missed (" << target.x << ", " << target.y << "), conic " << front.conic;
        const V at = wide(hit.at), n = wide(hit.normal);
        const double sag = sag_mm(front.curvature_per_mm, front.conic, front.even_asphere, std::hypot(at.x, at.y));
        EXPECT_NEAR(at.z, sag, bound_mm<F>);
        EXPECT_LT(length(minus(at, target)), 10 * bound_mm<F>);
        EXPECT_LT(length(minus(n, normal)), bound<F>);
        EXPECT_NEAR(double(hit.cos), -dot(wide(ray.to), normal), 4 * bound<F>);
        EXPECT_NEAR(double(hit.cos2), double(hit.cos) * double(hit.cos), bound<F>);
    });
}

TYPED_TEST(Laws, RefractionObeysSnell) {
    using F = TypeParam;
    const double n1 = 1, n2 = 1.5;
    for_each_ray<F>([&](const Surface&, const TracedDisplay<F>& scene, V, V, const Ray<F>& ray) {
        const Hit<F> hit = meet(scene.surface[0].shape, scene.surface[0], ray);
        Passage<F> passage{ray, {F(0), F(0)}, F(1), true};
        refract_down<Facts{}>(scene, scene.surface[0].shape, scene.surface[0], hit, passage);
        const V i = wide(ray.to), t = wide(passage.ray.to), n = wide(hit.normal);
        EXPECT_TRUE(passage.alive);
        EXPECT_NEAR(length(t), 1, bound<F>);
        // n1 sin1 = n2 sin2 with the plane of incidence: the vectors n1 i x n and n2 t x n are equal
        const V in = cross_product(i, n), out = cross_product(t, n);
        EXPECT_NEAR(n1 * length(in), n2 * length(out), bound<F>);
        EXPECT_NEAR(dot(in, t), 0, bound<F>);  // t lies in the plane of i and n
        EXPECT_GE(dot(in, out), -bound<F>);    // bent away from i, not mirrored
        EXPECT_LT(dot(t, n), 0);               // and goes on down
    });
}

TYPED_TEST(Laws, LightGoesBackTheWayItCame) {
    using F = TypeParam;
    for_each_ray<F>([](const Surface&, TracedDisplay<F> scene, V, V normal, const Ray<F>& ray) {
        scene.fresnel = Fresnel::exact;
        const Crossing<F> here{F(0), {F(normal.x), F(normal.y), F(normal.z)}, {F(0), F(0)}, true};
        GlassRays<F> rays{{F(0), F(0), F(0)}, ray.to, {F(0), F(0)}, false, false};
        F in = F(1), out = F(1);
        cross(scene, here, true, rays, in);
        EXPECT_TRUE(rays.inside);
        rays.to = {-rays.to.x, -rays.to.y, -rays.to.z};
        cross(scene, here, true, rays, out);
        EXPECT_FALSE(rays.inside);
        EXPECT_LT(length(V{double(rays.to.x + ray.to.x), double(rays.to.y + ray.to.y), double(rays.to.z + ray.to.z)}),
                  2 * bound<F>);
        EXPECT_NEAR(double(in), double(out), 20 * bound<F>);  // reciprocity
    });
}

TYPED_TEST(Laws, BeyondTheCriticalAngleLightIsMirrored) {
    using F = TypeParam;
    TracedDisplay<F> scene = lens_with<F>(first_surfaces[0]);
    scene.fresnel = Fresnel::exact;
    const Crossing<F> here{F(0), {F(0), F(0), F(1)}, {F(0), F(0)}, true};
    const double critical = std::asin(1 / 1.5);
    for (double angle = 0.5 * degree; angle < 89.6 * degree; angle += degree) {
        GlassRays<F> rays{{F(0), F(0), F(0)}, {F(std::sin(angle)), F(0), F(std::cos(angle))}, {F(0), F(0)}, true, false};
        F weight = F(1);
        cross(scene, here, true, rays, weight);
        EXPECT_EQ(rays.inside, angle > critical) << angle / degree;
        EXPECT_EQ(weight == F(1), angle > critical) << angle / degree;
        if (angle < critical) continue;
        EXPECT_NEAR(double(rays.to.x), std::sin(angle), bound<F>);
        EXPECT_NEAR(double(rays.to.z), -std::cos(angle), bound<F>);
    }
}

TYPED_TEST(Laws, SequentialLightEndsBeyondTheCriticalAngle) {
    using F = TypeParam;
    TracedDisplay<F> scene = lens_with<F>(first_surfaces[0]);
    const SurfaceData<F>& back = scene.surface[1];  // from glass into air, going down
    const double critical = std::asin(1 / 1.5);
    for (double angle = 0.5 * degree; angle < 89.6 * degree; angle += degree) {
        const Ray<F> ray{{F(0), F(0), F(0)}, {F(std::sin(angle)), F(0), F(-std::cos(angle))}};
        Passage<F> passage{ray, {F(0), F(0)}, F(1), true};
        refract_down<Facts{}>(scene, back.shape, back, meet(back.shape, back, ray), passage);
        EXPECT_EQ(passage.alive, angle < critical) << angle / degree;
        if (passage.alive) {
            EXPECT_NEAR(double(passage.ray.to.x), 1.5 * std::sin(angle), bound<F>);
        }
    }
}

// A sphere of curvature c departs from its tangent plane by c s^2/2, and so does the place where a ray of slope m meets it by m c
// s^2/2 to first order; the normal turns by c s, the refracted ray by (n - 1)/n c s at normal incidence and at most 1.5 times it
// here.
TEST(PlaneLimit, SpheresFlattenIntoThePlane) {
    const TracedDisplay<double> flat = lens_with<double>({0, 0, {}, 6});
    const Ray<double> ray{{3, -2, 0}, {0.3, 0.4, -std::sqrt(0.75)}};
    auto pass = [&](const TracedDisplay<double>& scene, Shape shape) {
        Passage<double> passage{ray, {0, 0}, 1, true};
        refract_down<Facts{}>(scene, shape, scene.surface[0], meet(shape, scene.surface[0], ray), passage);
        EXPECT_TRUE(passage.alive);
        return passage.ray;
    };
    const Ray<double> plane = pass(flat, Shape::plane);
    for (double c = 1e-2; c > 1e-12; c /= 10) {
        const Ray<double> sphere = pass(lens_with<double>({c, 0, {}, 6}), Shape::sphere);
        EXPECT_LT(length(minus(sphere.at, plane.at)), 1.2 * (c * 13 / 2) / ray.to.z * -1 + 1e-15) << c;
        EXPECT_GT(length(minus(sphere.at, plane.at)), 0.8 * (c * 13 / 2) - 1e-15) << c;
        EXPECT_LT(length(minus(sphere.to, plane.to)), 1.5 * c * std::sqrt(13.0) + 1e-15) << c;
    }
    // The sphere's own formulas hold at c = 0.
    const Ray<double> zero = pass(flat, Shape::sphere);
    EXPECT_LT(length(minus(zero.at, plane.at)), 1e-15);
    EXPECT_LT(length(minus(zero.to, plane.to)), 1e-15);
}

}  // namespace
}  // namespace lfdsim::optics
