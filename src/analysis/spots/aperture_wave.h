// The form of a lens's clear aperture, and the means of waves over it. Floor 3.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lfdsim {

/// The clear aperture of a paraxial lens, mm in the array's frame from the lens's axis: a round pupil, a cell, or the
/// intersection of both (docs/model.md, "Pupil").
struct ApertureShape {
    /// A polygon is a cell of another form, or one whose corners a round pupil cuts off.
    enum class ApertureForm { disk, rectangle, slit, polygon };
    using Corners = std::vector<std::array<double, 2>>;

    ApertureForm form;
    std::array<double, 2> width_mm;  // D along x' and y'; a slit is unbounded along y'
    Corners outline{};               // of a polygon, counter-clockwise; arcs are short chords that keep the area

    /// Returns the mean of exp(-2 pi i nu.q) over positions q in the aperture, which is real by symmetry, for a wave of nu
    /// periods per mm along x' and y': sinc for a rectangle, 2 J1(x)/x with x = pi D |nu| for a disk, a sum over the edges for
    /// others. A slit counts as having no width along y', since strips deflect light along x' only.
    double mean(double nu_x, double nu_y) const;

    /// Returns an upper bound of |mean()| for waves of nu or more periods per mm: border over area, over 2 pi nu (Green's
    /// theorem).
    double most(double nu) const;

    /// Returns whether a position lies within the aperture.
    bool holds(double x, double y) const;

    /// Returns the distance between its least and its greatest position along x' (axis 0) or y' (1); a slit's along y' has no
    /// meaning.
    double extent_mm(std::size_t axis) const;

    /// Returns the share of its area that lies below a position along x' (axis 0) or y' (1).
    double below(std::size_t axis, double place) const;

    /// Returns the corners of its outline, counter-clockwise; a disk's as drawn with 60 corners, a slit's of the length
    /// `length_mm`.
    Corners corners(double length_mm) const;
};

/// Returns the corners of a cell of which all lengths are multiplied by `scale`, counter-clockwise from the lower right one.
ApertureShape::Corners cell_polygon(const Lattice<double>&, double scale = 1);

/// Returns the clear aperture of a display's lenses.
ApertureShape aperture_shape(const Display&, const Geometry&);

}  // namespace lfdsim
