// Curves and maps as SVG: readable on light and dark pages, without colours, and by programs. Floor 4.
#pragma once
#include "analysis/core/result.h"

#include <string>

namespace lfdsim {

inline constexpr double plot_width = 600, least_plot_width = 300;  // pixels

/// Returns a plot of a width in pixels, in which text has 12 pixels or more. Curves differ in colour and in dashes. Values that are
/// not finite break a curve; a series without values appears only in the legend. A mark outside the range of the curves is listed
/// in the legend with its value. Throws std::invalid_argument if a series has different numbers of x and y.
std::string svg(const Plot&, double width = plot_width);

/// Returns a map with its colour scale, and the same scale along both axes where their labels end in the same unit (", mm") and the
/// map's sides are at most in the ratio 5. Values that are not finite are left blank; values beyond the colour scale get the colour
/// of its end. Throws std::invalid_argument if values are not rows x columns, or a range is reversed.
std::string svg(const ColourMap&);

}  // namespace lfdsim
