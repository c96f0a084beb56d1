// The panel image as the renderer reads it. Floor 0, public.
#pragma once
#include "display/display.h"
#include "image/image.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace lfdsim {

/// Linear radiance of a panel, 4 x float32 (R, G, B, 0) a pixel, row 0 at the top: one aligned 16-byte load fetches an exactly
/// decoded panel pixel, whatever the file's depth. It uses huge pages where the system grants them, since the renderer's access is
/// random.
class Texels {
  public:
    Texels() = default;
    /// Makes a black panel. Throws std::bad_alloc where memory does not suffice, or for sizes below 1 or columns x rows >= 2^31.
    Texels(std::int64_t columns, std::int64_t rows);

    std::int64_t columns() const { return columns_; }
    std::int64_t rows() const { return rows_; }
    float* data() { return data_.get(); }
    const float* data() const { return data_.get(); }
    float* row(std::int64_t r) { return data_.get() + r * columns_ * 4; }

  private:
    struct Unmap {
        std::size_t bytes;
        void operator()(float*) const;
    };
    std::int64_t columns_ = 0, rows_ = 0;
    std::unique_ptr<float[], Unmap> data_;
};

/// Copies an image.
Texels make_texels(const Image&);

/// Copies an image as a panel shows it, which is driven by 8-bit codes: light is clipped to [0, 1] and rounded to codes in the
/// panel's encoding. The result has the same bits as the image written to a PNG and read as a panel image.
Texels shown_texels(const Image&, Encoding);

}  // namespace lfdsim
