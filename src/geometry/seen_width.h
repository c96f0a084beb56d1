// How much of the panel an eye on the axis sees through one lens at once, by theory. docs/model.md, "Advice". Floor 0.
#pragma once
#include "geometry/geometry.h"

#include <cstddef>

namespace lfdsim {

/// An eye must see at most this share of an elemental image at once: if it sees more, no position shows only one view.
inline constexpr double most_seen_share = 0.5;

/// Returns the axis of the array, 0: x', 1: y', that is nearer to the line through a viewer's eyes; of strips x'.
std::size_t axis_of_eyes(const Geometry&);

/// Returns the width, mm along that axis, that an eye at the distance E from H' sees through a lens: D |1 + g/E - g/f|.
double seen_through_lens_mm(const Geometry&, double eye_mm);

/// Returns the width that a diffuser of the full angle w, at the height d above H', adds to that: 2 g tan(w/2) |1 - d/E|.
double seen_by_diffuser_mm(const Geometry&, double eye_mm, double angle_deg, double above_mm);

}  // namespace lfdsim
