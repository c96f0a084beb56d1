// The panel: which pixel or subpixel a ray reaches (docs/model.md, "Panel"). Floor 1.
#pragma once
#include "optics/lens_array.h"
#include "optics/traced_display.h"
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Where the axis of a packet's base lens meets the panel: whole panel pixel and the fraction in [0, 1).
template <class S>
struct PanelBase {
    std::uint32_t column, row;
    S column_rest, row_rest;
    S raised = 0;  // of its vertex over the vertex plane, mm, where the array is not parallel to the panel
};

/// Where a ray reaches the panel's plane, in panel pixels to the right of and below the base's whole pixel; `alive`: whether it
/// does; `weight`: the share of the light there that it carries; `cell`: the lens that it came through, where that is a single one.
template <class F>
struct PanelPoint {
    F column, row;
    F weight;
    Mask<F> alive;
    Cell<F> cell;
};

/// A panel pixel: its number row x columns + column where `lit`, and the share of its light that the ray carries. On a panel with
/// subpixels four times that number, plus the channel, of which alone there is light (3: all).
template <class F>
struct PanelHit {
    Uint<F> pixel;
    F weight;
    Mask<F> lit;
};

/// Returns where a ray ends on the panel: the point (x, y), mm from the axis of the lens `cell` in the array's frame, in panel
/// pixels. Numbers stay small, so that the position is accurate to a few millionths of a pixel on any panel. `plain` promises
/// that the array is not rotated.
template <bool plain = false, class F>
LFDSIM_FN PanelPoint<F> panel_point(const TracedDisplay<Scalar<F>>& display, const Lattice<Scalar<F>>& lattice,
                                    const PanelBase<Scalar<F>>& base, Cell<F> cell, F x, F y, F weight, Mask<F> alive) {
    // From the base lens's axis: ((x, y) + axis_of(cell)) / a, turned to the panel's axes; rows are counted downwards.
    const F k = F(display.pixels_per_mm);
    Vec2<F> at{x * k + cell.i * F(display.pitch_pixels[0]), lattice.strips ? y * k : y * k + cell.j * F(display.pitch_pixels[1])};
    if (lattice.staggered) at.x = at.x + stagger(lattice, cell.j) * k;
    if (!plain && display.rotated) at = to_display(display.lattice, at.x, at.y);
    return {F(base.column_rest) + at.x, F(base.row_rest) - at.y, weight, alive, cell};
}

/// A place along one axis of the panel (0: columns, 1: rows), in its cell of subpixels.
template <class F>
struct InCell {
    F at;      // the place, as a share of the cell, in [0, 1)
    F before;  // number of pixels from the cell's first to the one that holds the place

    /// `place` is in panel pixels from the base's whole pixel `number`. Cells are counted from the panel's first pixel; `number` is
    /// reduced to its rest in the cell, so that numbers stay small, and the half keeps the floor exact although 1/size is rounded.
    LFDSIM_FN InCell(const SubpixelPart<Scalar<F>>& part, int axis, std::uint32_t number, F place) {
        using S = Scalar<F>;
        const S size = S(part.cell[axis]);
        const F whole = floor(place), from_cell = whole + F(S(rest_of(std::int32_t(number), part.cell[axis])));
        before = from_cell - floor((from_cell + F(S(0.5))) * F(part.per_cell[axis])) * F(size);
        at = (before + (place - whole)) * F(part.per_cell[axis]);
    }
    /// Returns number modulo cell, in 0 .. cell - 1 also for negative numbers (a base lens beside the panel).
    LFDSIM_FN static std::int32_t rest_of(std::int32_t number, std::int32_t cell) { return (number % cell + cell) % cell; }
    LFDSIM_FN Mask<F> inside(const SubpixelPart<Scalar<F>>& part, int axis) const {
        return (at >= F(part.from[axis])) && (at < F(part.to[axis]));
    }
};

/// Returns what the subpixel under a point shows: `pixel` is 4 times the panel pixel's number plus the channel, and `weight` is
/// multiplied by the part's brightness, share / ((to - from)_x (to - from)_y). Between the parts nothing is lit. `column` and `row`
/// are the panel pixel under the point.
template <class F>
LFDSIM_FN PanelHit<F> subpixel_under(const TracedDisplay<Scalar<F>>& display, const PanelBase<Scalar<F>>& base,
                                     const PanelPoint<F>& point, Uint<F> column, Uint<F> row, Mask<F> lit) {
    PanelHit<F> hit{Uint<F>(0u), F(0), F(1) < F(0)};
    for (int k = 0; k < display.emission.count; ++k) {
        const SubpixelPart<Scalar<F>>& part = display.emission.part[k];
        const InCell<F> across(part, 0, base.column, point.column), down(part, 1, base.row, point.row);
        const Uint<F> shown_column = column + to_int(F(Scalar<F>(part.pixel[0])) - across.before),
                      shown_row = row + to_int(F(Scalar<F>(part.pixel[1])) - down.before);
        const Mask<F> here = lit && across.inside(part, 0) && down.inside(part, 1) && (shown_column < Uint<F>(display.columns)) &&
                             (shown_row < Uint<F>(display.rows));
        const Uint<F> pixel = shown_row * Uint<F>(display.columns) + shown_column;
        hit.pixel = select(here, (pixel << 2) + Uint<F>(std::uint32_t(part.channel)), hit.pixel);
        hit.weight = select(here, point.weight * F(part.share * (part.per[0] * part.per[1])), hit.weight);
        hit.lit = hit.lit || here;
    }
    return hit;
}

/// Returns the pixel or subpixel under a point. `whole` promises a panel whose pixels emit over their whole area.
template <bool whole = false, class F>
LFDSIM_FN PanelHit<F> panel_pixel(const TracedDisplay<Scalar<F>>& display, const PanelBase<Scalar<F>>& base,
                                  const PanelPoint<F>& point) {
    // Unsigned numbers: left of and above the panel they wrap and are larger than its size, too.
    const Uint<F> column = Uint<F>(base.column) + floor_to_int(point.column);
    const Uint<F> row = Uint<F>(base.row) + floor_to_int(point.row);
    const Mask<F> lit = point.alive && (column < Uint<F>(display.columns)) && (row < Uint<F>(display.rows));
    if (!whole && !display.emission.whole) [[unlikely]]
        return subpixel_under(display, base, point, column, row, lit);
    return {row * Uint<F>(display.columns) + column, point.weight, lit};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
