// The text of a file before it is parsed. Floor 2.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace lfdsim {

inline constexpr std::size_t largest_text_bytes = std::size_t(1) << 20;

/// The whole text of a regular file that is not too large. Throws InputError with the file's name otherwise; `kind` says what it
/// should be.
std::string read_text(const std::filesystem::path&, std::string_view kind = "a display description",
                      std::size_t most_bytes = largest_text_bytes);

/// Refuses what the parser of descriptions must not be given: no text at all, NUL bytes, more than 1 MiB, tables and arrays nested
/// deeper than 16. Throws InputError with `name`, line and column.
void check_text(std::string_view text, std::string_view name);

}  // namespace lfdsim
