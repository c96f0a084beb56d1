// A white screen's luminance by paraxial theory. Floor 3.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>

namespace lfdsim {

/// NaN where there is no closed form, and `missing` says why.
struct TheoryFigure {
    double value;
    std::string missing;
};

/// Mean luminance over the panel's that an eye on axis sees of the screen: of lines of sight that aim at it, the share that the
/// diffuser and a lens lead to the panel, times the transmission on that way, summed to a thousandth. Thin lenses are paraxial;
/// glass ones stand by themselves, with their own surfaces. Lines between lenses of `clear` and `plate` see the panel as well;
/// where lenses in these lose light to their walls there is no figure.
TheoryFigure luminance_over_panel(const Display&, const Geometry&, double eye_mm);

}  // namespace lfdsim
