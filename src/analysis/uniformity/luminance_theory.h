// The luminance of a white screen by theory. Floor 3.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>

namespace lfdsim {

/// A figure by theory; NaN if there is none, and `missing` says why.
struct TheoryFigure {
    double value;
    std::string missing;
};

/// Returns the mean luminance, relative to the panel's, that an eye on axis, `eye_mm` from the panel, sees of the screen: of
/// lines of sight that aim at it, the share that the diffuser and a lens lead to the panel, times the transmission on that path,
/// accurate to a thousandth. Thin lenses are paraxial, glass ones are isolated with their real surfaces. Lines between lenses of
/// `clear` and `plate` see the panel as well; there is no figure where lenses in these surrounds lose light to their walls, nor
/// for a panel that is not Lambertian.
TheoryFigure luminance_over_panel(const Display&, const Geometry&, double eye_mm);

}  // namespace lfdsim
