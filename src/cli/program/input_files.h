// The files that a command reads, so that it writes over none of them. Floor 5.
#pragma once
#include "image/image.h"

#include <filesystem>
#include <string>

namespace lfdsim::cli {

/// Remembers a file that the command reads, as `what` ("the description"). To be called before outputs are checked.
void remember_input(const std::string& what, const std::filesystem::path&);

/// Throws InputError that names both if `output` is one of those files, under whatever name: a hard or symbolic link is the same
/// file.
void refuse_input(const std::filesystem::path& output);

/// Warns of a picture whose light may be codes.
void warn_above_white(const std::string& path, const Image&);

}  // namespace lfdsim::cli
