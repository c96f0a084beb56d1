// Diffusers' profiles; a gaussian one as a sum of boxes.
#include "geometry/diffuser_profile.h"
#include "base/constants.h"
#include "optics/diffuser.h"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

const double sigma = 4 / (2 * std::sqrt(2 * std::numbers::ln2));  // of a full width at half maximum of 4 degrees
const Diffuser bell{20, {4, 6}, Profile::gaussian};

/// The 2m-th moment of the boxes' sum along x, in sigma: that of even light between -w and w is w^2m / (2m + 1).
double moment(const std::vector<DiffuserBox>& boxes, int m) {
    double sum = 0;
    for (const DiffuserBox& b : boxes) sum += b.weight * std::pow(b.angle_deg[0] / 2 / sigma, 2 * m) / (2 * m + 1);
    return sum;
}

TEST(Bell, ItsBoxesHaveItsMoments) {
    for (int n = 1; n <= 8; ++n) {
        const auto boxes = boxes_of_normal_distribution(bell, n);
        ASSERT_EQ(boxes.size(), std::size_t(n * n));
        double wanted = 1;  // (2m - 1)!!
        for (int m = 0; m <= 2 * n - 1; ++m) {
            EXPECT_NEAR(moment(boxes, m) / wanted, 1, 1e-11) << n << " boxes, moment " << 2 * m;
            wanted *= 2 * m + 1;
        }
        for (const DiffuserBox& b : boxes) EXPECT_GT(b.weight, 0);
    }
}

TEST(Bell, OneBoxHasItsVariance) {
    const DiffuserBox box = boxes_of_normal_distribution(bell, 1).at(0);
    EXPECT_NEAR(box.angle_deg[0], 2 * std::sqrt(3) * sigma, 1e-12);
    EXPECT_NEAR(box.angle_deg[1] / box.angle_deg[0], 1.5, 1e-12);
}

TEST(Bell, EndsAtTheHorizon) {
    for (const DiffuserBox& b : boxes_of_normal_distribution({20, {100, 4}, Profile::gaussian}, 4)) EXPECT_LE(b.angle_deg[0], 178);
}

class ProfileFiguresOf : public testing::TestWithParam<Profile> {};

TEST_P(ProfileFiguresOf, Agree) {
    const ProfileFigures& of = figures_of(GetParam());
    constexpr int steps = 20000;
    const double step = 2 * of.reach / steps;
    for (const double waves : {0., 0.1, 0.45, 0.8, 1.7}) {  // the transform is that of the density
        double sum = 0;
        for (int k = 0; k < steps; ++k) {
            const double from = -of.reach + k * step;
            sum += (of.below(from + step) - of.below(from)) * std::cos(2 * pi * waves * (from + 0.5 * step));
        }
        EXPECT_NEAR(sum, of.transfer(waves), 1e-5) << waves;
    }
    EXPECT_NEAR(of.below(of.reach), 1, 1e-5);
    EXPECT_GE(2 * of.below(0.5 * of.width) - 1, 0.98);
    for (const double u : {-0.9, -0.2, 0.5, 0.99})  // angles of scattering for uniform numbers have the profile's distribution
        EXPECT_NEAR(of.below(optics::scattering_angle(GetParam(), of.scale, u, 1.)), 0.5 * (1 + u), 1e-9) << u;
}

INSTANTIATE_TEST_SUITE_P(Every, ProfileFiguresOf, testing::Values(Profile::box, Profile::gaussian));

}  // namespace
}  // namespace lfdsim
