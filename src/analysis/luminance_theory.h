// A white screen's luminance by paraxial theory. Floor 3.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <string>

namespace lfdsim {

/// NaN where there is no closed form, and `missing` says why.
struct TheoryFigure {
    double value;
    std::string missing;
};

/// Mean luminance over the panel's that an eye on axis sees of the array's rectangle: the lenses' fill factor, times their
/// transmission at normal incidence, times the share of its lines of sight that end on the panel and, behind a diffuser, cross the
/// array at all.
TheoryFigure luminance_over_panel(const Display&, const Geometry&, double eye_mm);

}  // namespace lfdsim
