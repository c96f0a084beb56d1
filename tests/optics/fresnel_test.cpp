// What Fresnel's equations leave of a ray, against amplitude coefficients and closed forms.
#include <gtest/gtest.h>

#include "example.h"

namespace lfdsim::optics {
namespace {

/// Transmittance from index n1 into n2 at the angle of incidence, as the tracer has it.
template <class F>
double transmitted(Fresnel kind, double n1, double n2, double angle) {
    const double c1 = std::cos(angle), c2 = std::sqrt(1 - std::pow(n1 / n2 * std::sin(angle), 2)), r = (n1 - n2) / (n1 + n2);
    return double(transmittance(kind, F(1 - r * r), F(n1), F(n2), F(c1), F(c2), F(n1 < n2 ? c1 : c2)));
}

/// Mean reflectance of both polarisations from the amplitude coefficients (Born and Wolf, Principles of Optics, sec. 1.5.2), in
/// their form by sines and tangents of the angles.
double reflected(double n1, double n2, double i) {
    const double t = std::asin(n1 / n2 * std::sin(i));
    if (i == 0) return std::pow((n1 - n2) / (n1 + n2), 2);
    const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
    return (s * s + p * p) / 2;
}

double highest_angle(double n1, double n2) { return n1 > n2 ? std::asin(n2 / n1) : 90 * degree; }

constexpr double media[][2] = {{1, 1.4918}, {1.4918, 1}, {1, 1.9}, {1.9, 1}, {1.5, 1.7}, {1.7, 1.5}};

// Float: a few roundings of 6e-8 each, magnified near grazing, where T falls with the cosine: relative to T. 0.5 degrees from it
// the rounding of the cosine, 6e-8 / 0.009, is what counts.
TEST(Fresnel, ReflectedAndTransmittedAreAll) {
    for (const auto [n1, n2] : media) {
        const double end = highest_angle(n1, n2) - 0.5 * degree;
        for (int k = 0; k <= 500; ++k) {
            const double angle = end * k / 500, left = 1 - reflected(n1, n2, angle);
            EXPECT_NEAR(transmitted<double>(Fresnel::exact, n1, n2, angle), left, 1e-13) << n1 << " " << n2 << " " << angle;
            EXPECT_NEAR(transmitted<float>(Fresnel::exact, n1, n2, angle), left, 2e-6) << n1 << " " << n2 << " " << angle;
        }
    }
}

TEST(Fresnel, NormalIncidence) {
    for (const auto [n1, n2] : media) {
        const double t = 4 * n1 * n2 / ((n1 + n2) * (n1 + n2));
        EXPECT_NEAR(transmitted<double>(Fresnel::exact, n1, n2, 0), t, 1e-15);
        EXPECT_NEAR(transmitted<double>(Fresnel::schlick, n1, n2, 0), t, 1e-15);
        EXPECT_NEAR(transmitted<float>(Fresnel::exact, n1, n2, 0), t, 3e-7);
    }
}

// At Brewster's angle no light polarised in the plane of incidence is reflected, of the other ((1 - m^2)/(1 + m^2))^2, m = n2/n1.
TEST(Fresnel, BrewstersAngle) {
    for (const auto [n1, n2] : media) {
        const double m = n2 / n1, s = (1 - m * m) / (1 + m * m);
        EXPECT_NEAR(transmitted<double>(Fresnel::exact, n1, n2, std::atan(m)), 1 - s * s / 2, 1e-14);
    }
}

TEST(Fresnel, NothingEntersAtGrazingIncidence) {
    for (Fresnel kind : {Fresnel::exact, Fresnel::schlick}) {
        for (const auto [n1, n2] : media) {
            double before = 1;
            for (double off : {1e-2, 1e-4, 1e-6, 1e-8}) {
                // from the dense side the other angle is sqrt(2 off tan) from 90 degrees; T is at most some 10 times that cosine
                const double t = transmitted<double>(kind, n1, n2, highest_angle(n1, n2) - off);
                EXPECT_GE(t, 0);
                EXPECT_LT(t, 20 * std::sqrt(off));
                EXPECT_LT(t, before);
                before = t;
            }
        }
    }
}

TEST(Fresnel, BothWaysAlike) {
    for (Fresnel kind : {Fresnel::exact, Fresnel::schlick}) {
        for (int k = 0; k < 90; ++k) {
            const double above = k * degree, below = std::asin(std::sin(above) / 1.4918);
            EXPECT_NEAR(transmitted<double>(kind, 1, 1.4918, above), transmitted<double>(kind, 1.4918, 1, below), 1e-13);
        }
    }
}

// Schlick's approximation with the cosine on the dense side would reflect 4 % at the critical angle, where the truth is all.
TEST(Fresnel, SchlickTakesTheThinSidesCosine) {
    const double n = 1.5, critical = std::asin(1 / n);
    EXPECT_NEAR(1 - transmitted<double>(Fresnel::schlick, n, 1, 0), 0.04, 1e-15);
    EXPECT_NEAR(1 - transmitted<double>(Fresnel::schlick, 1, n, 0), 0.04, 1e-15);
    EXPECT_NEAR(1 - transmitted<double>(Fresnel::schlick, n, 1, critical - 1e-12), 1, 1e-4);
    EXPECT_NEAR(1 - transmitted<double>(Fresnel::schlick, 1, n, 90 * degree), 1, 1e-14);
    for (int k = 0; k < 80; ++k) {  // and is what its formula says
        const double above = k * degree, schlick = 0.04 + 0.96 * std::pow(1 - std::cos(above), 5);
        EXPECT_NEAR(1 - transmitted<double>(Fresnel::schlick, 1, n, above), schlick, 1e-14);
    }
}

// The passages of the tracer itself, down through air to glass and glass to air, and in and out of a solid: each must hand the
// right cosines to the right places.
TEST(Fresnel, PassagesCarryTheRightWeight) {
    const Display d = with_surfaces({{0, 0, {}, 6, 5, 1.5}, {0, 0, {}, 6}});
    TracedDisplay<double> scene = make_traced_display<double>(d, resolve(d));
    for (Fresnel kind : {Fresnel::exact, Fresnel::schlick, Fresnel::none}) {
        scene.fresnel = kind;
        for (int k = 0; k < 80; ++k) {
            const double above = k * degree, below = std::asin(std::sin(above) / 1.5);
            const double down = kind == Fresnel::none ? 1 : transmitted<double>(kind, 1, 1.5, above);
            const double up = kind == Fresnel::none ? 1 : transmitted<double>(kind, 1.5, 1, below);
            Passage<double> passage{{{0, 0, 0}, {std::sin(above), 0, -std::cos(above)}}, {0, 0}, 1, true};
            refract_down<Facts{}>(scene, Shape::plane, scene.surface[0], meet(Shape::plane, scene.surface[0], passage.ray),
                                  passage);
            EXPECT_NEAR(passage.weight, down, 1e-13);
            passage.weight = 1;
            refract_down<Facts{}>(scene, Shape::plane, scene.surface[1], meet(Shape::plane, scene.surface[1], passage.ray),
                                  passage);
            EXPECT_NEAR(passage.weight, up, 1e-13);

            const Crossing<double> here{0, {0, 0, 1}, {0, 0}, true};
            GlassRays<double> rays{{0, 0, 0}, {std::sin(above), 0, -std::cos(above)}, {0, 0}, false, false};
            double weight = 1;
            cross(scene, here, true, rays, weight);
            EXPECT_NEAR(weight, down, 1e-13);
            rays.to.z = -rays.to.z;
            weight = 1;
            cross(scene, here, true, rays, weight);
            EXPECT_NEAR(weight, up, 1e-13);
        }
    }
}

}  // namespace
}  // namespace lfdsim::optics
