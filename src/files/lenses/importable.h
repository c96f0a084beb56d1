// What `lfdsim import` can read, told apart. Floor 2.
#pragma once
#include "files/calibration/calibration.h"
#include "files/lenses/drawn_lens.h"

#include <filesystem>
#include <variant>

namespace lfdsim {

/// A lens of Zemax (.zmx), Optiland (.json) or ray-optics (.roa), or the calibration of a lenticular display (.json). Throws
/// InputError with every problem and its place.
std::variant<DrawnLens, Calibration> read_importable(const std::filesystem::path&);

}  // namespace lfdsim
