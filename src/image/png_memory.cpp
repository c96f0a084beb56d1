#include "image/png_memory.h"

#include "image/encoder.h"

#include <fmt/format.h>
#include <png.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lfdsim {
namespace {

/// The numbers 0 .. from - 1 that the k-th of `to` even parts of them covers: add(number, its share of the part).
template <class Add>
void each_covered(int k, int from, int to, Add add) {
    const double scale = double(from) / to, begin = k * scale, end = std::min((k + 1) * scale, double(from));
    for (int i = int(begin); i < end; ++i) add(i, (std::min(i + 1., end) - std::max(double(i), begin)) / (end - begin));
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
    tbb::parallel_for(0, image.height, [&](int y) {
        for (int x = 0; x < columns; ++x) {
            double sum[3] = {};
            each_covered(x, image.width, columns, [&](int i, double share) {
                for (int c = 0; c < 3; ++c) sum[c] += share * image.at(i, y)[c];
            });
            for (int c = 0; c < 3; ++c) narrow.at(x, y)[c] = float(sum[c]);
        }
    });
    tbb::parallel_for(0, rows, [&](int y) {
        std::vector<double> sum(std::size_t(columns) * 3);
        each_covered(y, image.height, rows, [&](int i, double share) {
            const float* row = narrow.at(0, i);
            for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += share * row[k];
        });
        std::copy(sum.begin(), sum.end(), small.at(0, y));
    });
    return small;
}

}  // namespace lfdsim
