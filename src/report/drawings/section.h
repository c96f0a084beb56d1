// The plane in which side views show a display, and the display that has this section. Floor 4.
#pragma once
#include "analysis/core/subject.h"

namespace lfdsim {

/// Whether side views show a row of lenses in place of a column. Hexagons and bricks touch along rows only, and strips have a
/// section along their row only.
bool shows_a_row(const Display&);
/// Returns the display whose column of lenses, in the plane x = 0, side views draw. Where they show a row, the display is rotated
/// by a quarter turn, and each lens is the one of revolution that has the same section, cut at its cell's borders. Others are
/// unchanged.
Subject section_of(const Subject&);

}  // namespace lfdsim
