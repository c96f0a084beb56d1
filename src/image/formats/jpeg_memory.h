// Small JPEG files, quickly made in memory, for pictures that are viewed once. Floor 0.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns a baseline JPEG of width x height pixels from three sRGB codes each, colour at half resolution (4:2:0). `quality` is 1
/// to 100, as of libjpeg. The bytes are the same on any number of threads. Throws std::invalid_argument for another number of
/// codes, or a size that a JPEG cannot have, std::runtime_error if libjpeg fails.
std::string jpeg_bytes(int width, int height, const std::vector<std::uint8_t>& codes, int quality);

}  // namespace lfdsim
