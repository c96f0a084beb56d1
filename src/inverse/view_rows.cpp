#include "inverse/view_rows.h"

#include "display/colour.h"
#include "geometry/subpixels.h"

#include <algorithm>

namespace lfdsim {

bool entries_are_pixels(const Display& d) { return d.panel.subpixels == SubpixelLayout::none && !disperses(d); }

ViewRows::ViewRows(const Display& seen, const Geometry& geometry)
    : width_(int(seen.camera.resolution[0])),
      height_(int(seen.camera.resolution[1])),
      pixels_(entries_are_pixels(seen)),
      subpixels_(!lights_whole_pixels(seen.panel)) {
    if (!disperses(seen)) {
        lights_.push_back({PanelRays(seen, geometry), -1, 1});
        return;
    }
    for (int channel = 0; channel < 3; ++channel)
        for (const Node& node : wavelengths_of(seen, channel))
            lights_.push_back({PanelRays(seen, resolve(seen, node.wavelength_nm)), channel, float(node.weight)});
}

std::int64_t ViewRows::rays() const {
    std::int64_t sum = 0;
    for (const WavelengthRays& light : lights_) sum += light.rays.samples();
    return sum;
}

void ViewRows::add(const WavelengthRays& light, const PanelRay& ray, std::vector<PanelRay>& row) const {
    const float share = ray.share * light.weight / float(light.rays.samples());
    const std::uint32_t pixel = ray.pixel(subpixels_);
    if (pixels_) return row.push_back({pixel, share});
    for (std::uint32_t c = 0; c < 3; ++c)
        if (ray.lights(c, subpixels_) && (light.channel < 0 || std::uint32_t(light.channel) == c))
            row.push_back({pixel * 4 + c, share});
}

Rows ViewRows::of(int y0, int y1) const {
    // All rays; then for each element their entries in the order of places, those of one place added up
    std::vector<std::vector<PanelRay>> rays(lights_.size());
    for (std::size_t k = 0; k < lights_.size(); ++k) lights_[k].rays.trace({0, y0, width_, y1}, rays[k]);
    Rows rows;
    std::vector<PanelRay> row;
    const std::size_t elements = std::size_t(width_) * std::size_t(y1 - y0);
    rows.start.reserve(elements + 1);
    for (std::size_t p = 0; p < elements; ++p) {
        row.clear();
        for (std::size_t k = 0; k < lights_.size(); ++k) {
            const auto samples = std::size_t(lights_[k].rays.samples());
            for (std::size_t s = p * samples; s < (p + 1) * samples; ++s)
                if (rays[k][s].share > 0) add(lights_[k], rays[k][s], row);
        }
        std::sort(row.begin(), row.end(), [](const PanelRay& a, const PanelRay& b) { return a.place < b.place; });
        for (const PanelRay& ray : row) {
            const bool again = rows.entries.size() > rows.start.back() && rows.entries.back().place == ray.place;
            if (again)
                rows.entries.back().share += ray.share;
            else
                rows.entries.push_back(ray);
        }
        rows.start.push_back(std::uint32_t(rows.entries.size()));
    }
    return rows;
}

}  // namespace lfdsim
