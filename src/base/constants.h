// Numbers that every floor uses. Floor 0.
#pragma once
#include <limits>
#include <numbers>

namespace lfdsim {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180;  // in radians: angle_deg * degree; radians / degree are degrees
inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

inline constexpr const char* colour_of_channel[] = {"red", "green", "blue"};

// The viewer who is meant where nothing else is given
inline constexpr double usual_eye_separation_mm = 65;
inline constexpr double usual_pupil_mm = 4;      // diameter, in a dim room
inline constexpr double nearest_sight_mm = 250;  // the least distance at which an eye sees sharply

}  // namespace lfdsim
