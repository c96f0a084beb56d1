#include "image/formats/png_memory.h"

#include <fmt/format.h>
#include <png.h>
#include <stdexcept>

namespace lfdsim {
std::string png_bytes(int width, int height, int channels, const std::vector<std::uint8_t>& codes) {
    if (width < 1 || height < 1 || (channels != 3 && channels != 4) ||
        codes.size() != std::size_t(width) * std::size_t(height) * std::size_t(channels))
        throw std::invalid_argument("png_bytes: size, channels and codes do not fit");
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = png_uint_32(width);
    image.height = png_uint_32(height);
    image.format = channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, codes.data(), 0, nullptr))
        throw std::runtime_error(fmt::format("PNG: {}", image.message));
    bytes.resize(size);
    return bytes;
}

}  // namespace lfdsim
