// What POV-Ray's numbers and light can hold of a display, and what its scenes therefore have instead. Floor 2.
#pragma once
#include "interchange/peers/peers.h"

#include <string>
#include <vector>

namespace lfdsim::peers {

/// Distance between a body that fills its cell and the cell's border, in pitches: half the gap between bodies that would touch.
inline constexpr double pov_gap_pitches = 2.5e-5;

/// Returns POV-Ray's units for a millimetre. POV-Ray ignores intersections closer than 1e-3 units to a ray's start, so a lens is
/// 120 units wide, or less where the camera is far away, since there is nothing for POV-Ray beyond 1e7 units.
double pov_units_per_mm(const Display&, const Geometry&);

/// Returns what the scene has instead of the display, a line each; `shown` becomes the display that the scene shows.
std::vector<std::string> pov_deviations(Display& shown, const Geometry&, const PeerOptions&);

}  // namespace lfdsim::peers
