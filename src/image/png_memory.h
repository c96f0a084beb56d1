// Small PNG files in memory, 8 bits a channel, sRGB. Floor 0.
#pragma once
#include "image/image.h"

#include <cstdint>
#include <string>
#include <vector>

namespace lfdsim {

/// 8-bit sRGB codes of linear light, 3 a pixel; clipped to [0, 1], NaN gives 0.
std::vector<std::uint8_t> srgb_codes(const Image&);

/// A PNG file of width x height pixels from `channels` codes each: 3 (R, G, B) or 4 (with an opacity). Throws std::invalid_argument
/// for other numbers of channels or codes or for a size below 1, std::runtime_error if libpng cannot.
std::string png_bytes(int width, int height, int channels, const std::vector<std::uint8_t>& codes);

/// The picture made smaller to `columns`, its height in proportion; each pixel is the mean light of its area. As it is if it has
/// no more columns.
Image reduced(const Image&, int columns);

}  // namespace lfdsim
