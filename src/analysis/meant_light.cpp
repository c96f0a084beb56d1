#include "analysis/meant_light.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

LineSets::LineSets(int count, std::int64_t seed) {
    for (int k = 0; k < independent_sets; ++k) sets_[std::size_t(k)] = even_choices(count, set_number(seed, k));
}

std::optional<double> meant_slope(const Pickup& pickup, const Geometry& g, double x_mm, double y_mm) {
    const Lattice<double>& lattice = pickup.lattice();
    if (!lattice.strips) {
        const NodalLine line = pickup.line(x_mm, y_mm);
        if (!line.owned) return {};
        if (pickup.irregular()) return line.mx + line.x * (pickup.scale - 1) / g.gap_mm;  // 1/E = (scale - 1)/g
        return (line.x * pickup.scale - x_mm) / g.gap_mm;
    }
    // The whole pixel, which a strip's edge cuts obliquely, shows what its centre is meant for.
    const double x = pickup.x_mm(pickup.column(x_mm)), y = pickup.y_mm(pickup.row(y_mm));
    const NodalLine line = pickup.line(x, y);
    if (!line.owned) return {};
    if (pickup.irregular()) {
        const double per_mm = (pickup.scale - 1) / g.gap_mm;
        return optics::to_array(lattice, line.mx + line.x * per_mm, line.my + line.y * per_mm).x / lattice.cos_turn;
    }
    return optics::to_array(lattice, line.x * pickup.scale - x, line.y * pickup.scale - y).x / (g.gap_mm * lattice.cos_turn);
}

MeantLight::MeantLight(const EyeRays& rays, const Pickup& pickup, const Geometry& g, const Vec3d& eye, const LineSets& lines)
    : slope_tolerance_(1e-12 * g.panel_width_mm / g.gap_mm) {
    for (std::size_t k = 0; k < rays_.size(); ++k) {
        rays_[k].reserve(2 * lines.sets()[k].size());
        for (const Choice& choice : lines.sets()[k])
            for (const Choice& c : {choice, LineSets::mirrored(choice)}) {
                const Sight s = rays.look(eye, c);
                if (!(s.light > 0)) continue;
                if (const auto slope = meant_slope(pickup, g, s.x, s.y)) rays_[k].push_back({*slope, float(s.light)});
            }
    }
}

Sums MeantLight::between(double low, double high) const {
    Sums sums{};
    for (std::size_t k = 0; k < rays_.size(); ++k)
        for (const Ray& ray : rays_[k]) {
            const double inside = std::min(ray.slope - low, high - ray.slope);
            if (std::abs(inside) <= slope_tolerance_)
                sums[k] += 0.5 * double(ray.light);
            else if (inside > 0)
                sums[k] += double(ray.light);
        }
    return sums;
}

Estimate MeantLight::crosstalk_percent(const Sums& leak, const Sums& signal) const {
    const auto of_all_but = [&](int without) { return 100 * std::max(total(leak, without), 0.) / total(signal, without); };
    Estimate found = jackknife(of_all_but);
    std::size_t lines = 0;
    for (const auto& set : rays_) lines += set.size();
    // A share that is wrong by d makes (1 - share) / share wrong by d / share^2.
    const double inverse_share = 1 + found.value / 100, least = 100 * 3. / double(lines) * inverse_share * inverse_share;
    if (std::isfinite(found.error)) found.error = std::max(found.error, least);
    return found;
}

}  // namespace lfdsim
