// A panel with subpixels as one of finer whole pixels, which every renderer can show. Floor 2.
#pragma once
#include "display/display.h"
#include "geometry/subpixels.h"
#include "image/texels.h"

#include <string>
#include <vector>

namespace lfdsim {

/// A display with `times` x `times` pixels in place of each, without subpixels and black matrix. Its panel image is darker, so that
/// the brightest subpixels are not above 1.
struct FinePanel {
    Display display;
    int times = 1;
    double light = 1;                     // its panel's light over that of the display, in the mean
    std::vector<LitPart> parts;           // of the display's panel, on the borders of fine pixels
    std::vector<std::string> deviations;  // in words
};

/// Returns a panel with enough pixels to show all borders of subpixels, up to 12 along each axis; beyond that subpixels are
/// rounded. Throws InputError for a panel that would have too many.
FinePanel fine_panel(const Display&);

/// Returns the fine panel's image of the display's panel image `shown`. Throws std::bad_alloc.
Texels fine_image(const FinePanel&, const Texels& shown);

}  // namespace lfdsim
