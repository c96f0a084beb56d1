// Pictures of another size. Floor 0.
#pragma once
#include "image/image.h"

namespace lfdsim {

/// The mean light over each new pixel's area, so that fine lens dots keep their brightness. Sizes 1 or more.
Image scaled(const Image&, int width, int height);

/// The picture made smaller to `columns`, its height in proportion. As it is if it has no more columns.
Image reduced(const Image&, int columns);

}  // namespace lfdsim
