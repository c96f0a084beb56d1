// The lattice of lenses: which lens is at a point, and where a lens's axis is. Floor 1.
//
// Lenses are numbered in two ways. In the array, lens (i, j) is counted from 0 at the lower left, and positions are measured from
// the array's middle. Near a packet of rays, cells and positions are relative to a base lens's axis: single precision then never
// sees a number much larger than a lens. Where rows are staggered, the base lens is in an even row, so that a row is odd in both
// numberings or in neither.
#pragma once
#include "geometry/lattice.h"
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// A cell of the lattice, or its lens: column i, to the right, and row j, upwards. Both are whole numbers.
template <class F>
struct Cell {
    F i, j;
};
/// Returns `a` in the lanes of `first`, `b` in the others.
template <class F>
LFDSIM_FN Cell<F> choose(Mask<F> first, Cell<F> a, Cell<F> b) {
    return {select(first, a.i, b.i), select(first, a.j, b.j)};
}

/// A vector with components along x and y: a point or a difference, in mm, in the array's frame or, where a function says so, in
/// the display's.
template <class F>
struct Vec2 {
    F x, y;
};

// Functions of positions relative to the base lens's axis, mm in the array's frame.

/// Returns the number of the column (axis 0) or row (axis 1) of cells that contains `place`, along x' or y' alone:
/// floor(place/pitch + 1/2).
template <class F>
LFDSIM_FN F cell_along(const Lattice<Scalar<F>>& lattice, int axis, F place) {
    return floor(place * F(lattice.per_pitch[axis]) + F(Scalar<F>(0.5)));
}

/// Returns 1 for odd whole numbers and 0 for even ones.
template <class F>
LFDSIM_FN F parity(F number) {
    return number - F(2) * floor(F(Scalar<F>(0.5)) * number);
}

/// Returns the shift of the axes in row j to the right of those in even rows, mm: half a pitch in odd rows.
template <class F>
LFDSIM_FN F stagger(const Lattice<Scalar<F>>& lattice, F j) {
    return parity(j) * F(lattice.half_pitch[0]);
}

/// Returns the axis of the lens in a cell: (i p_x + stagger(j), j p_y), mm; strips have y' = 0.
template <class F>
LFDSIM_FN Vec2<F> axis_of(const Lattice<Scalar<F>>& lattice, Cell<F> cell) {
    const F x = cell.i * F(lattice.pitch[0]);
    if (lattice.staggered) return {x + stagger(lattice, cell.j), cell.j * F(lattice.pitch[1])};
    return {x, lattice.strips ? F(0) : cell.j * F(lattice.pitch[1])};  // strips: there is one row, without end
}

/// A pair of opposite borders of a cell: the lines at +-half from its axis along the unit vector (x, y).
template <class S>
struct Borders {
    S x, y, half;
};
/// Returns the number of pairs of opposite borders of a cell: 2 of a rectangle, 3 of a hexagon, 1 of a strip.
template <class S>
LFDSIM_FN int border_pairs(const Lattice<S>& lattice) {
    return lattice.hexagonal ? 3 : lattice.strips ? 1 : 2;
}
/// Returns a pair of borders, counted from 0: normal to x', then to y', or, of hexagons, at 60 and 120 degrees.
template <class S>
LFDSIM_FN Borders<S> borders(const Lattice<S>& lattice, int pair) {
    if (pair == 0) return {S(1), S(0), lattice.half_pitch[0]};
    if (!lattice.hexagonal) return {S(0), S(1), lattice.half_pitch[1]};
    return {S(pair == 1 ? 0.5 : -0.5), S(0.86602540378443865), lattice.half_pitch[0]};  // at 60 and 120 degrees
}

