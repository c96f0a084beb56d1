// Curves and maps as SVG: readable on a light page and a dark one, without colours, and by programs. Floor 4.
#pragma once
#include "analysis/result.h"

#include <string>

namespace lfdsim {

/// A plot about 720 pixels wide. Curves differ in colour and in dashes. Values that are not finite break a curve; a series without
/// values is in the legend alone. A mark outside the range of the curves is named in the legend with its place.
/// Throws std::invalid_argument if a series has not as many x as y.
std::string svg(const Plot&);

/// A map with its colour scale, the same scale along both axes where their labels end in the same unit (", mm") and the map's sides
/// are not too different. What is not finite is left blank; values beyond the scale have its end's colour.
/// Throws std::invalid_argument if values are not rows x columns, or a range falls.
std::string svg(const ColourMap&);

}  // namespace lfdsim
