// Pictures side by side on one sheet. Floor 0.
#pragma once
#include "image/image.h"

#include <span>
#include <string>

namespace lfdsim {

inline constexpr int sheet_margin = 12;                              // pixels
inline constexpr float sheet_background = 0.012f, sheet_ink = 0.6f;  // linear light: a dark grey, and a light one

/// Returns a sheet with `columns` pictures in a row on dark grey, each under its label: readable when the sheet is shown 480 pixels
/// wide, in at most four lines of the widest picture's width. Where a word is wider than a line all labels are smaller, and words
/// are cut where that is not enough. There are as many labels as pictures, or none.
Image contact_sheet(std::span<const Image> pictures, std::span<const std::string> labels, int columns);

/// Returns the number of pixels of that sheet.
double contact_sheet_pixels(std::span<const Image> pictures, std::span<const std::string> labels, int columns);

}  // namespace lfdsim
