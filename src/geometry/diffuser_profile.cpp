#include "geometry/diffuser_profile.h"

#include "base/hermite.h"
#include "base/sinc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

constexpr double ln2 = std::numbers::ln2;

constexpr ProfileFigures box{
    .below = [](double angle) { return std::clamp(angle + 0.5, 0., 1.); },
    .transfer = sinc,
    .scale = 0.5,
    .reach = 0.5,
    .width = 1,
    .rectangular = true,
};

const double fwhm_per_sigma = 2 * std::sqrt(2 * ln2);

const ProfileFigures normal_distribution{
    .below = [](double angle) { return 0.5 * (1 + std::erf(2 * angle * std::sqrt(ln2))); },
    .transfer =
        [](double waves) {  // exp(-2 (pi sigma waves)^2), sigma in units of the full width
            const double pi_sigma = pi / fwhm_per_sigma;
            return std::exp(-2 * pi_sigma * pi_sigma * waves * waves);
        },
    .scale = 1 / (2 * std::sqrt(ln2)),  // sigma sqrt(2)
    .reach = 2,
    .width = 2,
    .rectangular = false,
};

}  // namespace

const ProfileFigures& figures_of(Profile profile) { return profile == Profile::box ? box : normal_distribution; }

std::vector<DiffuserBox> boxes_of_normal_distribution(const Diffuser& diffuser, int per_axis) {
    const std::size_t zeros = 2 * std::size_t(per_axis) + 1;
    struct HermiteNode {
        double half_width, weight;  // in standard deviations
    };
    std::vector<HermiteNode> nodes;
    double sum = 0;
    for (const double x : hermite_zeros(zeros)) {
        if (!(x > 0)) continue;
        nodes.push_back({std::numbers::sqrt2 * x, x * x * hermite_weight(zeros, x)});
        sum += nodes.back().weight;
    }
    const auto full_angle = [&](int axis, const HermiteNode& node) {
        const double sigma = diffuser.angle_deg[std::size_t(axis)] / fwhm_per_sigma;
        return 2 * std::min(node.half_width * sigma, 89.);
    };
    std::vector<DiffuserBox> boxes;
    for (const HermiteNode& down : nodes)
        for (const HermiteNode& across : nodes)
            boxes.push_back({{full_angle(0, across), full_angle(1, down)}, across.weight * down.weight / (sum * sum)});
    return boxes;
}

}  // namespace lfdsim
