// How much of the panel an eye on the axis sees through one lens at once, by theory. docs/model.md, "Advice". Floor 0.
#pragma once
#include "geometry/geometry.h"

#include <cstddef>

namespace lfdsim {

/// An eye must see at most this share of an elemental image at once: if it sees more, no position shows only one view.
inline constexpr double most_seen_share = 0.5;

/// Returns the array's axis, x' (0) or y' (1), that is nearest to the display's x (k = 0) or y (1); of strips, which have one, 0.
std::size_t array_axis(const Geometry&, std::size_t k);

/// Returns the axis of the array, 0: x', 1: y', that is nearer to the line through a viewer's eyes; of strips x'.
inline std::size_t axis_of_eyes(const Geometry& g) { return array_axis(g, 0); }

/// Returns the width, mm along that axis, that an eye at the distance E from H' sees through a lens: D |1 + g/E - g/f|.
double seen_through_lens_mm(const Geometry&, double eye_mm);

/// What an eye sees at once is taken as the width that holds this share of the light, over the share: exact for evenly spread
/// light.
inline constexpr double middle_share = 0.95;

/// Returns that width of a diffuser's light, in units of its angle: 1 of a box, 1.75 of a normal distribution.
double even_width_of(Profile);

/// Returns the width that a diffuser of the angle w, at the height d above H', adds to that: 2 g tan(w/2) |1 - d/E|, times
/// even_width_of() its profile.
double seen_by_diffuser_mm(const Geometry&, double eye_mm, Profile, double angle_deg, double above_mm);

}  // namespace lfdsim
