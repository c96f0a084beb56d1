// A small font of dots for labels on pictures. Floor 0.
#pragma once
#include "image/image.h"

#include <string_view>

namespace lfdsim {

inline constexpr int glyph_width = 6, glyph_height = 10;  // spacing included

/// The scale at which text is readable when a picture this wide is shown 480 pixels wide, as on a phone or in a list of pictures.
int readable_scale(int picture_width);

/// Draws text with its upper left corner at (x, y), each dot of the font `scale` pixels wide, cut off at the image's edge: lines
/// from dot to dot, smoothed, where a dot has several pixels. ASCII, the degree sign, Latin letters without their accents; a box
/// stands for any other character.
void draw_text(Image&, int x, int y, int scale, std::string_view text, float light);

}  // namespace lfdsim
