// What depends on the colour of light in a display whose glass disperses. Floor 4.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"

#include <string>
#include <utility>
#include <vector>

namespace lfdsim {

/// The theory of one of the panel's channels, at its wavelength.
struct ChannelTheory {
    const char *key, *name;  // "r", "red"
    double wavelength_nm, focal_length_mm, gap_mm, central_depth_mm;
    std::vector<std::pair<std::string, double>> indices;  // of each glass, by the table that has it
};

/// Red, green and blue; none where light of all wavelengths takes the same path.
std::vector<ChannelTheory> theory_by_colour(const Display&);

/// {"r": {"wavelength_nm": ..., "index": {"lens": ...}}, ...}
Json to_json(const std::vector<ChannelTheory>&);

}  // namespace lfdsim
