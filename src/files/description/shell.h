// Quoting of words for a shell, for commands that messages and pages show. Floor 2.
#pragma once
#include "base/printable.h"

#include <string>
#include <string_view>

namespace lfdsim {

/// Returns the word, in quotes if it has characters that are special to a POSIX shell.
inline std::string shell_word(std::string_view word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=.,:/@%") == word.npos;
    if (plain) return std::string(word);
    if (!is_printable(word)) {  // $'...' of bash and zsh: without control characters, which a terminal would obey
        constexpr char digits[] = "0123456789abcdef";
        std::string escaped = "$'";
        for (const unsigned char c : word) {
            if (c < 0x20 || c > 0x7e)
                escaped += {'\\', 'x', digits[c >> 4], digits[c & 15]};
            else
                escaped += c == '\'' || c == '\\' ? std::string("\\") + char(c) : std::string(1, char(c));
        }
        return escaped + "'";
    }
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// Returns shell_word() of a file's name, which must not be taken for an option.
inline std::string shell_file(const std::string& name) { return shell_word(name.starts_with('-') ? "./" + name : name); }

}  // namespace lfdsim
