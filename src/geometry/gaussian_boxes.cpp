#include "geometry/gaussian_boxes.h"

#include "base/hermite.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {

std::vector<DiffuserBox> boxes_of_bell(const Diffuser& bell, int per_axis) {
    const std::size_t degree = 2 * std::size_t(per_axis) + 1;
    struct HermiteNode {
        double half_width, weight;  // in standard deviations
    };
    std::vector<HermiteNode> nodes;
    double sum = 0;
    for (const double x : hermite_zeros(degree)) {
        if (!(x > 0)) continue;
        nodes.push_back({std::numbers::sqrt2 * x, x * x * hermite_weight(degree, x)});
        sum += nodes.back().weight;
    }
    const auto full_angle = [&](int axis, const HermiteNode& node) {
        const double sigma = bell.angle_deg[std::size_t(axis)] / (2 * std::sqrt(2 * std::numbers::ln2));
        return 2 * std::min(node.half_width * sigma, 89.);
    };
    std::vector<DiffuserBox> boxes;
    for (const HermiteNode& down : nodes)
        for (const HermiteNode& across : nodes)
            boxes.push_back({{full_angle(0, across), full_angle(1, down)}, across.weight * down.weight / (sum * sum)});
    return boxes;
}

}  // namespace lfdsim
