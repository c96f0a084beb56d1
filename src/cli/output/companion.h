// Files that the command line does not name: those that a command writes beside a named one. Floor 5.
#pragma once
#include <filesystem>
#include <string>

namespace lfdsim::cli {

/// Checks, before long work, a file that is written beside an output. Throws InputError if the file cannot be written, or if it
/// exists and may not be overwritten: it is not `own`, that of an earlier run, and `replace` is false.
void check_companion(const std::filesystem::path&, bool own, bool replace);

/// Whether a text file has exactly this text.
bool holds(const std::filesystem::path&, const std::string& text);

}  // namespace lfdsim::cli
