// The theory of a display whose glass disperses, for each colour of light. Floor 4.
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

/// Returns the theory of red, green and blue; nothing where light of all wavelengths takes the same path.
std::vector<ChannelTheory> theory_by_colour(const Display&);

/// Returns {"r": {"wavelength_nm": ..., "index": {"lens": ...}}, ...}.
Json to_json(const std::vector<ChannelTheory>&);

}  // namespace lfdsim
