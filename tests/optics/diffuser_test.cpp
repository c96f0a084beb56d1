// The diffuser turns rays: a proper rotation, about y first, by angles of the stated density.
#include <gtest/gtest.h>

#include "example.h"

namespace lfdsim::optics {
namespace {

using V = Vec3<double>;

/// The matrix of Rx(b) Ry(a): its columns are the turned unit vectors.
std::array<V, 3> columns(double a, double b) {
    auto image = [&](V v) { return turn(v, std::sin(a), std::cos(a), std::sin(b), std::cos(b)); };
    return {image({1, 0, 0}), image({0, 1, 0}), image({0, 0, 1})};
}

/// Rodrigues' formula: v turned by `angle` about the unit vector k.
V rodrigues(V v, V k, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), along = dot(k, v) * (1 - c);
    return {v.x * c + (k.y * v.z - k.z * v.y) * s + k.x * along, v.y * c + (k.z * v.x - k.x * v.z) * s + k.y * along,
            v.z * c + (k.x * v.y - k.y * v.x) * s + k.z * along};
}

template <class Check>
void for_angles(Check check) {
    for (int a = -89; a <= 89; a += 7) {
        for (int b = -89; b <= 89; b += 7) check(a * degree, b * degree);
    }
}

// The printed matrix of the 2019 paper (Eq. 7) is symmetric; about x its determinant is cos 2 b, no rotation.
TEST(Diffuser, IsARotation) {
    for_angles([](double a, double b) {
        const auto [x, y, z] = columns(a, b);
        const V normal{y.y * z.z - y.z * z.y, y.z * z.x - y.x * z.z, y.x * z.y - y.y * z.x};
        EXPECT_NEAR(dot(x, normal), 1, 1e-15);  // determinant
        for (double product : {dot(x, y), dot(y, z), dot(z, x)}) EXPECT_NEAR(product, 0, 1e-15);
        for (double square : {dot(x, x), dot(y, y), dot(z, z)}) EXPECT_NEAR(square, 1, 1e-15);
    });
}

TEST(Diffuser, TurnsAboutYFirst) {
    for_angles([](double a, double b) {
        for (V v : {V{0, 0, -1}, V{0.36, -0.48, -0.8}}) {
            const V t = turn(v, std::sin(a), std::cos(a), std::sin(b), std::cos(b));
            const V wanted = rodrigues(rodrigues(v, {0, 1, 0}, a), {1, 0, 0}, b);
            EXPECT_NEAR(t.x, wanted.x, 1e-15);
            EXPECT_NEAR(t.y, wanted.y, 1e-15);
            EXPECT_NEAR(t.z, wanted.z, 1e-15);
        }
        // An upright ray keeps its horizontal spread, -sin a, whatever b: the other order would cut it by cos b.
        EXPECT_NEAR(turn(V{0, 0, -1}, std::sin(a), std::cos(a), std::sin(b), std::cos(b)).x, -std::sin(a), 1e-15);
    });
}

template <class F>
TracedDisplay<F> diffusing(Profile profile, double horizontal_deg, double vertical_deg) {
    Display d = example();
    d.diffuser = Diffuser{100, {horizontal_deg, vertical_deg}, profile};
    return make_traced_display<F>(d, resolve(d));
}

// scatter() by the float polynomials against double: 1e-7 of each sine and cosine, a few of them.
TEST(Diffuser, ScattersInFloatAsInDouble) {
    Random random(7);
    for (double angle : {0.5, 4.0, 30.0, 120.0, 179.0}) {
        for (Profile profile : {Profile::box, Profile::gaussian}) {
            const TracedDisplay<float> narrow = diffusing<float>(profile, angle, angle / 2);
            const TracedDisplay<double> wide = diffusing<double>(profile, angle, angle / 2);
            for (int n = 0; n < 2000; ++n) {
                const double u = double(float(random(-1, 1))), v = double(float(random(-1, 1)));
                const V t = scatter(wide, {0.36, -0.48, -0.8}, u, v);
                const Vec3<float> f = scatter(narrow, {0.36f, -0.48f, -0.8f}, float(u), float(v));
                // erfinv's relative error of 1e-6 counts angles of 1.6 rad at most; near its ends the rounding of u, 6e-8 of
                // 1 - |u|, moves it further, but no further than 2e-5 (checked here)
                const double bound = profile == Profile::box ? 1e-6 : 2e-5;
                EXPECT_NEAR(double(f.x), t.x, bound);
                EXPECT_NEAR(double(f.y), t.y, bound);
                EXPECT_NEAR(double(f.z), t.z, bound);
            }
        }
    }
}

// Angles for random numbers, put through the density's integral, are uniform, on both axes together.
TEST(Diffuser, AnglesFollowTheirDensity) {
    for (Profile profile : {Profile::box, Profile::gaussian}) {
        for (const auto [horizontal, vertical] : {std::array{2.0, 1.0}, std::array{40.0, 4.74}, std::array{110.0, 60.0}}) {
            const TracedDisplay<float> scene = diffusing<float>(profile, horizontal, vertical);
            auto share = [&](double angle, double full_deg) {  // of the density below the angle
                if (profile == Profile::box) return angle / (full_deg * degree) + 0.5;
                const double scale = full_deg * degree / (2 * std::sqrt(2 * std::numbers::ln2)) * std::sqrt(2.0);  // sigma sqrt 2
                return std::erf(angle / scale) / std::erf(89 * degree / scale) / 2 + 0.5;
            };
            Sampler<float> sampler(Sampling::random, 2, 11, 0);
            constexpr int bins = 16;
            std::vector<int> counts(bins * bins);
            double sum = 0, most = 0;
            constexpr int samples = 100000;
            for (; sampler.sample < samples; ++sampler.sample) {
                // an upright ray comes to (-sin a, sin b cos a, -cos b cos a)
                const Vec3<float> t = scatter(scene, {0, 0, -1}, sampler(0), sampler(1));
                const double a = std::asin(-double(t.x)), b = std::atan2(double(t.y), -double(t.z));
                ++counts[bin(share(a, horizontal), bins) * bins + bin(share(b, vertical), bins)];
                sum += a;
                most = std::max(most, std::abs(a));
            }
            EXPECT_LT(chi_square(counts), unlikely) << horizontal;
            // centred: the mean of n angles below h in size is within 5 h / sqrt n of zero
            EXPECT_NEAR(sum / samples, 0, 5 * most / std::sqrt(samples));
            EXPECT_LE(most, (profile == Profile::box ? horizontal / 2 : 89) * degree + 1e-5);
            if (profile == Profile::box) {
                EXPECT_GT(most, 0.999 * horizontal / 2 * degree);
            }
        }
    }
}

// Where the numbers are most extreme the normal distribution is cut, at +-89 degrees, however wide it is.
TEST(Diffuser, GaussianEndsAt89Degrees) {
    for (double full : {60.0, 110.0, 170.0}) {
        const TracedDisplay<double> scene = diffusing<double>(Profile::gaussian, full, full);
        for (double u : {-1.0, 1.0}) EXPECT_NEAR(diffuser_angle(scene, 0, u), u * 89 * degree, 1e-3) << full;
    }
}

// Half the density at half the full width: the central difference of the angle as a function of the uniform number is 1 / density.
TEST(Diffuser, GaussianHasItsFullWidthAtHalfMaximum) {
    for (double full : {1.0, 10.0, 80.0}) {
        const TracedDisplay<double> scene = diffusing<double>(Profile::gaussian, full, full);
        auto spread = [&](double u) { return diffuser_angle(scene, 0, u + 1e-6) - diffuser_angle(scene, 0, u - 1e-6); };
        double low = 0, high = 1;  // the number that gives half the width
        for (int i = 0; i < 60; ++i) {
            const double middle = (low + high) / 2;
            (diffuser_angle(scene, 0, middle) < full / 2 * degree ? low : high) = middle;
        }
        EXPECT_NEAR(spread(0) / spread(low), 0.5, 1e-6) << full;
    }
}

}  // namespace
}  // namespace lfdsim::optics
