// Light to the nearest code: 8 bits exactly and fast, 16 bits exactly. Internal to src/image. Floor 0.
#pragma once
#include "display/display.h"

#include <array>
#include <bit>
#include <cstdint>

namespace lfdsim {

/// Returns the nearest 16-bit code; clips like Encoder8.
std::uint16_t encode16(float light, Encoding);

/// A table that encodes light as the nearest 8-bit code: equal to round(255 encode(x)) in double precision for every float x,
/// clipped to [0, 1], 0 for NaN. The leading bits of x select a bucket that contains at most one step between codes; a comparison
/// with that step decides.
class Encoder8 {
  public:
    static const Encoder8& of(Encoding);

    std::uint8_t operator()(float light) const {
        const float x = light > least ? (light < 1.0f ? light : 1.0f) : least;
        const unsigned code = guess_[(std::bit_cast<std::uint32_t>(x) - base) >> shift];
        return static_cast<std::uint8_t>(code + unsigned(x >= step_[code + 1]));
    }

  private:
    explicit Encoder8(Encoding);

    // Steps are 0.4 % of the light apart at the densest (linear, near 1; sRGB 1.2 % near 0.5), buckets 2^-7 of their octave wide;
    // the first step is above 2^-13 (sRGB: 0.5/255/12.92 = 2^-12.7).
    static constexpr float least = 0x1p-13f;
    static constexpr std::uint32_t base = std::bit_cast<std::uint32_t>(least);
    static constexpr int shift = 16;
    static constexpr std::size_t buckets = ((std::bit_cast<std::uint32_t>(1.0f) - base) >> shift) + 1;

    std::array<std::uint8_t, buckets> guess_;  // code of the least value in the bucket
    std::array<float, 257> step_;              // [k]: the least light of code k; [256]: infinity
};

}  // namespace lfdsim
