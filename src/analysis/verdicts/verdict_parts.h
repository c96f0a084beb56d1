// The parts of verdicts(). Floor 3, internal to it.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <fmt/format.h>
#include <cmath>
#include <optional>
#include <string>

namespace lfdsim {

/// Returns a number as text: three digits, without an exponent.
inline std::string digits(double x) { return std::abs(x) < 1000 ? fmt::format("{:.3g}", x) : fmt::format("{:.0f}", x); }

inline bool is_valid(const Display& d) { return validate(d).empty(); }

/// Judges whether it is clear to which lens each pixel belongs.
std::optional<std::string> on_borders(const Display&, const Geometry&);
/// Judges whether a white screen is white.
std::optional<std::string> on_colours(const Display&, const Geometry&, const Theory&);

}  // namespace lfdsim
