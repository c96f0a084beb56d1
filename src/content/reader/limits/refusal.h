// Assimp's messages in plain terms.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <filesystem>
#include <optional>
#include <string>

namespace lfdsim::reader {

/// Returns why a file is refused, from Assimp's message.
std::string refusal(const std::string& says, const std::filesystem::path& file, const NotShown&);

/// Returns why a file without triangles is refused, with what it has in their place.
std::string no_triangles(const NotShown&);

/// Returns what a warning of Assimp's means for the picture; nothing if another warning says it, or it means nothing.
std::optional<std::string> plain_warning(const std::string& says);

}  // namespace lfdsim::reader
