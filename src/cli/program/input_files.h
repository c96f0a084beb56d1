// The files that a command reads, which it must not overwrite. Floor 5.
#pragma once
#include "display/display.h"
#include "image/image.h"

#include <filesystem>
#include <string>

namespace lfdsim::cli {

/// Remembers a file that the command reads, as `what` ("the description"). It must be called before outputs are checked.
void remember_input(const std::string& what, const std::filesystem::path&);

/// Throws InputError that names both if `output` is one of the remembered files, under whatever name: a hard or symbolic link is
/// the same file.
void refuse_input(const std::filesystem::path& output);

/// Warns about a picture whose light may be codes (image/compare/above_white.h).
void warn_above_white(const std::string& path, const Image&);

/// Warns about a file that states colours other than sRGB (image/formats/image_file.h); returns whether it does.
bool warn_of_colours(const std::string& path, Encoding);

}  // namespace lfdsim::cli
