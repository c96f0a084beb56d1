// Assimp's words in plain ones.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace lfdsim::reader {

/// Why a file is refused, for what Assimp says of it.
std::string refusal(const std::string& says, const std::filesystem::path& file);

/// What a warning of Assimp's means for the picture; nothing where another warning has said it.
std::optional<std::string> plain_warning(const std::string& says);

}  // namespace lfdsim::reader
