// Lengths and depths in words, for messages. Floor 0.
#pragma once
#include <fmt/format.h>
#include <cmath>
#include <string>

namespace lfdsim {

/// Returns a length as text: four digits, or whole mm from 10 m on, without an exponent.
inline std::string length_in_words(double mm) { return std::abs(mm) < 1e4 ? fmt::format("{:.4g}", mm) : fmt::format("{:.0f}", mm); }

/// Returns a depth, mm from the vertex plane towards the viewer, as "12.5 mm in front of the lenses" or "12.5 mm behind the
/// lenses".
inline std::string depth_in_words(double mm) {
    return fmt::format("{} mm {} the lenses", length_in_words(std::abs(mm)), mm < 0 ? "behind" : "in front of");
}

}  // namespace lfdsim
