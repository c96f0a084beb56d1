#include "report/folder/colours.h"

#include "analysis/core/figure_json.h"
#include "base/constants.h"
#include "display/colour.h"
#include "geometry/geometry.h"

namespace lfdsim {

std::vector<ChannelTheory> theory_by_colour(const Display& d) {
    constexpr const char* keys[] = {"r", "g", "b"};
    std::vector<ChannelTheory> all;
    if (!disperses(d)) return all;
    for (std::size_t k = 0; k < 3; ++k) {
        const double nm = d.panel.wavelengths_nm[k];
        const Theory t = theory(d, resolve(d, nm));
        all.push_back({keys[k], colour_of_channel[k], nm, t.focal_length_mm, t.gap_mm, t.central_depth_mm, {}});
        for (const Medium& medium : media_of(d))
            if (medium.glass && medium.is_passed) all.back().indices.emplace_back(medium.table, index_of(*medium.glass, nm));
    }
    return all;
}

Json to_json(const std::vector<ChannelTheory>& all) {
    Json json = Json::object();
    for (const ChannelTheory& c : all) {
        json[c.key] = {{"wavelength_nm", c.wavelength_nm},
                       {"focal_length_mm", number_json(c.focal_length_mm)},
                       {"gap_mm", c.gap_mm},
                       {"central_depth_mm", number_json(c.central_depth_mm)},
                       {"index", Json::object()}};
        for (const auto& [table, n] : c.indices) json[c.key]["index"][table] = n;
    }
    return json;
}

}  // namespace lfdsim
