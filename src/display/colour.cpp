#include "display/colour.h"
#include "geometry/lens_misalignment.h"

#include "base/hermite.h"
#include "geometry/geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {
std::vector<Node> wavelengths_of(const Display& d, int channel) {
    const auto c = std::size_t(channel);
    const double middle = d.panel.wavelengths_nm[c];
    const auto K = std::size_t(std::clamp<std::int64_t>(d.render.wavelength_samples, 1, max_wavelength_samples));
    if (K == 1 || !d.panel.primary_widths_nm) return {{middle, 1}};
    // sigma = w/(2 sqrt(2 ln 2)); the nodes are l + sqrt(2) sigma x, x the zeros of the Hermite polynomial of degree K.
    const double sigma = (*d.panel.primary_widths_nm)[c] / (2 * std::sqrt(2 * std::numbers::ln2));
    std::vector<Node> nodes;
    for (const double x : hermite_zeros(K)) nodes.push_back({middle + std::numbers::sqrt2 * sigma * x, hermite_weight(K, x)});
    return nodes;
}

double index_at(const std::optional<double>& index, const std::optional<Glass>& glass, double wavelength_nm) {
    return glass ? index_of(*glass, wavelength_nm) : index.value_or(1);
}

std::vector<Medium> media_of(const Display& d) {
    std::vector<Medium> all;
    for (std::size_t k = 0; k < d.panel.layers.size(); ++k) {
        const Layer& layer = d.panel.layers[k];
        all.push_back({"panel.layer." + std::to_string(k), layer.index, layer.glass, false, true});
    }
    if (const auto* ball = std::get_if<PlanoConvex>(&d.lens.kind)) all.push_back({"lens", ball->index, ball->glass, false, true});
    if (const auto* lens = std::get_if<SurfaceLens>(&d.lens.kind))
        for (std::size_t k = 0; k < lens->surfaces.size(); ++k) {
            const Surface& s = lens->surfaces[k];
            all.push_back({"lens.surface." + std::to_string(k), s.index, s.glass, true, k + 1 < lens->surfaces.size()});
        }
    return all;
}

bool disperses(const Display& d) {
    const std::vector<Medium> media = media_of(d);
    return std::any_of(media.begin(), media.end(), [&](const Medium& medium) {
        if (!medium.is_passed || !medium.glass) return false;
        const double first = index_of(*medium.glass, d.panel.wavelengths_nm[0]);
        for (int channel = 0; channel < 3; ++channel)
            for (const Node& node : wavelengths_of(d, channel))
                if (index_of(*medium.glass, node.wavelength_nm) != first) return true;
        return false;
    });
}

Display at_wavelength(Display d, double wavelength_nm) {
    if (d.array.gap_mm) {  // the gap ends at a principal plane, which is elsewhere in other light
        d.array.base_z_mm = resolve(without_errors(d)).base_z_mm;
        d.array.gap_mm.reset();
    }
    const auto settle = [&](auto& medium) {
        if (medium.glass) medium.index = index_of(*medium.glass, wavelength_nm);
        medium.glass.reset();
    };
    for (Layer& layer : d.panel.layers) settle(layer);
    if (auto* ball = std::get_if<PlanoConvex>(&d.lens.kind)) settle(*ball);
    if (auto* lens = std::get_if<SurfaceLens>(&d.lens.kind))
        for (Surface& s : lens->surfaces) settle(s);
    d.glass_catalogues.clear();
    return d;
}

}  // namespace lfdsim
