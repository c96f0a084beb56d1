// The plane in which side views show a display. Floor 4.
#pragma once
#include "analysis/core/subject.h"

namespace lfdsim {

/// Side views show a column of lenses, upright, from the side. Rows of hexagons and bricks are what their lenses stand in without
/// gaps, and strips have a section along their row alone: of those the display is turned by a quarter, so that the view shows a
/// row, and each lens is the one of revolution that has the same section. Other displays stay as they are.
bool shows_a_row(const Display&);
Subject section_of(const Subject&);

}  // namespace lfdsim
