#include "python/arrays.h"

#include "base/input_error.h"
#include "image/formats/encoding.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

namespace lfdsim::python {
namespace {

namespace nb = nanobind;

/// Copies pixels of three values to pixels of `stride` floats, by light(value), on all threads. Returns the number of the first
/// pixel with light that is not within `least` and the greatest float (NaN is not), or -1.
template <class Value, class Light>
std::int64_t copy(const Pixels<Value>& from, float* to, int stride, float least, const Light& light) {
    const auto rows = std::int64_t(from.shape(0)), columns = std::int64_t(from.shape(1));
    std::atomic<std::int64_t> bad{std::numeric_limits<std::int64_t>::max()};
    tbb::parallel_for(std::int64_t(0), rows, [&](std::int64_t row) {
        const Value* values = from.data() + row * columns * 3;
        float* out = to + row * columns * stride;
        for (std::int64_t column = 0; column < columns; ++column, values += 3, out += stride) {
            bool good = true;
            for (int c = 0; c < 3; ++c) {
                out[c] = light(values[c]);
                good = good && out[c] >= least && out[c] <= std::numeric_limits<float>::max();
            }
            if (good) continue;
            std::int64_t first = bad;  // keeps the minimum over the rows, which end in any order
            while (row * columns + column < first && !bad.compare_exchange_weak(first, row * columns + column)) {
            }
            return;
        }
    });
    return bad == std::numeric_limits<std::int64_t>::max() ? -1 : std::int64_t(bad);
}

/// Fills `to`, which has `stride` floats a pixel, with the array's light. Only floats are checked: codes become light in 0 .. 1.
/// Throws InputError as texels_of() if `panel`, else as image_of().
void fill(const AnyPixels& pixels, float* to, int stride, Encoding encoding, bool panel, const std::string& name) {
    const float least = panel ? 0 : std::numeric_limits<float>::lowest();
    if (const auto* light = std::get_if<Pixels<float>>(&pixels)) {
        const std::int64_t bad = copy(*light, to, stride, least, [](float value) { return value; });
        if (bad < 0) return;
        const std::int64_t columns = columns_of(pixels);
        for (int c = 0; c < 3; ++c)
            if (const float value = light->data()[bad * 3 + c]; !(value >= least && value <= std::numeric_limits<float>::max()))
                throw InputError(name, fmt::format("holds {} in channel {} at column {}, row {}; values must be finite{}",
                                                   std::isnan(value) ? std::abs(value) : value, "RGB"[c], bad % columns,
                                                   bad / columns, panel ? " and not negative" : ""));
    }
    const auto decode = [&](const auto& codes, int bits) {
        const std::vector<float>& light = decode_table(encoding, bits);
        copy(codes, to, stride, least, [&](auto code) { return light[code]; });
    };
    if (const auto* codes = std::get_if<Pixels<std::uint8_t>>(&pixels)) decode(*codes, 8);
    if (const auto* codes = std::get_if<Pixels<std::uint16_t>>(&pixels)) decode(*codes, 16);
}

Image filled(const AnyPixels& pixels, Encoding encoding, bool panel, const std::string& name) {
    Image image(int(columns_of(pixels)), int(rows_of(pixels)));
    fill(pixels, image.rgb.data(), 3, encoding, panel, name);
    return image;
}

}  // namespace

std::optional<Rect> rect_of(const std::optional<CropBox>& c) {
    if (!c) return {};
    return Rect{(*c)[0], (*c)[1], (*c)[2], (*c)[3]};
}

std::int64_t rows_of(const AnyPixels& pixels) {
    return std::visit([](const auto& p) { return std::int64_t(p.shape(0)); }, pixels);
}
std::int64_t columns_of(const AnyPixels& pixels) {
    return std::visit([](const auto& p) { return std::int64_t(p.shape(1)); }, pixels);
}

Texels texels_of(const AnyPixels& pixels, Encoding encoding, const std::string& name) {
    Texels texels(columns_of(pixels), rows_of(pixels));
    fill(pixels, texels.data(), 4, encoding, true, name);
    return texels;
}

Image panel_image_of(const AnyPixels& pixels, Encoding encoding, const std::string& name) {
    return filled(pixels, encoding, true, name);
}

Image image_of(const AnyPixels& pixels, Encoding encoding, const std::string& name) {
    return filled(pixels, encoding, false, name);
}

Pictured array_of(Image&& image) {
    auto kept = std::make_unique<Image>(std::move(image));
    float* const data = kept->rgb.data();
    const std::size_t rows = std::size_t(kept->height), columns = std::size_t(kept->width);
    const nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<Image*>(p); });
    kept.release();
    return Pictured(data, {rows, columns, 3}, owner);
}

Numbers array_of(const std::vector<double>& values) {
    auto kept = std::make_unique<std::vector<double>>(values);
    double* const data = kept->data();
    const nb::capsule owner(kept.get(), [](void* p) noexcept { delete static_cast<std::vector<double>*>(p); });
    kept.release();
    return Numbers(data, {values.size()}, owner);
}

}  // namespace lfdsim::python
