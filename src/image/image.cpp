#include "image/image.h"

#include "image/formats/huge_pages.h"

namespace lfdsim {

Image::Image(int w, int h) : width(w), height(h) {
    const std::size_t values = std::size_t(w) * std::size_t(h) * 3;
    // Huge pages must be requested before the memory is touched, which resize() does.
    rgb.reserve(values);
    detail::want_huge_pages(rgb.data(), values * sizeof(float));
    rgb.resize(values);
}

}  // namespace lfdsim
