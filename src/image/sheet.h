// Pictures side by side, for the eye. Floor 0.
#pragma once
#include "image/image.h"

#include <span>
#include <string>

namespace lfdsim {

/// `columns` pictures in a row on dark grey, each under its label, which is read where the sheet is shown 480 pixels wide, in lines
/// of the picture's width; what is wider than a line and cannot be broken is written smaller, and cut where that is not enough.
/// Labels: as many as pictures, or none.
Image contact_sheet(std::span<const Image> pictures, std::span<const std::string> labels, int columns);

}  // namespace lfdsim
