// Quoting for a shell. Floor 2.
#pragma once
#include <string>
#include <string_view>

namespace lfdsim {

/// The word, in single quotes if it has characters that are special to a shell.
inline std::string shell_word(std::string_view word) {
    const bool plain = !word.empty() && word.find_first_not_of(
                                            "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                            "0123456789_-+=.,:/@%") == word.npos;
    if (plain) return std::string(word);
    std::string quoted = "'";
    for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

/// The same for a file, which must not be taken for an option.
inline std::string shell_file(const std::string& name) { return shell_word(name.starts_with('-') ? "./" + name : name); }

}  // namespace lfdsim
