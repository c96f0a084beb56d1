// Writes a text to a file, completely or not at all. Floor 5.
#pragma once
#include <filesystem>
#include <string>

namespace lfdsim::view {

/// Writes a text. Throws InputError if the file exists and may not be overwritten, std::runtime_error when writing fails; an
/// existing file then stays as it is.
void save_text(const std::filesystem::path&, const std::string& text, bool overwrite);

}  // namespace lfdsim::view
