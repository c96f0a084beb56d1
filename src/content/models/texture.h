// Textures, filtered over the width of a ray. Floor 2, internal to content.
#pragma once
#include "content/models/model.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// Linear light in one register: red, green, blue and 0; of textures with alpha red, green and blue times alpha, and alpha.
typedef float Texel __attribute__((vector_size(16)));

/// A mip pyramid: each level halves the one below by averaging 2 x 2 texels in linear light.
class MipMap {
  public:
    /// Without alpha the texture is opaque.
    MipMap(const Texture&, bool with_alpha);

    /// Returns the light at (u, v), trilinear: bilinear in the two levels nearest to `level` (0: full size; larger ones are
    /// clamped), blended. `level` is the base 2 logarithm of the filter's width in texels.
    Texel sample(float u, float v, float level, Wrap wrap_u, Wrap wrap_v) const;

    int width() const { return levels_[0].width; }
    int height() const { return levels_[0].height; }
    double bytes() const;

  private:
    struct Level {
        int width, height;
        std::vector<std::uint32_t> codes;  // sRGB and alpha: 0xaabbggrr
    };
    Texel bilinear(const Level&, int x0, int y0, int x1, int y1, float right, float down) const;

    bool with_alpha_;
    std::vector<Level> levels_;
    std::vector<float> sizes_;  // width and height of each level, and 1, 1
    const float* light_;        // linear light of each code
};

}  // namespace lfdsim
