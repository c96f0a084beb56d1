// A text into a file, whole or not at all. Floor 5.
#pragma once
#include <filesystem>
#include <string>

namespace lfdsim::view {

/// Throws InputError if there is such a file and it may not be overwritten, std::runtime_error when writing fails; what was there
/// then stays.
void save_text(const std::filesystem::path&, const std::string& text, bool overwrite);

}  // namespace lfdsim::view
