// The panel image as the renderer reads it. Floor 0, public.
#pragma once
#include "display/display.h"
#include "image/image.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace lfdsim {

/// Linear radiance, 4 x float32 (R, G, B, 0) a pixel: one aligned 16-byte load fetches an exactly decoded panel pixel, whatever
/// the file's depth. Uses huge pages where the system grants them, since the renderer's access is random.
class Texels {
  public:
    Texels() = default;
    /// Zeroed. Throws std::bad_alloc. columns x rows < 2^31.
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

/// Copies an image as it is shown by a panel, which is driven by 8-bit codes: light rounded to them in the panel's encoding.
/// Bit for bit the result of writing the image to a PNG and reading that as a panel image.
Texels shown_texels(const Image&, Encoding);

}  // namespace lfdsim
