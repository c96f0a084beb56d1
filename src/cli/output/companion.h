// Files that nobody named on the command line: those that a command writes beside the one that was named. Floor 5.
#pragma once
#include <filesystem>
#include <string>

namespace lfdsim::cli {

/// Checks a file that is written beside an output; to be called before long work. Throws InputError if the file cannot be
/// written, or if it exists, is not `own` (its replacement loses nothing), and is not to be replaced.
void check_companion(const std::filesystem::path&, bool own, bool replace);

/// Whether a text file has exactly this text.
bool holds(const std::filesystem::path&, const std::string& text);

}  // namespace lfdsim::cli
