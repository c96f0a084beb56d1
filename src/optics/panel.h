// The panel: which pixel a ray reaches. Floor 1.
#pragma once
#include "optics/lane.h"
#include "optics/lens_array.h"
#include "optics/scene.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Where the axis of a packet's base lens meets the panel: whole panel pixel and the fraction in [0, 1).
template <class S>
struct PanelBase {
    std::uint32_t column, row;
    S column_rest, row_rest;
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

/// A panel pixel: its number row x columns + column where `lit`, and the share of its light that the ray carries.
template <class F>
struct PanelHit {
    Uint<F> pixel;
    F weight;
    Mask<F> lit;
};

/// The point (x, y), mm from the axis of the lens `cell` in the array's frame. Numbers stay small, so that the position is accurate
/// to a few millionths of a pixel on any panel.
template <class F>
LFDSIM_FN PanelPoint<F> panel_point(const Scene<Scalar<F>>& scene, const PanelBase<Scalar<F>>& base, Cell<F> cell, F x, F y,
                                    F weight, Mask<F> alive) {
    const F k = F(scene.pixels_per_mm);
    Place<F> at{x * k + cell.i * F(scene.pitch_pixels[0]), y * k + cell.j * F(scene.pitch_pixels[1])};
    if (scene.lattice.staggered) at.x = at.x + stagger(scene.lattice, cell.j) * k;
    if (scene.rotated) at = to_display(scene.lattice, at.x, at.y);
    return {F(base.column_rest) + at.x, F(base.row_rest) - at.y, weight, alive, cell};
}

/// Whether a point, in panel pixels from the panel's corner or from any other pixel's, lies where its pixel shines.
template <class F>
LFDSIM_FN Mask<F> in_opening(const Scene<Scalar<F>>& scene, F column, F row) {
    const F from = F(scene.opening.from), to = F(scene.opening.to), across = column - floor(column), down = row - floor(row);
    return (across >= from) && (across < to) && (down >= from) && (down < to);
}

/// The pixel under a point.
template <class F>
LFDSIM_FN PanelHit<F> panel_pixel(const Scene<Scalar<F>>& scene, const PanelBase<Scalar<F>>& base, const PanelPoint<F>& point) {
    const Uint<F> column = Uint<F>(base.column) + to_int(floor(point.column));
    const Uint<F> row = Uint<F>(base.row) + to_int(floor(point.row));
    const Mask<F> lit = point.alive && (column < Uint<F>(scene.columns)) && (row < Uint<F>(scene.rows));
    PanelHit<F> hit{row * Uint<F>(scene.columns) + column, point.weight, lit};
    if (!scene.opening.whole) [[unlikely]] {
        hit.lit = hit.lit && in_opening(scene, point.column, point.row);
        hit.weight = hit.weight * F(scene.opening.per * scene.opening.per);
    }
    return hit;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
