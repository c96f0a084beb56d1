// What paraxial theory says of a white screen's luminance and of the dark bands at lens joints. Floor 3.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <array>
#include <string>

namespace lfdsim {

/// NaN where there is no closed form, and `missing` says why.
struct TheoryFigure {
    double value;
    std::string missing;
};

/// Mean luminance over the panel's that an eye on axis sees of the array's rectangle: what lenses fill of it, times their
/// transmission at normal incidence, times the share of its lines of sight that end on the panel and, behind a diffuser, cross the
/// array at all.
TheoryFigure luminance_over_panel(const Display&, const Geometry&, double eye_mm);

/// Michelson contrast of luminance across a pitch, in `bins` steps, along x (0) or y (1): chords of the lenses, averaged over what
/// the diffuser spreads, for the lenses of the middle half of the screen.
TheoryFigure band_contrast(const Display&, const Geometry&, double eye_mm, int axis, int bins);

}  // namespace lfdsim
