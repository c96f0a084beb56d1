// What `lfdsim import` can read, by the end of a file's name and, of JSON, by its content. Floor 2.
#pragma once
#include "files/calibration/calibration.h"
#include "files/lenses/drawn_lens.h"

#include <filesystem>
#include <variant>

namespace lfdsim {

/// Reads a lens of Zemax (.zmx), Optiland (.json) or ray-optics (.roa), or the calibration of a lenticular display (.json). Throws
/// InputError with every problem and its place; files have at most 1 MiB.
std::variant<DrawnLens, Calibration> read_importable(const std::filesystem::path&);

}  // namespace lfdsim
