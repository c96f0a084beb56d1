// Pictures of another size. Floor 0.
#pragma once
#include "image/image.h"

namespace lfdsim {

/// Returns the picture in another size, 1 or more, larger or smaller: each new pixel is the mean light over its area, so that fine
/// lens dots keep their brightness.
Image scaled(const Image&, int width, int height);

/// Returns the picture reduced to `columns`, its height in proportion; unchanged if it has no more columns, or `columns` is
/// below 1.
Image reduced(const Image&, int columns);

}  // namespace lfdsim
