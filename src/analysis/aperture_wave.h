// How waves average over a lens's clear aperture. Floor 3.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <array>

namespace lfdsim {

/// The clear aperture of a paraxial lens, in the array's own axes.
struct ApertureShape {
    enum class Form { disk, rectangle, hexagon, slit };
    Form form;
    std::array<double, 2> width_mm;  // D along x' and y'; a hexagon's is that between opposite sides, a slit has no end along y'

    /// The mean of exp(-2 pi i nu q) over its places q, which is real, for a wave of nu periods per mm along x' and y': sinc of a
    /// rectangle, 2 J1(x)/x of a disk, of a hexagon a sum over its edges by Green's theorem. A slit is as if of no width along y':
    /// strips move light along x' alone.
    double mean(double nu_x, double nu_y) const;

    /// What |mean()| is not above for waves of nu periods per mm or more: its border over its area, over 2 pi nu (Green's theorem).
    double most(double nu) const;

    /// Whether a place, from the lens's axis, lies within.
    bool holds(double x, double y) const;
};

ApertureShape aperture_shape(const Display&, const Geometry&);

}  // namespace lfdsim
