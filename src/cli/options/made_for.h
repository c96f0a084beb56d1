// What a picture says that it was made for, against what it is used for. Floor 5.
#pragma once
#include "display/display.h"
#include "image/formats/image_file.h"

#include <filesystem>

namespace lfdsim::cli {

/// The key of a picture's metadata that names the test pattern that a panel image holds.
inline constexpr const char* pattern_mark = "pattern";

/// Warns once if a panel image was made for a display whose lenses would show it otherwise than these, with each key that differs
/// and both values. Pictures that do not say what they were made for, or say it in words that cannot be read, are taken as they
/// are.
void warn_if_for_another(const std::filesystem::path& panel_image, const Metadata& about, const Display&);

/// Warns once if two pictures were taken by cameras that stand or look otherwise, with each key that differs and both values.
void warn_if_other_camera(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lfdsim::cli