/// Returns the cell that contains the point (x, y): by one floor along each axis, of hexagons by a second comparison with the
/// oblique border.
template <class F>
LFDSIM_FN Cell<F> cell_at(const Lattice<Scalar<F>>& lattice, F x, F y) {
    if (!lattice.staggered) return {cell_along(lattice, 0, x), lattice.strips ? F(0) : cell_along(lattice, 1, y)};
    if (!lattice.hexagonal) {
        const F j = cell_along(lattice, 1, y);
        return {cell_along(lattice, 0, x - stagger(lattice, j)), j};
    }
    // A hexagon holds the points that are nearest to its axis, and its corners do not reach the next row's axes: the point is in
    // the row below it or in the one above, whose axes are half a pitch to the left and to the right.
    const F below = floor(y * F(lattice.per_pitch[1])), odd = parity(below), aside = odd * F(lattice.half_pitch[0]);
    const F i = cell_along(lattice, 0, x - aside), dx = x - (i * F(lattice.pitch[0]) + aside), dy = y - below * F(lattice.pitch[1]);
    const Borders<Scalar<F>> oblique = borders(lattice, 1);
    // The point is above the oblique border of the lower hexagon: then it is in the row above, in the lens on the point's side.
    const Mask<F> beyond = F(oblique.x) * abs(dx) + F(oblique.y) * dy > F(oblique.half);
    const F i_above = i + odd - select(dx < F(0), F(1), F(0));
    return {select(beyond, i_above, i), select(beyond, below + F(1), below)};
}

/// Returns the neighbour of `cell` across a border: pair as in borders(), side -1 or +1; in staggered rows the neighbour at x' =
/// place.
template <class F>
LFDSIM_FN Cell<F> cell_beyond(const Lattice<Scalar<F>>& lattice, Cell<F> cell, F pair, F side, F place) {
    const Mask<F> in_row = pair == F(0);
    const F i = select(in_row, cell.i + side, cell.i), j = select(in_row, cell.j, cell.j + side);
    if (!lattice.staggered) return {i, j};
    // A hexagon's neighbours in the next row are shifted by half a pitch to the right and to the left.
    const F x = lattice.hexagonal ? axis_of(lattice, cell).x + select(pair == F(1), side, -side) * F(lattice.half_pitch[0]) : place;
    return {select(in_row, i, cell_along(lattice, 0, x - stagger(lattice, j))), j};
}

/// Returns the greatest distance of a cell's points from its axis along y', mm: to the corner of a hexagon, to the border of a
/// rectangle.
template <class S>
LFDSIM_FN S reach_of_cell(const Lattice<S>& lattice) {
    return lattice.hexagonal ? lattice.half_pitch[0] * S(1.1547005383792515) : lattice.half_pitch[1];  // 2/sqrt(3) to the corner
}

/// The corners of a cell, mm from its axis, counter-clockwise; the right side is that from corner 0 to corner 1.
template <class S>
struct CellCorners {
    int count;
    S x[6], y[6];
};
/// Returns the corners of a cell: 6 of a hexagon, 4 of a rectangle; a strip ends at half_pitch[1].
template <class S>
LFDSIM_FN CellCorners<S> corners_of_cell(const Lattice<S>& lattice) {
    const S x = lattice.half_pitch[0], y = reach_of_cell(lattice);
    if (!lattice.hexagonal) return {4, {x, x, -x, -x}, {-y, y, y, -y}};
    const S beside = S(0.5) * y;
    return {6, {x, x, S(0), -x, -x, S(0)}, {-beside, beside, y, beside, -beside, -y}};
}

/// Returns the part of a distance along y' on which a lens's sag depends: all of it, or 0 for strips, whose section is the same
/// everywhere.
template <class F>
LFDSIM_FN F across(const Lattice<Scalar<F>>& lattice, F y) {
    return lattice.strips ? F(0) : y;
}

