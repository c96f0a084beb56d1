// Where the lenses of an array stand. Floor 0: plain data; the functions on it are in optics/lattice.h, compiled once for each
// instruction set.
#pragma once

namespace lfdsim {

struct LensArray;

/// Lengths in mm. The array's frame has x' along its rows and y' along its columns. Lens (i, j), counted from 0 to the right and
/// upwards, has its axis at ((i + 1/2 - nx/2) px, (j + 1/2 - ny/2) py) from the array's middle; its cell is the rectangle about it.
template <class S>
struct Lattice {
    S pitch[2], per_pitch[2], half_pitch[2];  // along x' and y'; the second its inverse
    S count[2];                               // lenses along x' and y'
    S offset[2];                              // of the array's middle in the display's frame
    S cos_turn, sin_turn;                     // of the array's frame against the display's, counter-clockwise to the viewer
};

/// Whether figures that depend on the pitch differ between the array's own x and y, and are reported for each.
bool differs_by_axis(const LensArray&);

/// Radii of the largest disk within a cell and of the smallest around it, mm.
double inner_radius_mm(const LensArray&);
double outer_radius_mm(const LensArray&);

/// Rounded to S from double precision.
template <class S>
Lattice<S> make_lattice(const LensArray&);

}  // namespace lfdsim
