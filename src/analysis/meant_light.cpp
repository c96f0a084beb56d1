#include "analysis/meant_light.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

MeantLight::MeantLight(const MetPlaces& met, const std::vector<ChannelWeights>& weights, const MeantPanel& panel) {
    for (std::size_t k = 0; k < rays_.size(); ++k) {
        rays_[k].reserve(met.sets()[k].size());
        for (const MetPlaces::Met& m : met.sets()[k])
            if (const auto meant = panel.at(m.x, m.y, weights[m.path])) {
                rays_[k].push_back({meant->slope, float(m.light * meant->light)});
                brightest_ = std::max(brightest_, double(rays_[k].back().light));
            }
    }
}

Sums MeantLight::between(double low, double high) const {
    constexpr double rounding = 1e-9;  // of slopes
    Sums sums{};
    for (std::size_t k = 0; k < rays_.size(); ++k)
        for (const Ray& ray : rays_[k]) {
            const double inside = std::min(ray.slope - low, high - ray.slope);
            if (std::abs(inside) <= rounding)
                sums[k] += 0.5 * double(ray.light);
            else if (inside > 0)
                sums[k] += double(ray.light);
        }
    return sums;
}

Estimate MeantLight::crosstalk_percent(const Sums& leak, const Sums& signal) const {
    const auto of_all_but = [&](int without) { return 100 * std::max(total(leak, without), 0.) / total(signal, without); };
    Estimate found = jackknife(of_all_but);
    // A share that is wrong by d makes (1 - share) / share wrong by d / share^2.
    const double inverse_share = 1 + found.value / 100, missed = 3 * brightest_ / total(all());
    if (std::isfinite(found.error)) found.error = std::max(found.error, 100 * missed * inverse_share * inverse_share);
    return found;
}

}  // namespace lfdsim
