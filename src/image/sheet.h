// Pictures side by side on one sheet. Floor 0.
#pragma once
#include "image/image.h"

#include <span>
#include <string>

namespace lfdsim {

inline constexpr int sheet_margin = 12;                              // pixels
inline constexpr float sheet_background = 0.012f, sheet_ink = 0.6f;  // linear light: a dark grey, and a light one

/// `columns` pictures in a row on dark grey, each under its label, readable when the sheet is shown 480 pixels wide, in lines of
/// the picture's width; a word wider than a line is written smaller, and cut where that is not enough. Labels: as many as pictures,
/// or none.
Image contact_sheet(std::span<const Image> pictures, std::span<const std::string> labels, int columns);

}  // namespace lfdsim
