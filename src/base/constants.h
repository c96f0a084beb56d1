// Numbers that every floor uses. Floor 0.
#pragma once
#include <limits>
#include <numbers>

namespace lfdsim {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180;  // in radians: angle_deg * degree; radians / degree are degrees
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace lfdsim
