// A gaussian diffuser as a sum of boxes.
#include "geometry/gaussian_boxes.h"

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
        const auto boxes = boxes_of_bell(bell, n);
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
    const DiffuserBox box = boxes_of_bell(bell, 1).at(0);
    EXPECT_NEAR(box.angle_deg[0], 2 * std::sqrt(3) * sigma, 1e-12);
    EXPECT_NEAR(box.angle_deg[1] / box.angle_deg[0], 1.5, 1e-12);
}

TEST(Bell, EndsAtTheHorizon) {
    for (const DiffuserBox& b : boxes_of_bell({20, {100, 4}, Profile::gaussian}, 4)) EXPECT_LE(b.angle_deg[0], 178);
}

}  // namespace
}  // namespace lfdsim
