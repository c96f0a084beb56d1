#include "analysis/crosstalk/intended_light.h"

#include "base/constants.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

MeantLight::MeantLight(const MetPlaces& met, const std::vector<ChannelWeights>& weights, const MeantPanel& panel) {
    for (std::size_t k = 0; k < rays_.size(); ++k) {
        rays_[k].reserve(met.sets()[k].size());
        for (const MetPlaces::Met& m : met.sets()[k])
            if (const auto meant = panel.at(m.x, m.y, weights[m.path])) {
                const float light = float(m.light * meant->light);
                if (meant->slopes.all().size() > 1)
                    on_borders_[k].push_back({meant->slopes, light});
                else
                    rays_[k].push_back({meant->slopes.chosen(), light});
                brightest_ = std::max(brightest_, double(light));
            }
    }
}

LightPart MeantLight::between(double low, double high) const {
    constexpr double rounding = 1e-9;  // of slopes
    // Returns the share of light with a slope that belongs to the part: 1 inside, 1/2 at an end, 0 outside and for NaN.
    const auto share = [&](double slope) {
        const double inside = std::min(slope - low, high - slope);
        return std::abs(inside) <= rounding ? 0.5 : inside > 0 ? 1. : 0.;
    };
    LightPart part;
    for (std::size_t k = 0; k < rays_.size(); ++k) {
        for (const InnerRay& ray : rays_[k]) part.light[k] += share(ray.slope) * double(ray.light);
        for (const BorderRay& ray : on_borders_[k]) {
            // On a border of elemental images the share lies between the least and the greatest of its lenses: the mean counts.
            double least = 1, most = 0;
            for (const double slope : ray.slopes.all()) {
                least = std::min(least, share(slope));
                most = std::max(most, share(slope));
            }
            part.light[k] += 0.5 * (least + most) * double(ray.light);
            part.open += 0.5 * (most - least) * double(ray.light);
        }
    }
    return part;
}

Crosstalk crosstalk_of(const LightPart& leak, const LightPart& signal, double missed) {
    const auto of_all_but = [&](int without) {
        return 100 * std::max(total(leak.light, without), 0.) / total(signal.light, without);
    };
    Crosstalk found{jackknife(of_all_but)};
    Estimate& e = found.percent;
    // With the signal's share of the light, crosstalk is (1 - share)/share: an error d of the share makes an error d/share^2 of
    // it.
    const double inverse_share = 1 + e.value / 100;
    if (std::isfinite(e.error)) e.error = std::max(e.error, 100 * missed * inverse_share * inverse_share);
    if (!(leak.open + signal.open > 0)) return found;
    // The crosstalk with all undecided light on one side, and on the other
    const double least = 100 * std::max(total(leak.light) - leak.open, 0.) / (total(signal.light) + signal.open),
                 most = 100 * (total(leak.light) + leak.open) / std::max(total(signal.light) - signal.open, 0.),
                 open = std::max(e.value - least, most - e.value);
    found.left_to_rounding = !(open <= std::max(0.5 * e.value, 1.));
    e = found.left_to_rounding ? Estimate{} : Estimate{e.value, e.error + open};
    return found;
}

Leak leak_of_side(const MeantLight& light, std::size_t side) {
    const LightPart left = light.between(-infinity, 0), right = light.between(0, infinity);
    return side == 0 ? Leak{left, right} : Leak{right, left};
}

Crosstalk crosstalk_of(const MeantLight& light, const Leak& found) {
    return crosstalk_of(found.leak, found.signal, light.missed());
}

}  // namespace lfdsim
