// Warnings where a picture's metadata name another display or camera than the one that it is used for. Floor 5.
#pragma once
#include "display/display.h"
#include "image/formats/image_file.h"

#include <filesystem>

namespace lfdsim::cli {

/// The key of a panel image's metadata that names the test pattern that it shows.
inline constexpr const char* pattern_mark = "pattern";

/// Warns once if a panel image was made for a display on which its elemental images would differ, with each key that differs and
/// both values. There is no warning for pictures without a description of their display, or with one that cannot be read.
void warn_if_for_another(const std::filesystem::path& panel_image, const Metadata& about, const Display&);

/// Warns once if two pictures were taken by cameras with different positions, directions or frames, with each key that differs and
/// both values.
void warn_if_other_camera(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace lfdsim::cli
