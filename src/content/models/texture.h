// Textures, filtered over the width of a ray. Floor 2, internal to content.
#pragma once
#include "content/models/model.h"

#include <cstdint>
#include <vector>

namespace lfdsim {

/// Linear light in one register: red, green, blue, and 0, or of textures with alpha that; red, green and blue are then times alpha.
typedef float Texel __attribute__((vector_size(16)));

/// A mip pyramid: each level halves the one below by averaging 2 x 2 texels in linear light.
class MipMap {
  public:
    /// Opaque, unless its alpha is wanted.
    MipMap(const Texture&, bool with_alpha);

    /// Trilinear: bilinear in the two levels nearest to `level` (0: full size; larger is clamped), blended.
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
    std::vector<float> sizes_;  // width and height of each level
    const float* light_;        // of each code
};

}  // namespace lfdsim
