// Bytes as text, for data: URLs. Floor 4.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace lfdsim {

/// Returns bytes in base 64 by RFC 4648, section 4.
inline std::string base64(std::string_view bytes) {
    constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t k = 0; k < bytes.size(); k += 3) {
        std::uint32_t three = 0;
        for (std::size_t i = 0; i < 3; ++i) three = three << 8 | (k + i < bytes.size() ? std::uint8_t(bytes[k + i]) : 0u);
        for (std::size_t i = 0; i < 4; ++i) text += k + i <= bytes.size() ? digits[three >> (18 - 6 * i) & 63] : '=';
    }
    return text;
}

}  // namespace lfdsim
