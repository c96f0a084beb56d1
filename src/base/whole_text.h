// Numbers written in texts. Floor 0.
#pragma once
#include <charconv>
#include <optional>
#include <string_view>

namespace lfdsim {

/// Returns the number that the whole text is; nothing if it is none. Locales have no effect, and leading blanks, plus signs, and
/// hexadecimal and octal forms are not accepted.
template <class T>
std::optional<T> whole_text(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

}  // namespace lfdsim
