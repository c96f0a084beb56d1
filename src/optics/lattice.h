// The lattice of lenses: which lens is at a point, and where a lens's axis is. Floor 1.
//
// Lenses are numbered in two ways. In the array, lens (i, j) is counted from 0 at the lower left, and positions are measured from
// the array's middle. Near a packet of rays, cells and positions are relative to a base lens's axis: single precision then never
// sees a number much larger than a lens.
#pragma once
#include "model/lattice.h"
#include "optics/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Whole numbers.
template <class F>
struct Cell {
    F i, j;
};

/// A point or a vector of the array's frame or, where it says so, of the display's; mm.
template <class F>
struct Place {
    F x, y;
};

// From a lens's axis.

/// Along x' (axis 0) or y' (1) alone: the number of the column or row of cells that contains `place`.
template <class F>
LFDSIM_FN F cell_along(const Lattice<Scalar<F>>& lattice, int axis, F place) {
    return floor(place * F(lattice.per_pitch[axis]) + F(Scalar<F>(0.5)));
}

template <class F>
LFDSIM_FN Cell<F> cell_at(const Lattice<Scalar<F>>& lattice, F x, F y) {
    return {cell_along(lattice, 0, x), cell_along(lattice, 1, y)};
}

template <class F>
LFDSIM_FN Place<F> axis_of(const Lattice<Scalar<F>>& lattice, Cell<F> cell) {
    return {cell.i * F(lattice.pitch[0]), cell.j * F(lattice.pitch[1])};
}

/// Whether a point (x, y), measured from a lens's axis, lies in that lens's cell.
template <class F>
LFDSIM_FN Mask<F> in_cell(const Lattice<Scalar<F>>& lattice, F x, F y) {
    return (abs(x) <= F(lattice.half_pitch[0])) && (abs(y) <= F(lattice.half_pitch[1]));
}

// From the array's middle.

template <class S>
LFDSIM_FN Cell<S> lens_at(const Lattice<S>& lattice, S x, S y) {
    return {floor(x / lattice.pitch[0] + S(0.5) * lattice.count[0]), floor(y / lattice.pitch[1] + S(0.5) * lattice.count[1])};
}

template <class S>
LFDSIM_FN Place<S> axis_in_array(const Lattice<S>& lattice, Cell<S> lens) {
    return {(lens.i + S(0.5) - S(0.5) * lattice.count[0]) * lattice.pitch[0],
            (lens.j + S(0.5) - S(0.5) * lattice.count[1]) * lattice.pitch[1]};
}

template <class S>
LFDSIM_FN bool holds(const Lattice<S>& lattice, Cell<S> lens) {
    return lens.i >= 0 && lens.i < lattice.count[0] && lens.j >= 0 && lens.j < lattice.count[1];
}

// Between the frames.

/// A vector of the display's frame in the array's.
template <class F>
LFDSIM_FN Place<F> to_array(const Lattice<Scalar<F>>& lattice, F x, F y) {
    const F c = F(lattice.cos_turn), s = F(lattice.sin_turn);
    return {c * x + s * y, c * y - s * x};
}

/// A vector of the array's frame in the display's.
template <class F>
LFDSIM_FN Place<F> to_display(const Lattice<Scalar<F>>& lattice, F x, F y) {
    const F c = F(lattice.cos_turn), s = F(lattice.sin_turn);
    return {c * x - s * y, s * x + c * y};
}

/// A point of the array, from its middle, in the display's frame.
template <class S>
LFDSIM_FN Place<S> in_display(const Lattice<S>& lattice, Place<S> from_middle) {
    const Place<S> turned = to_display(lattice, from_middle.x, from_middle.y);
    return {turned.x + lattice.offset[0], turned.y + lattice.offset[1]};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
