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

/// Mean luminance over the panel's that an eye on axis sees of the screen: the transmission of lenses and
/// layers at normal incidence, times the share of lines of sight that, turned by the diffuser, meet a lens's clear aperture and end
/// on the panel: paraxial lines, summed to a thousandth. Lines between lenses of `clear` and `plate` see the panel as well.
TheoryFigure luminance_over_panel(const Display&, const Geometry&, double eye_mm);

}  // namespace lfdsim
