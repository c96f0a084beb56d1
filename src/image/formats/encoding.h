// Code values and linear light. Floor 0.
#pragma once
#include "display/display.h"
#include "image/image.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// Returns the light of a code by IEC 61966-2-1, both in [0, 1]; other codes are clipped.
double srgb_to_linear(double code);
/// Returns the code of light by IEC 61966-2-1, both in [0, 1]; other light is clipped.
double linear_to_srgb(double light);

/// Returns the light of each code from 0 to 2^bits - 1, rounded once to float32. `bits` is 8 or 16, or std::invalid_argument is
/// thrown.
const std::vector<float>& decode_table(Encoding, int bits);

/// Returns the nearest 8-bit codes, H x W x 3, as a panel or a PNG shows an image. The code of a code's light is that code.
std::vector<std::uint8_t> encode8(const Image&, Encoding);

}  // namespace lfdsim
