#include "image/formats/encoding.h"

#include "image/formats/encoder.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace lfdsim {
namespace {

// Returns the code of light, both in [0, 1]; clips.
double encode(Encoding encoding, double light) {
    return encoding == Encoding::srgb ? linear_to_srgb(light) : std::clamp(light, 0.0, 1.0);
}

std::vector<float> make_table(Encoding encoding, int bits) {
    std::vector<float> table(std::size_t(1) << bits);
    const double top = double(table.size() - 1);
    for (std::size_t code = 0; code < table.size(); ++code)
        table[code] = float(encoding == Encoding::srgb ? srgb_to_linear(double(code) / top) : double(code) / top);
    return table;
}

}  // namespace

// The curves are those of IEC 61966-2-1:1999, section 5.2.
double srgb_to_linear(double code) {
    code = std::clamp(code, 0.0, 1.0);
    return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double light) {
    light = std::clamp(light, 0.0, 1.0);
    return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
}

const std::vector<float>& decode_table(Encoding encoding, int bits) {
    static const std::vector<float> srgb8 = make_table(Encoding::srgb, 8), linear8 = make_table(Encoding::linear, 8);
    if (bits == 8) return encoding == Encoding::srgb ? srgb8 : linear8;
    if (bits != 16) throw std::invalid_argument("decode_table: bits must be 8 or 16");
    static const std::vector<float> srgb16 = make_table(Encoding::srgb, 16), linear16 = make_table(Encoding::linear, 16);
    return encoding == Encoding::srgb ? srgb16 : linear16;
}

Encoder8::Encoder8(Encoding encoding) {
    const auto code_of = [&](float x) { return std::floor(255 * encode(encoding, x) + 0.5); };
    constexpr float infinity = std::numeric_limits<float>::infinity();
    step_[0] = 0;
    step_[256] = infinity;
    for (int k = 1; k < 256; ++k) {
        const double middle = (k - 0.5) / 255;
        float x = float(encoding == Encoding::srgb ? srgb_to_linear(middle) : middle);
        // The closed form is accurate to a few units in the last place: step to the least float that rounds to k.
        while (code_of(x) < k) x = std::nextafter(x, infinity);
        while (code_of(std::nextafter(x, 0.0f)) >= k) x = std::nextafter(x, 0.0f);
        step_[std::size_t(k)] = x;
    }
    // The code at the beginning of each bucket.
    for (std::size_t i = 0; i < buckets; ++i)
        guess_[i] = std::uint8_t(code_of(std::bit_cast<float>(base + (std::uint32_t(i) << shift))));
}

const Encoder8& Encoder8::of(Encoding encoding) {
    static const Encoder8 srgb(Encoding::srgb), linear(Encoding::linear);
    return encoding == Encoding::srgb ? srgb : linear;
}

std::uint16_t encode16(float light, Encoding encoding) {
    return std::uint16_t(std::floor(65535 * encode(encoding, std::isnan(light) ? 0 : light) + 0.5));
}

std::vector<std::uint8_t> encode8(const Image& image, Encoding encoding) {
    const Encoder8& encoder = Encoder8::of(encoding);
    std::vector<std::uint8_t> codes(image.rgb.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, codes.size(), 65536), [&](const auto& range) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) codes[i] = encoder(image.rgb[i]);
    });
    return codes;
}

}  // namespace lfdsim
