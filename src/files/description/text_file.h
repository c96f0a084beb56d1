// The text of a file before it is parsed. Floor 2.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace lfdsim {

inline constexpr std::size_t largest_text_bytes = std::size_t(1) << 20;  // 1 MiB

/// Returns the bytes of a regular file. Throws InputError with the file's name if it cannot be read or has more than `most_bytes`;
/// `kind` says in the message what the file should be ("a camera path").
std::string read_text(const std::filesystem::path&, std::string_view kind = "a display description",
                      std::size_t most_bytes = largest_text_bytes);

/// Refuses what the TOML parser must not be given: no text at all, NUL bytes, more than 1 MiB, tables, arrays and dotted keys
/// nested more than 16 levels deep. Throws InputError with `name`, of nesting with line and column.
void check_text(std::string_view text, std::string_view name);

}  // namespace lfdsim
