// Colours that files state: whether they are those of sRGB (IEC 61966-2-1).
#include "image/formats/formats.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lfdsim::detail {
namespace {

/// The bytes of an ICC profile (ICC.1:2022), big-endian. What lies beyond the end reads as 0.
class Profile {
  public:
    explicit Profile(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

    std::uint32_t u8(std::size_t at) const { return at < bytes_.size() ? bytes_[at] : 0; }
    std::uint32_t u16(std::size_t at) const { return u8(at) << 8 | u8(at + 1); }
    std::uint32_t u32(std::size_t at) const { return u16(at) << 16 | u16(at + 2); }
    double fixed(std::size_t at) const { return double(std::int32_t(u32(at))) / 65536; }
    bool says(std::size_t at, const char* word) const { return at + 4 <= bytes_.size() && std::memcmp(&bytes_[at], word, 4) == 0; }

    /// Returns where the data of a tag begin; 0 where there is none.
    std::size_t tag(const char* name) const {
        const std::size_t count = std::min<std::size_t>(u32(128), 100);
        for (std::size_t i = 0; i < count; ++i)
            if (const std::size_t entry = 132 + 12 * i; says(entry, name)) return u32(entry + 4);
        return 0;
    }

    /// Returns the profile's name in ASCII, of at most 60 characters.
    std::string name() const {
        const std::size_t at = tag("desc");
        const bool unicode = says(at, "mluc");  // UTF-16 of several languages: the first
        const std::size_t text = at + (unicode ? u32(at + 24) : 12), length = unicode ? u32(at + 20) / 2 : u32(at + 8);
        std::string name;
        for (std::size_t i = 0; i < std::min<std::size_t>(length, 60); ++i) {
            const std::uint32_t c = unicode ? u16(text + 2 * i) : u8(text + i);
            if (c == 0) break;
            name += c >= 0x20 && c < 0x7f ? char(c) : '?';
        }
        return name;
    }

    /// Returns the light of half the greatest code value by the curve of a tag (10.6, "curveType"; 10.18, "parametricCurveType");
    /// NaN for other curves.
    double mid_gray(const char* curve) const {
        const std::size_t at = tag(curve);
        if (says(at, "curv")) {
            const std::size_t count = u32(at + 8), middle = (count - 1) / 2;
            if (count == 0) return 0.5;
            if (count == 1) return std::pow(0.5, u16(at + 12) / 256.0);
            const std::size_t first = at + 12 + 2 * middle;
            return (count % 2 == 1 ? u16(first) : 0.5 * (u16(first) + u16(first + 2))) / 65535.0;
        }
        if (!says(at, "para")) return std::nan("");
        // Above its linear part the curve is Y = (a X + b)^g + o, with a = 1, b = 0 in type 0, and o only in types 2 and 4.
        const auto parameter = [&](std::size_t i) { return fixed(at + 12 + 4 * i); };
        const std::uint32_t type = u16(at + 8);
        const double base = type == 0 ? 0.5 : 0.5 * parameter(1) + parameter(2);
        return std::pow(base, parameter(0)) + (type == 2 ? parameter(3) : type == 4 ? parameter(5) : 0);
    }

  private:
    std::span<const std::uint8_t> bytes_;
};

}  // namespace

StatedColours colours_of_profile(std::span<const std::uint8_t> bytes) {
    // The primaries of sRGB, X, Y, Z relative to D50, as profiles state them.
    constexpr std::array<std::array<double, 3>, 3> srgb{
        {{0.4361, 0.2225, 0.0139}, {0.3851, 0.7169, 0.0971}, {0.1431, 0.0606, 0.7142}}};
    const Profile profile(bytes);
    StatedColours stated{fmt::format("the ICC profile \"{}\"", profile.name())};
    const bool gray = profile.says(16, "GRAY");
    stated.mid_gray = profile.mid_gray(gray ? "kTRC" : "rTRC");
    for (std::size_t c = 0; c < 3 && !gray; ++c) {
        const std::size_t at = profile.tag(std::array{"rXYZ", "gXYZ", "bXYZ"}[c]);
        for (std::size_t k = 0; k < 3; ++k)
            if (at == 0 || std::abs(profile.fixed(at + 8 + 4 * k) - srgb[c][k]) > 0.01) stated.srgb_primaries = false;
    }
    return stated;
}

bool are_srgb_primaries(const std::array<double, 8>& xy) {
    constexpr std::array<double, 8> srgb{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
    for (std::size_t i = 0; i < 8; ++i)
        if (!(std::abs(xy[i] - srgb[i]) <= 0.01)) return false;
    return true;
}

std::string not_srgb(const StatedColours& stated, Encoding encoding) {
    const bool curve = encoding == Encoding::srgb && !(std::abs(stated.mid_gray - srgb_mid_gray) <= 0.01);
    if (stated.srgb_primaries && !curve) return "";
    return fmt::format("states {}: {} of sRGB; its colours are read as sRGB all the same: convert it to sRGB before", stated.name,
                       stated.srgb_primaries ? "its curve is not that"
                       : curve               ? "neither its primaries nor its curve are those"
                                             : "its primaries are not those");
}

}  // namespace lfdsim::detail
