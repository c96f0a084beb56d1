// A small font of dots for labels on pictures. Floor 0.
#pragma once
#include "image/image.h"

#include <string_view>

namespace lfdsim {

inline constexpr int glyph_width = 6, glyph_height = 10;  // dots, spacing included

/// Returns the scale at which text is readable when a picture of this width is shown 480 pixels wide, as on a phone or in a list of
/// pictures.
int readable_scale(int picture_width);

/// Draws UTF-8 text in one line, in linear `light`, with its upper left corner at (x, y) and each dot of the font `scale` pixels
/// wide, cut off at the image's edge. Where a dot has several pixels, smoothed lines are drawn from dot to dot. There are glyphs
/// for ASCII, the degree sign, plus-minus, and Latin letters without their accents; any other character is a box.
void draw_text(Image&, int x, int y, int scale, std::string_view text, float light);

}  // namespace lfdsim
