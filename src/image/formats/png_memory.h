// Small PNG files in memory, 8 bits a channel, sRGB. Floor 0.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns a PNG file of width x height pixels from `channels` codes each: 3 (R, G, B) or 4 (with an opacity). Throws
/// std::invalid_argument for another number of channels or codes or for a size below 1, std::runtime_error if libpng fails.
std::string png_bytes(int width, int height, int channels, const std::vector<std::uint8_t>& codes);

}  // namespace lfdsim
