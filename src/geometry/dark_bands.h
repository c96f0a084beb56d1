// Dark bands between lenses that do not fill their cells, and the diffuser that joins the lenses. docs/model.md, "Dark bands
// between lenses". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>

namespace lfdsim {

/// The contrast (Michelson) below which bands are not noticeable beside the picture's steps from lens to lens.
inline constexpr double visible_band_contrast = 0.1;

/// Returns z, mm from the panel, of the plane that limits light as a viewer sees it: of the pupil, where an aperture inside the
/// lens limits it; else of the stop before the lens, or of the lens's rim; for a lens that fills its cell, in the middle of the
/// sides across the array's x' (axis 0) or y' (1).
double aperture_plane_mm(const Display&, const Geometry&, std::size_t axis);

/// Returns the diffuser's full angle (full width at half maximum, if gaussian), degrees, that closes the gaps between lenses from
/// `height_mm` above that plane: 2 atan(p / 2 height). Lines of sight are then spread over exactly one lens pitch.
double gap_closing_angle_deg(double pitch_mm, double height_mm);

/// Returns the spread of lines of sight in that plane, mm along the display's x and y, that leaves no band along the array's x' and
/// y': from lens to lens along the one of these that is nearest to the display's axis. Of strips it is 0 along the other axis.
/// Exact for boxes.
std::array<double, 2> joining_spread_mm(const Geometry&);

/// Returns the Michelson contrast, along the array's x' and y', of the light of a white panel across one lens pitch (of the row
/// pitch along y), averaged over 1/32 of it and along the other axis (of staggered rows over one row), as an eye sees it from far
/// away on the axis. It considers the apertures and the diffuser only (docs/model.md, "Dark bands between lenses"). NaN along
/// strips.
std::array<double, 2> band_contrast(const Display&, const Geometry&);

}  // namespace lfdsim
