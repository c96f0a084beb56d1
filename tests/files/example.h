// A description to spoil, with line numbers that tests can count on.
#pragma once
#include <string>

namespace lfdsim {

inline const std::string example_text = R"(schema = 1
name = "example"
[panel]
pixels = [3840, 2160]
pixel_pitch_mm = 0.13636
[lens]
type = "plano_convex"
sphere_radius_mm = 7.28
aperture_radius_mm = 6
index = 1.4918
[array]
count = [43, 24]
pitch_mm = 12.0
gap_mm = 16.485
[camera]
position_mm = [0, 0, 2000]
)";

/// The example with the first `from` made `to`.
inline std::string with(const std::string& from, const std::string& to, std::string text = example_text) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace lfdsim
