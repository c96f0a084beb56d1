// The errors of an array: which kinds it has, and how those of its lenses are drawn. docs/model.md, "Errors". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/lattice.h"

#include <vector>

namespace lfdsim {

/// Returns whether the lenses of the array differ from each other in more than their lattice positions.
bool lenses_differ(const Errors&);
/// Returns whether the array is not parallel to the panel.
bool is_wedged(const Errors&);
/// Returns whether the lenses are displaced individually, so that they do not form a lattice parallel to the panel.
bool is_irregular(const Errors&);
/// Returns whether any error is not zero.
bool has_errors(const Errors&);

/// Returns the display as described, with all errors removed.
Display without_errors(Display);
/// Returns whether content is made for the display without errors, though the display has errors.
bool knows_no_errors(const Display&);

/// Returns the factor by which the lenses' positions are stretched about the array's centre, 1 + pitch_ppm 1e-6.
inline double pitch_scale(const Errors& e) { return 1 + e.pitch_ppm * 1e-6; }

/// The range of the errors of single lenses: three standard deviations plus the extremes of the table.
struct LensErrorBounds {
    std::array<double, 2> aside_mm{};  // along x' and y', in both directions
    double height_mm[2] = {0, 0};      // lowest and highest
    std::array<double, 2> tilt_deg{};  // about x' and y', in both directions
    double curvature[2] = {0, 0};      // least and greatest e
};
/// Returns the range of the errors of an array's lenses, drawn and given, without the bow.
LensErrorBounds bounds(const LensArray&, const Errors&);

/// Returns the errors of each lens, row by row from the lower left: the random errors plus those of the table. A pure function of
/// seed, lens and quantity, without library functions, so that all machines draw the same numbers.
std::vector<LensError> lens_errors(const Display&, const Lattice<double>&);

/// Returns the height, mm, by which the array's bow b raises a lens: b (1 - rho^2), rho its distance from the array's centre over
/// that of the corners; of strips over half the width. `x`, `y`: position of its axis from the centre, mm.
double raised_mm(const Errors&, const Lattice<double>&, double x, double y);

/// The greatest number of lenses in an array whose lenses differ from each other.
inline constexpr double most_different_lenses = 4e6;

}  // namespace lfdsim
