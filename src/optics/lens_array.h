// Which lens a ray meets: the cells that hold a lens, their stops, and the walk of an oblique ray from cell to cell. Floor 1.
//
// Positions are in the frame of the array (turned with it), relative to the axis of a base lens near the rays of a packet; cells
// are counted from that lens.
#pragma once
#include "optics/lattice.h"
#include "optics/surface.h"
#include "optics/traced_display.h"
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The cells that hold a lens, relative to the base lens: low .. high inclusive.
template <class S>
struct Extent {
    S low_i, high_i, low_j, high_j;
    template <class F>
    LFDSIM_FN Mask<F> holds(Cell<F> c) const {
        return both(both(c.i >= F(low_i), c.i <= F(high_i)), both(c.j >= F(low_j), c.j <= F(high_j)));
    }
};

/// Returns whether a ray that crosses the plane of the stops at (x, y) passes a hole.
template <class F>
LFDSIM_FN Mask<F> passes_stop(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, F x, F y) {
    const Cell<F> cell = cell_at(display.lattice, x, y);
    const Vec2<F> axis = axis_of(display.lattice, cell);
    const F lx = x - axis.x, ly = across(display.lattice, y - axis.y);
    return (lx * lx + ly * ly <= F(display.stop_radius2)) && extent.holds(cell);
}

/// Walks the cells of an array with staggered rows, for walk_cells(), from `begin` to `end`. Such an array has notches at its ends:
/// a line may pass cells without a lens between cells that have one, so the walk goes on where there is no lens.
template <class F, class Try>
LFDSIM_FN void walk_staggered(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, F x, F y, F mx, F my,
                              F begin, F end, Mask<F> active, Try try_cell) {
    using S = Scalar<F>;
    const F huge = F(S(1e30)), zero = F(0), one = F(1);
    const auto& lattice = display.lattice;
    Cell<F> cell = cell_at(lattice, x + mx * begin, y + my * begin);
    while (any(active)) {
        active = active && !try_cell(cell, active && extent.holds(cell));
        // The first border ahead: s there, the pair of borders, and on which side.
        const Vec2<F> axis = axis_of(lattice, cell);
        F next = huge, pair = zero, side = one;
        for (int k = 0; k < border_pairs(lattice); ++k) {
            const Borders<S> of = borders(lattice, k);
            const F slope = F(of.x) * mx + F(of.y) * my, at = F(of.x) * (x - axis.x) + F(of.y) * (y - axis.y);
            const F ahead = select(slope < zero, -one, one);
            const F s = select(abs(slope) < F(S(1e-20)), huge, (ahead * F(of.half) - at) / slope);
            const Mask<F> nearer = s < next;
            next = select(nearer, s, next);
            pair = select(nearer, F(S(k)), pair);
            side = select(nearer, ahead, side);
        }
        cell = cell_beyond(lattice, cell, pair, side, x + mx * next);
        active = active && (next <= end);
    }
}

/// Computes the s at which a line at + m s enters and leaves low <= at <= high along one axis; `in` > `out` where it does not. A
/// line of smaller slope than `level` is parallel to the slab.
template <class F>
LFDSIM_FN void cross_slab(F at, F m, Scalar<F> level, F low, F high, F& in, F& out) {
    const F huge = F(Scalar<F>(1e30)), a = (low - at) / m, b = (high - at) / m;
    const Mask<F> parallel = abs(m) < F(level), within = (at >= low) && (at <= high);
    in = select(parallel, select(within, -huge, huge), min(a, b));
    out = select(parallel, select(within, huge, -huge), max(a, b));
}

/// Walks cell by cell along the line (x + mx s, y + my s), from <= s <= depth, in the order in which the line enters them, and
/// calls try_cell(cell, active) in each that holds a lens; it returns the lanes that are done. Exact at any slope: no cell is
/// skipped. s is depth in z or path length, as the caller likes; m is the lateral displacement per s.
template <class F, class Try>
LFDSIM_FN void walk_cells(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, F x, F y, F mx, F my, F from,
                          F depth, Mask<F> active, Try try_cell) {
    const F huge = F(Scalar<F>(1e30)), zero = F(0), one = F(1);
    const auto& lattice = display.lattice;
    const F px = F(lattice.pitch[0]), py = F(lattice.pitch[1]), half_x = F(lattice.half_pitch[0]),
            half_y = F(lattice.half_pitch[1]);
    // s at the borders of a box about all cells, so that a ray from outside starts where it enters.
    F in_x, out_x, in_y, out_y;
    const F right = F(extent.high_i) * px + half_x, beyond = F(reach_of_cell(lattice));
    cross_slab(x, mx, Scalar<F>(1e-20), F(extent.low_i) * px - half_x, lattice.staggered ? right + half_x : right, in_x, out_x);
    cross_slab(y, my, Scalar<F>(1e-20), F(extent.low_j) * py - beyond, F(extent.high_j) * py + beyond, in_y, out_y);
    const F begin = max(max(in_x, in_y), from), end = min(min(out_x, out_y), depth);
    active = active && (begin <= end);
    if (lattice.staggered) return walk_staggered(display, extent, x, y, mx, my, begin, end, active, try_cell);

    const F step_i = select(mx < zero, -one, one), step_j = select(my < zero, -one, one);
    Cell<F> cell{min(max(cell_along(lattice, 0, x + mx * begin), F(extent.low_i)), F(extent.high_i)),
                 min(max(cell_along(lattice, 1, y + my * begin), F(extent.low_j)), F(extent.high_j))};
    while (any(active)) {
        active = active && !try_cell(cell, active);
        // Where the line leaves this cell: through the nearer of its two borders ahead.
        const F sx = select(abs(mx) < F(Scalar<F>(1e-20)), huge, (cell.i * px + step_i * half_x - x) / mx);
        const F sy = select(abs(my) < F(Scalar<F>(1e-20)), huge, (cell.j * py + step_j * half_y - y) / my);
        const Mask<F> along_x = sx < sy;
        cell.i = select(along_x, cell.i + step_i, cell.i);
        cell.j = select(along_x, cell.j, cell.j + step_j);
        active = active && (min(sx, sy) <= end) && extent.holds(cell);
    }
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
