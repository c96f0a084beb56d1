#include "image/png_memory.h"

#include "image/encoder.h"

#include <fmt/format.h>
#include <png.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lfdsim {
namespace {

/// Means along one axis: `count` numbers from `from_count` of them, `stride` floats apart.
void mean_along(const float* from, std::size_t from_count, float* to, std::size_t count, std::size_t stride) {
    const double scale = double(from_count) / double(count);
    for (std::size_t k = 0; k < count; ++k) {
        const double begin = double(k) * scale, end = std::min(double(k + 1) * scale, double(from_count));
        double sum = 0;
        for (std::size_t i = std::size_t(begin); double(i) < end; ++i)
            sum += double(from[i * stride]) * (std::min(double(i + 1), end) - std::max(double(i), begin));
        to[k * stride] = float(sum / (end - begin));
    }
}

}  // namespace

std::vector<std::uint8_t> srgb_codes(const Image& image) {
    const Encoder8& encoder = Encoder8::of(Encoding::srgb);
    std::vector<std::uint8_t> codes(image.rgb.size());
    std::transform(image.rgb.begin(), image.rgb.end(), codes.begin(), [&](float light) { return encoder(light); });
    return codes;
}

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

Image reduced(const Image& image, int columns) {
    if (columns < 1 || columns >= image.width) return image;
    const int rows = std::max(1, int(std::lround(double(image.height) * columns / image.width)));
    Image narrow(columns, image.height), small(columns, rows);
    for (int r = 0; r < image.height; ++r)
        for (int c = 0; c < 3; ++c)
            mean_along(image.at(0, r) + c, std::size_t(image.width), narrow.at(0, r) + c, std::size_t(columns), 3);
    const std::size_t row = std::size_t(columns) * 3;
    for (std::size_t k = 0; k < row; ++k)
        mean_along(narrow.rgb.data() + k, std::size_t(image.height), small.rgb.data() + k, std::size_t(rows), row);
    return small;
}

}  // namespace lfdsim
