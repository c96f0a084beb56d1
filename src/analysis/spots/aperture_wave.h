// How waves average over a lens's clear aperture. Floor 3.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lfdsim {

/// The clear aperture of a paraxial lens, in the array's own axes: a round pupil, a cell, or what is common to both.
struct ApertureShape {
    enum class ApertureForm { disk, rectangle, hexagon, slit, cut };  // cut: a cell whose corners lie outside of a round pupil
    using Corners = std::vector<std::array<double, 2>>;

    ApertureForm form;
    std::array<double, 2> width_mm;  // D along x' and y'; a hexagon's is that between opposite sides, a slit has no end along y'
    Corners outline{};               // of a cut cell, counter-clockwise; arcs in short chords that keep the area

    /// The mean of exp(-2 pi i nu q) over its places q, which is real, for a wave of nu periods per mm along x' and y': sinc of a
    /// rectangle, 2 J1(x)/x of a disk, of others a sum over the edges by Green's theorem. A slit is as if of no width along y':
    /// strips move light along x' alone.
    double mean(double nu_x, double nu_y) const;

    /// The upper bound of |mean()| for waves of nu periods per mm or more: its border over its area, over 2 pi nu (Green's
    /// theorem).
    double most(double nu) const;

    /// Whether a place, from the lens's axis, lies within.
    bool holds(double x, double y) const;

    /// The extent from its least to its greatest position along x' (axis 0) or y' (1); a slit's y' has no meaning.
    double extent_mm(std::size_t axis) const;

    /// The share of its area that lies below a place along x' (axis 0) or y' (1).
    double below(std::size_t axis, double place) const;

    /// The corners of its outline; of a disk, and of a slit as long as `length_mm`, as they are drawn.
    Corners corners(double length_mm) const;
};

ApertureShape aperture_shape(const Display&, const Geometry&);

}  // namespace lfdsim