/// Returns whether a point (x, y), measured from a lens's axis, lies in that lens's cell, or at most `margin` mm outside of it.
template <class F>
LFDSIM_FN Mask<F> in_cell(const Lattice<Scalar<F>>& lattice, F x, F y, F margin = F(0)) {
    const F half_x = F(lattice.half_pitch[0]) + margin;
    if (lattice.hexagonal) {
        const Borders<Scalar<F>> oblique = borders(lattice, 1);
        return (abs(x) <= half_x) && (F(oblique.x) * abs(x) + F(oblique.y) * abs(y) <= half_x);
    }
    return (abs(x) <= half_x) && (abs(y) <= F(lattice.half_pitch[1]) + margin);
}

// Functions of positions from the array's centre, mm in the array's frame.

/// Returns the axis of lens (i, j), docs/model.md, "Lens array and surround": ((i + 1/2 - n_x/2) p_x, (j + 1/2 - n_y/2) p_y),
/// staggered rows shifted by -+p_x/4.
template <class S>
LFDSIM_FN Vec2<S> axis_in_array(const Lattice<S>& lattice, Cell<S> lens) {
    const S x = (lens.i + S(0.5) - S(0.5) * lattice.count[0]) * lattice.pitch[0],
            y = (lens.j + S(0.5) - S(0.5) * lattice.count[1]) * lattice.pitch[1];
    if (lattice.staggered) return {x + (stagger(lattice, lens.j) - S(0.5) * lattice.half_pitch[0]), y};
    return {x, y};
}

/// Returns the lens (i, j) in whose cell the point (x, y) lies; beside the array a number outside 0 .. count - 1.
template <class S>
LFDSIM_FN Cell<S> lens_at(const Lattice<S>& lattice, S x, S y) {
    if (lattice.staggered) {  // from the axis of lens (0, 0), in an even row
        const Vec2<S> first = axis_in_array(lattice, Cell<S>{S(0), S(0)});
        return cell_at(lattice, x - first.x, y - first.y);
    }
    const S i = floor(x / lattice.pitch[0] + S(0.5) * lattice.count[0]);
    if (lattice.strips) return {i, S(0)};
    return {i, floor(y / lattice.pitch[1] + S(0.5) * lattice.count[1])};
}

/// Returns whether the array has a lens (i, j).
template <class S>
LFDSIM_FN bool holds(const Lattice<S>& lattice, Cell<S> lens) {
    return lens.i >= 0 && lens.i < lattice.count[0] && lens.j >= 0 && lens.j < lattice.count[1];
}

/// Returns the lens (i, j) that serves as base lens near `near`, which may lie beside the array: the nearest one that exists, where
/// rows are staggered in an even row.
template <class S>
LFDSIM_FN Cell<S> base_cell(const Lattice<S>& lattice, Cell<S> near) {
    const auto within = [](S k, S count) { return k > 0 ? k < count - 1 ? k : count - 1 : S(0); };
    const S j = within(near.j, lattice.count[1]);
    return {within(near.i, lattice.count[0]), lattice.staggered ? S(2) * floor(j / S(2)) : j};
}

// Functions that convert between the display's frame and the array's. In the display's frame the array is turned counter-clockwise.

/// Returns a vector of the display's frame in the array's frame.
template <class F>
LFDSIM_FN Vec2<F> to_array(const Lattice<Scalar<F>>& lattice, F x, F y) {
    const F c = F(lattice.cos_turn), s = F(lattice.sin_turn);
    return {c * x + s * y, c * y - s * x};
}

/// Returns a vector of the array's frame in the display's frame.
template <class F>
LFDSIM_FN Vec2<F> to_display(const Lattice<Scalar<F>>& lattice, F x, F y) {
    const F c = F(lattice.cos_turn), s = F(lattice.sin_turn);
    return {c * x - s * y, s * x + c * y};
}

/// Returns the point of the display's frame, mm, that lies at `from_middle` from the array's centre in the array's frame.
template <class S>
LFDSIM_FN Vec2<S> in_display(const Lattice<S>& lattice, Vec2<S> from_middle) {
    const Vec2<S> turned = to_display(lattice, from_middle.x, from_middle.y);
    return {turned.x + lattice.offset[0], turned.y + lattice.offset[1]};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
