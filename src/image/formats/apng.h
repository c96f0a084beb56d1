// Animated PNG: the format's extension of the PNG specification, third edition, "APNG". Floor 0.
#pragma once
#include "image/image.h"

#include <filesystem>
#include <span>

namespace lfdsim {

/// Writes the frames as an animation that repeats without end, 8 bits, sRGB; programs that do not support animations show the first
/// frame. `seconds_per_frame` is 0.001 to 65.5, rounded to milliseconds. The file is written under a temporary name and renamed.
/// Throws std::invalid_argument if there are no frames, if their sizes differ or the time is out of range; InputError or
/// std::runtime_error like write_image().
void write_animation(const std::filesystem::path&, std::span<const Image> frames, double seconds_per_frame);

}  // namespace lfdsim
