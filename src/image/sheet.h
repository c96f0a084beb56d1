// Pictures side by side, for the eye. Floor 0.
#pragma once
#include "image/image.h"

#include <span>
#include <string>

namespace lfdsim {

/// `columns` pictures in a row on dark grey, each under its label (cut to its width). Labels: as many as pictures, or none.
Image contact_sheet(std::span<const Image> pictures, std::span<const std::string> labels, int columns);

}  // namespace lfdsim
