// Code values and linear light. Floor 0.
#pragma once
#include "display/display.h"
#include "image/image.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// IEC 61966-2-1, both on [0, 1]; out of range values are clipped by encode.
double srgb_to_linear(double code);
double linear_to_srgb(double light);

/// The light of each code 0 .. 2^bits - 1 (bits 8 or 16), rounded once to float32.
const std::vector<float>& decode_table(Encoding, int bits);

/// The nearest 8-bit codes, H x W x 3, as a panel or a PNG shows an image. encode8(decode(code)) == code.
std::vector<std::uint8_t> encode8(const Image&, Encoding);

}  // namespace lfdsim
