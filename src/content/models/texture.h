// Textures, filtered over the width of a ray. Floor 2, internal to content.
#pragma once
#include "content/models/model.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// Linear light in one register: red, green, blue and 0; of textures with alpha red, green and blue times alpha, and alpha.
typedef float Texel __attribute__((vector_size(16)));

/// A mip pyramid: each level halves the one below by the mean over a texel's area in linear light. Of the texture itself it keeps
/// the codes. Means have 16 bits: the mean of two neighbouring codes is half-way between them, and would always be rounded up to
/// the next code; floats would take twice the memory.
class MipMap {
  public:
    /// Without alpha the texture is opaque.
    MipMap(const Texture&, bool with_alpha);

    /// Returns the light at (u, v), trilinear: bilinear in the two levels nearest to `level` (0: full size; larger ones are
    /// clamped), blended. `level` is the base 2 logarithm of the filter's width in texels.
    Texel sample(float u, float v, float level, Wrap wrap_u, Wrap wrap_v) const;

    double bytes() const;

  private:
    typedef std::uint16_t Mean __attribute__((vector_size(8)));  // a Texel times 65535
    struct Level {
        int width, height;
        std::vector<Mean> means;  // of level 0 none
    };
    Level halved(std::size_t level) const;
    Texel texel(std::size_t level, std::size_t i) const;
    Texel bilinear(std::size_t level, int x0, int y0, int x1, int y1, float right, float down) const;

    bool with_alpha_;
    std::vector<std::uint32_t> codes_;  // of level 0, sRGB and alpha: 0xaabbggrr
    std::vector<Level> levels_;
    std::vector<float> sizes_;  // width and height of each level, and 1, 1
    const float* light_;        // linear light of each code
};

}  // namespace lfdsim
