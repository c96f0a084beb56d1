#include "image/compare/above_white.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr float rounding = 1e-3f;                          // by which light may exceed 1 because of the arithmetic that made it
constexpr float half_a_code = 0.5f * 2.4f / 1.055f / 255;  // in light at white, where the slope of sRGB is 1.055/2.4
constexpr double least_lost = 1e-3;                        // share of the light for a warning
constexpr float most_of_picture = 16;                      // white light of one of four stripes with an aperture ratio of 1/4

}  // namespace

std::string above_white(const float* light, std::int64_t pixels, int stride, LightOf of) {
    float greatest = 0;
    for (std::int64_t i = 0; i < pixels; ++i, light += stride) greatest = std::max({greatest, light[0], light[1], light[2]});
    if (!(greatest > 1 + rounding)) return {};
    light -= pixels * stride;
    bool whole = true;
    for (std::int64_t i = 0; i < pixels && whole; ++i, light += stride)
        for (int c = 0; c < 3; ++c) whole = whole && light[c] == std::floor(light[c]);
    const bool codes = whole || greatest > most_of_picture;
    if (of == LightOf::picture && !codes) return {};
    const std::string bits = greatest > 255 ? "16" : "8";
    return fmt::format(
        "holds light of up to {:.6g}, and white is 1{}{}", greatest,
        of == LightOf::panel ? fmt::format(": it is shown {:.4g} times as bright as the panel's white", greatest) : "",
        codes ? fmt::format("; if these are codes of {} bits, save them as such (.png, or .npy of uint{}) and they are decoded",
                            bits, bits)
              : "; divide it by its greatest value, or give codes");
}

void CutOff::add(const Image& image) {
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
        const float* const rgb = &image.rgb[i];
        const float most = std::max({rgb[0], rgb[1], rgb[2]});
        greatest = std::max(greatest, most);
        cut += most > 1 + half_a_code;
        for (int c = 0; c < 3; ++c) {
            light += double(rgb[c]);
            lost += double(std::max(rgb[c] - 1, 0.f));
        }
    }
    pixels += std::int64_t(image.rgb.size() / 3);
}

CutOff& CutOff::operator+=(const CutOff& other) {
    pixels += other.pixels;
    cut += other.cut;
    greatest = std::max(greatest, other.greatest);
    light += other.light;
    lost += other.lost;
    return *this;
}

std::string CutOff::text() const {
    if (cut == 0 || light_share() < least_lost) return {};
    return fmt::format(
        "{:.3g} % of the pixels are brighter than white, the brightest {:.3g} times, and are cut off to white: {:.2g} % "
        "of the light is lost",
        100 * pixels_share(), greatest, 100 * light_share());
}

}  // namespace lfdsim
