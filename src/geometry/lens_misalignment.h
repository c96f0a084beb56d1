// The errors of an array: what they come to, and how those of its lenses are drawn. docs/model.md, "Errors". Floor 0.
#pragma once
#include "display/display.h"
#include "geometry/lattice.h"

#include <vector>

namespace lfdsim {

/// Whether the lenses of the array differ from each other in more than their place in the lattice.
bool lenses_differ(const Errors&);
/// Whether the array is not parallel to the panel.
bool is_wedged(const Errors&);
/// Whether the lenses do not stand alike in a lattice parallel to the panel: each then has a place of its own.
bool is_irregular(const Errors&);
/// Whether there are any errors.
bool has_errors(const Errors&);

/// The display that a description asks for.
Display without_errors(Display);
/// Whether what is shown is made for that one, though the display has errors.
bool knows_no_errors(const Display&);

/// By which the lenses stand further apart than described.
inline double pitch_scale(const Errors& e) { return 1 + e.pitch_ppm * 1e-6; }

/// How far errors of single lenses may go: three standard deviations and the most that the table gives.
struct LensErrorBounds {
    std::array<double, 2> aside_mm{};  // either way
    double height_mm[2] = {0, 0};      // lowest and highest
    std::array<double, 2> tilt_deg{};  // either way
    double curvature[2] = {0, 0};      // least and most
};
LensErrorBounds bounds(const LensArray&, const Errors&);

/// The errors of each lens, row by row from the lower left, are what is drawn and what the table gives together. A pure
/// function of seed, lens and quantity, without library functions, so that all machines draw the same.
std::vector<LensError> lens_errors(const Display&, const Lattice<double>&);

/// How much a lens stands out by the array's bow: (1 - rho^2) of it, rho its distance from the array's centre over that of the
/// corners; of strips over half the width. `x`, `y`: of its axis from the centre, mm.
double raised_mm(const Errors&, const Lattice<double>&, double x, double y);

/// Lenses in an array whose lenses differ from each other.
inline constexpr double most_different_lenses = 4e6;

}  // namespace lfdsim
