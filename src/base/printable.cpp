#include "base/printable.h"

#include "base/text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cstdint>

namespace lfdsim {
namespace {

constexpr std::size_t longest_message = 900, kept_head = 500, kept_tail = 300;  // bytes; a longer message keeps its head and tail

/// A range of Unicode code points, both ends included.
struct CodeRange {
    char32_t first, last;
};

// Characters that are escaped: Unicode's categories Cc (controls), Cf (formats: directions, joiners, tags) and Zl, Zp
// (separators), and letters that are blank or have no width (fillers, selectors).
constexpr CodeRange unseen[] = {{0x0000, 0x001f},   {0x007f, 0x009f},   {0x00ad, 0x00ad},   {0x034f, 0x034f},   {0x0600, 0x0605},
                                {0x061c, 0x061c},   {0x06dd, 0x06dd},   {0x070f, 0x070f},   {0x0890, 0x0891},   {0x08e2, 0x08e2},
                                {0x115f, 0x1160},   {0x17b4, 0x17b5},   {0x180b, 0x180f},   {0x200b, 0x200f},   {0x2028, 0x202e},
                                {0x2060, 0x206f},   {0x3164, 0x3164},   {0xfe00, 0xfe0f},   {0xfeff, 0xfeff},   {0xffa0, 0xffa0},
                                {0xfff0, 0xfffb},   {0xfffe, 0xffff},   {0x110bd, 0x110bd}, {0x110cd, 0x110cd}, {0x13430, 0x1343f},
                                {0x1bca0, 0x1bca3}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};

bool is_unseen(char32_t c) {
    if (c >= 0x20 && c < 0x7f) return false;
    return std::any_of(std::begin(unseen), std::end(unseen), [&](const CodeRange& r) { return r.first <= c && c <= r.last; });
}

/// Returns \u and four digits, of a code above U+FFFF those of its two UTF-16 surrogates.
std::string escape(char32_t c) {
    if (c < 0x10000) return fmt::format("\\u{:04x}", std::uint32_t(c));
    return fmt::format("\\u{:04x}\\u{:04x}", 0xd800 + (std::uint32_t(c - 0x10000) >> 10), 0xdc00 + (std::uint32_t(c) & 0x3ff));
}

/// Escapes all characters in `unseen` except those in `allowed`, and all bytes that are not UTF-8.
std::string harmless(std::string_view text, std::string_view allowed) {
    std::string all;
    all.reserve(text.size());
    while (!text.empty()) {
        const auto [code, bytes] = first_character(text);
        if (bytes == 0)
            all += fmt::format("\\x{:02x}", std::uint32_t(code));
        else if (is_unseen(code) && (bytes > 1 || allowed.find(text[0]) == allowed.npos))
            all += escape(code);
        else
            all += text.substr(0, bytes);
        text.remove_prefix(std::max<std::size_t>(bytes, 1));
    }
    return all;
}

/// Returns the position of the start of the character that contains byte `at`.
std::size_t boundary(std::string_view text, std::size_t at) {
    while (at > 0 && !begins_character(text[at])) --at;
    return at;
}

}  // namespace

std::string printable(std::string_view text) { return harmless(text, {}); }

std::string printable_lines(std::string_view text) { return harmless(text, "\n\t"); }

bool is_printable(std::string_view text) { return printable(text) == text; }

std::string shortened(std::string_view word) {
    constexpr std::size_t longest = 40;
    if (word.size() <= longest) return printable(word);
    return printable(word.substr(0, boundary(word, longest))) + "...";
}

std::string bounded(std::string_view message) {
    if (message.size() <= longest_message) return std::string(message);
    const std::size_t head = boundary(message, kept_head), tail = boundary(message, message.size() - kept_tail);
    return fmt::format("{} [... {} bytes ...] {}", message.substr(0, head), tail - head, message.substr(tail));
}

}  // namespace lfdsim
