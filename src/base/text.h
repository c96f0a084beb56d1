// Parts and letters of texts, whatever the locale. Floor 0.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Removes the first line of a text and returns it, without its LF.
std::string_view next_line(std::string_view& text);

/// Returns the parts between separators; empty ones are parts, too, so that there is always one.
std::vector<std::string_view> split(std::string_view text, char separator);

/// Returns a text without the blanks at its beginning and end.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");

/// Whether a text is one digit or more, and nothing else.
bool is_digits(std::string_view text);

/// Returns a letter, or a text, with a to z in place of A to Z.
constexpr char lower_case(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }
std::string lower_case(std::string text);

/// Whether two texts are equal apart from the case of letters A to Z.
bool same_without_case(std::string_view a, std::string_view b);

/// Whether a byte of UTF-8 begins a character; a degree sign, for example, has two bytes.
constexpr bool begins_character(char byte) { return (byte & 0xc0) != 0x80; }

struct Character {
    char32_t code;
    std::size_t bytes;  // 0: the bytes are not UTF-8
};
/// Returns the first character of a text that is not empty (RFC 3629: shortest forms, no surrogates, up to U+10FFFF); where there
/// is none, the first byte is its code.
Character first_character(std::string_view text);

/// Whether a text is well-formed UTF-8, as first_character() has it.
bool is_utf8(std::string_view text);

}  // namespace lfdsim
