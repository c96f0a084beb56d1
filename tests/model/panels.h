// Panels with subpixels for tests.
#pragma once
#include "display/display.h"

namespace lfdsim {

/// A panel with subpixels of this layout; of custom ones in cells of 3 x 2 pixels, with rectangles that hang over all their borders
/// and several to a colour.
inline Panel with_subpixels(Panel p, SubpixelLayout layout) {
    p.subpixels = layout;
    if (layout != SubpixelLayout::custom) return p;
    p.aperture_ratio = 0.8;
    p.subpixel_cell = {3, 2};
    p.custom = {{Channel::r, {0, 0}, {-0.4, -0.3, 0.5, 0.6}},
                {Channel::g, {1, 0}, {0.7, 0.1, 1.4, 1.9}},
                {Channel::b, {2, 1}, {1.6, 1.1, 2.4, 1.9}},
                {Channel::r, {1, 1}, {1.5, 0, 2.5, 1}},
                {Channel::b, {0, 1}, {-0.5, 0.7, 0.6, 1.6}}};
    return p;
}

}  // namespace lfdsim
