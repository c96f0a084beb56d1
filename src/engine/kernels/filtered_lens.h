// The filtered estimator: how a block of pixels cuts what it sees lens by lens, where lenses do not stand in rows and columns along
// the axes of the diffuser's angles.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
//
// Positions are in the plane of the holes, in the display's frame, mm from the axis of the block's base lens.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_grids.h"
#include "engine/kernels/filtered_plane.h"
#include "engine/kernels/filtered_standing.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"
#include "optics/outline.h"

namespace lfdsim {

namespace {

/// Cuts what a block sees, a grid for each lens.
class LensCutter {
  public:
    LFDSIM_BOTH LensCutter(const Tile& t, const optics::PixelBlock<S>& of, Grids& to)
        : tile(t), scene(*t.scene), block(of), standing(t, of), room(t.strata, true), plane(t, of), grids(to) {
        plane.look_at(S(0));
        if (tile.square.of_pixel) plane.of_pixel(grids.pixel);
        S beside[2] = {0, 0};
        const bool turned = tile.square.of_pixel && tile.square.divides_other && scene.has_diffuser;
        for (int k = 0; k < 4; ++k) {
            S(&aside)[2] = grids.aside[k];
            for (int a = 0; a < 2; ++a) {
                aside[a] = 0;
                S most = 1;
                if (k < 2 && scene.thin_lens) aside[a] = block.pupil_at[k][a] + scene.holes_below[a] * block.pupil_slope[k][a];
                if (k >= 2 && turned) {
                    const S slopes = block.sweep[k - 2][0].slope * block.sweep[a][0].slope;
                    aside[a] = S(optics::sense(k - 2)) * scene.holes_below[a] * (a == k - 2 ? S(1) + slopes : slopes);
                    most = S(2) * scene.half_angle[k - 2];  // more than its tangent
                }
                beside[a] = beside[a] + optics::abs(aside[a]) * most;
            }
            plane.numbers_for(-aside[0], -aside[1], grids.moved[k]);
        }
        plane.widen(beside);
    }

    /// Cuts what the block sees of each lens; false: there are too many of them, or their outlines are not known.
    LFDSIM_BOTH bool cut() {
        using optics::floor;
        const Lattice<S>& lattice = scene.lattice;
        grids.count = grids.strata = 0;
        cuts = 0;
        // The parts of a pixel are to see the edge of a round hole as straight, or else the hole as a polygon.
        bool polygon = false;
        if (tile.square.of_pixel && scene.hole_radius > 0 && !scene.leaky) {
            const S(&to)[2][2] = grids.pixel;
            const S most = S(FilteredLimits::straight) * scene.hole_radius * S(tile.square.parts);
            polygon =
                !(optics::abs(to[0][0]) + optics::abs(to[1][0]) < most && optics::abs(to[0][1]) + optics::abs(to[1][1]) < most);
        }
        // Where lenses stand by themselves, all do about as the base lens does, at most a cell more or less.
        S beyond[optics::most_corners] = {};
        grids.clear = standing.clear_beyond(beyond);
        const bool given = scene.placement.given, aside_of_cell = given || grids.clear;
        const S more = aside_of_cell ? S(0.5) : S(0), around = aside_of_cell ? S(1) : S(0);
        S up = 0;
        const auto off = given ? standing.off({S(0), S(0)}, plane.middle().y, up) : optics::Place<S>{S(0), S(0)};
        if (up != plane.raised) plane.look_at(up);
        // The block's view in the array's frame.
        const S half[2] = {S(0.5) * (plane.high[0] - plane.low[0]), S(0.5) * (plane.high[1] - plane.low[1])};
        const S c = optics::abs(lattice.cos_turn), s = optics::abs(lattice.sin_turn);
        const optics::Place<S> at = plane.middle();
        const S half_x = c * half[0] + s * half[1], half_y = s * half[0] + c * half[1];
        reach_along = half_x + half_y;
        const optics::Outline<S> cell = polygon ? optics::outline_of_circle(scene.hole_radius)
                                        : grids.clear && !lattice.strips
                                            ? standing.own_cell({S(0), S(0)}, {S(0), S(0)}, S(0), false, beyond)
                                            : optics::outline_of(lattice, scene.hole_half, reach_along);
        S extent[2] = {scene.hole_radius, scene.hole_radius};
        outlined = polygon || scene.hole_radius == 0 || scene.leaky;
        if (outlined) {
            extent[0] = extent[1] = 0;
            for (int k = 0; k < cell.corners; ++k) {
                extent[0] = optics::max(extent[0], optics::abs(cell.corner[k].x));
                extent[1] = optics::max(extent[1], optics::abs(cell.corner[k].y));
            }
        }
        // Filled lenses that stand nearer than a pitch share what both would cover.
        const bool overlap = scene.placement.lens && scene.hole_radius == 0 && scene.hole_half == lattice.half_pitch[0];
        const S reach_y = optics::reach_of_cell(lattice);
        const S first_j = lattice.strips ? S(0) : floor((at.y - off.y - half_y - reach_y) * lattice.per_pitch[1] + S(1)) - around,
                last_j = lattice.strips ? S(0) : floor((at.y - off.y + half_y + reach_y) * lattice.per_pitch[1]) + around;
        const S rows = last_j - first_j + S(1), columns = S(2) * half_x * lattice.per_pitch[0] + S(2);
        const bool near = optics::abs(at.x) * lattice.per_pitch[0] + optics::abs(first_j) < S(1e6);  // exact whole numbers
        if (!(near && rows * columns < S(8 * room.grids))) return false;
        for (S j = first_j; j <= last_j; ++j) {
            const S row_off = lattice.staggered ? optics::stagger(lattice, j) : S(0), from = at.x - off.x - row_off;
            const S first_i = floor((from - half_x) * lattice.per_pitch[0] + S(0.5) - more),
                    last_i = floor((from + half_x) * lattice.per_pitch[0] + S(0.5) + more);
            for (S i = first_i; i <= last_i; ++i) {
                const optics::Cell<S> lens{i, j};
                if (!scene.leaky && !block.lens.extent.holds(lens)) continue;
                optics::Place<S> axis = optics::axis_of(lattice, lens), aside{S(0), S(0)};
                if (lattice.strips) axis.y = at.y;  // any point of it serves, here one in the middle of the block's view
                if (given) {
                    aside = standing.off(lens, at.y, up);
                    axis = {axis.x + aside.x, axis.y + aside.y};
                    if (up != plane.raised) plane.look_at(up);
                }
                S half_width = scene.hole_half;
                if (lattice.strips && (overlap || grids.clear)) {
                    S left = overlap ? standing.overlap(lens, aside, at.y, 0, S(-1)) : S(0),
                      right = overlap ? standing.overlap(lens, aside, at.y, 0, S(1)) : S(0);
                    if (grids.clear) {
                        right = right - beyond[0];
                        left = left - beyond[1];
                    }
                    axis.x = axis.x + S(0.5) * (left - right);
                    half_width = half_width - S(0.5) * (left + right);
                }
                axis = optics::to_display(lattice, axis.x, axis.y);
                const bool added = lattice.strips ? add_strips(axis, half_width)
                                   : overlap      ? add(axis, standing.own_cell(lens, aside, at.y, true, beyond), extent)
                                                  : add(axis, cell, extent);
                if (!added) return false;
            }
        }
        return true;
    }

  private:
    /// Adds the grid of the lens whose axis is there, which reaches as far as `extent`; false: no room.
    LFDSIM_BOTH bool add(optics::Place<S> axis, const optics::Outline<S>& cell, const S (&extent)[2]) {
        const S at[2] = {axis.x, axis.y};
        for (int a = 0; a < 2; ++a)
            if (!(at[a] - extent[a] < plane.high[a] && at[a] + extent[a] > plane.low[a])) return true;
        if (grids.count == room.grids) return false;
        Grid& grid = grids.grid[grids.count];
        grid.first = grids.strata;
        grid.narrow = false;
        grid.raised = plane.raised;
        grid.strip = -1;
        for (int a = 0; a < 2; ++a) {
            const S size = S(2) * extent[a],
                    seen = optics::min(at[a] + extent[a], plane.high[a]) - optics::max(at[a] - extent[a], plane.low[a]);
            S wanted = S(tile.strata) * optics::min(size, S(2) * seen) / optics::max(plane.span[a], S(1e-12));
            wanted = whole(wanted);
            if (!cut_axis(grid.axis[a], a, at[a], extent[a], size / wanted)) return false;
            grid.narrow = grid.narrow || plane.span[a] * wanted < S(FilteredLimits::narrow) * size;
        }
        grid.corners = 0;
        if (outlined) outline(grid, axis, cell);
        return count(grid);
    }

    /// Adds the grid of the strip on whose middle that point lies, and where light goes on between strips those of both sides of
    /// it; false: no room.
    LFDSIM_BOTH bool add_strips(optics::Place<S> axis, S half) {
        const Lattice<S>& lattice = scene.lattice;
        const S gap = S(0.5) * (lattice.half_pitch[0] - scene.hole_half);
        for (int side = -1; side <= 1; ++side) {
            if (side != 0 && !(scene.leaky && gap > S(0))) continue;
            const optics::Place<S> aside = optics::to_display(lattice, S(side) * (scene.hole_half + gap), S(0));
            if (!add_strip({axis.x + aside.x, axis.y + aside.y}, side == 0 ? half : gap)) return false;
        }
        return true;
    }

    /// Adds the grid of a strip on whose middle that point lies and which is `half` wide to each side of it; false: no room.
    LFDSIM_BOTH bool add_strip(optics::Place<S> axis, S half) {
        const S c = scene.lattice.cos_turn, s = scene.lattice.sin_turn;
        const int along = optics::abs(c) >= optics::abs(s) ? 1 : 0, across = 1 - along;
        const S at[2] = {axis.x, axis.y}, lean = along == 1 ? -s / c : -c / s;
        const S extent = half / optics::max(optics::abs(c), optics::abs(s));
        const S sideways = optics::abs(lean) * (plane.high[along] - plane.low[along]);
        if (!(at[across] - extent - sideways < plane.high[across] && at[across] + extent + sideways > plane.low[across]))
            return true;
        if (grids.count == room.grids) return false;
        Grid& grid = grids.grid[grids.count];
        grid.first = grids.strata;
        grid.raised = plane.raised;
        grid.strip = along;
        grid.lean = lean;
        grid.against = along == 1 ? c < 0 : s < 0;
        // So many parts along the strip that a footprint, which leans as the strip does, is at most a panel pixel wide. On the
        // panel a part is longer by as much as rays from a point of the diffuser diverge.
        const S diverging = S(tile.view->start_z) / optics::max(scene.holes_below[along], S(1e-6));
        const S rows = whole(optics::max(S(tile.strata), optics::abs(lean) * plane.span[along] * diverging * scene.pixels_per_mm)),
                columns = whole(S(tile.strata) * S(2) * extent / optics::max(plane.span[across], S(1e-12)));
        grid.narrow = plane.span[across] * columns < S(FilteredLimits::narrow) * S(2) * extent;
        if (cuts + int(rows) + int(columns) + 2 > room.cuts) return false;
        Axis &length = take(grid.axis[along], along, int(rows)), &width = take(grid.axis[across], across, int(columns));
        length.moving = true;
        for (int k = 0; k <= length.strata; ++k) {
            const S number = S(2 * k - length.strata) / rows;
            length.cut[k] = {{{number, 0, 0}, 0}, plane.place_of(along, optics::diffuser_tangent(scene, along, number))};
        }
        for (int k = 0; k < length.strata; ++k) {
            const S here = length.cut[k].place.middle - at[along], there = length.cut[k + 1].place.middle - at[along];
            length.stratum[k] = {at[along], optics::min(here, there), optics::max(here, there), false, false};
        }
        const S reach = plane.first[across].reach(), step = S(2) * extent / columns;
        for (int k = 0; k < width.strata; ++k) {
            const S from = S(k) * step - extent, to = from + step, here = at[across] + from - S(0.5) * sideways,
                    there = at[across] + to + S(0.5) * sideways;
            width.stratum[k] = {at[across], from, to, false,
                                here < plane.low[across] + S(2) * reach || there > plane.high[across] - S(2) * reach};
        }
        if (plane.flat())
            outline(grid, axis, optics::outline_of(scene.lattice, half, reach_along));
        else
            outline_of_strip(grid, at, extent);
        return count(grid);
    }

    /// The numbers of the corners of a strip, in the order of optics::outline_of: at the ends of the diffuser's angles along it,
    /// and as much further as the pupil moves them. It runs on, but far away its edges would not be straight in these numbers.
    LFDSIM_BOTH void outline_of_strip(Grid& grid, const S (&at)[2], S extent) const {
        const int along = grid.strip, across = 1 - along;
        const bool upwards = along == 1 ? scene.lattice.cos_turn > S(0) : scene.lattice.sin_turn < S(0);
        const S most = S(1) + optics::abs(grids.moved[0][along]) + optics::abs(grids.moved[1][along]);
        grid.corners = 4;
        for (int k = 0; k < 4; ++k) {
            const bool right = k < 2, upper = k == 1 || k == 2;
            const S end = (upper == upwards ? plane.rising[along] : -plane.rising[along]) * most,
                    side = right != grid.against ? extent : -extent;
            S number[3], place[3];
            for (int ray = 0; ray < 3; ++ray) {
                place[ray] = at[across] + grid.lean * (plane.place_at(along, ray, end) - at[along]) + side;
                number[ray] = plane.number_at(across, ray, place[ray]);
            }
            grid.corner[k][along] = {{end, 0, 0}, 0};
            grid.corner[k][across] = plane.bent(across, place[0], number);
        }
    }

    /// Do pixels cut the whole square at the lens's outline?
    LFDSIM_BOTH bool whole_square() const { return tile.square.weak && (tile.square.of_pixel || scene.hole_radius == 0); }

    /// A whole number of strata that an axis may have.
    LFDSIM_BOTH S whole(S wanted) const {
        if (tile.square.weak) return 1;
        return optics::min(optics::max(-optics::floor(S(1e-3) - wanted), S(1)), S(room.an_axis));
    }
    /// Takes memory for an axis of so many strata.
    LFDSIM_BOTH Axis& take(Axis& axis, int a, int strata) {
        axis.strata = strata;
        axis.moving = false;
        axis.first = plane.first[a];
        axis.last = plane.last[a];
        axis.square = plane.square[a];
        axis.cube = plane.cube[a];
        axis.cut = grids.cut + cuts;
        axis.stratum = grids.stratum + cuts;
        cuts += strata + 1;
        return axis;
    }
    /// The numbers of the corners of a cell about that axis.
    LFDSIM_BOTH void outline(Grid& grid, optics::Place<S> axis, const optics::Outline<S>& cell) const {
        grid.corners = cell.corners;
        for (int k = 0; k < grid.corners; ++k) {
            const S place[2] = {axis.x + cell.corner[k].x, axis.y + cell.corner[k].y};
            plane.numbers_of(place, grid.corner[k]);
        }
    }
    /// Counts a grid that is done; false: no room for its strata.
    LFDSIM_BOTH bool count(const Grid& grid) {
        if (grids.strata + grid.strata() > room.strata) return false;
        grids.strata += grid.strata();
        ++grids.count;
        return true;
    }
    /// Cuts an axis of a grid every `step` mm from the lens's rim on, as far as the block sees it.
    LFDSIM_BOTH bool cut_axis(Axis& to, int a, S axis, S extent, S step) {
        const S from = axis - plane.rising[a] * extent;  // where the numbers are least
        const S start = plane.rising[a] > 0 ? plane.low[a] : plane.high[a],
                end = plane.rising[a] > 0 ? plane.high[a] : plane.low[a];
        const S skipped = optics::max(optics::floor(plane.rising[a] * (start - from) / step), S(0));
        const S stop =
            optics::min(-optics::floor(-plane.rising[a] * (end - from) / step), -optics::floor(S(1e-3) - S(2) * extent / step));
        const int strata = optics::max(int(stop - skipped), 1);
        if (strata > room.an_axis || cuts + strata + 1 > room.cuts) return false;
        take(to, a, strata);
        for (int k = 0; k <= strata; ++k) {
            const S place = from + plane.rising[a] * (skipped + S(k)) * step;
            Cut& cut = to.cut[k];
            cut.place = {place, 0, 0};
            cut.number = whole_square() ? Number{{S(2 * k - strata) / S(strata), 0, 0}, 0} : plane.number_of(a, place);
        }
        for (int k = 0; k < strata; ++k) {
            const Gradient &lower = to.cut[k].number.linear, &upper = to.cut[k + 1].number.linear;
            const S here = to.cut[k].place.middle - axis, there = to.cut[k + 1].place.middle - axis;
            to.stratum[k] = {axis, optics::min(here, there), optics::max(here, there), false,
                             lower.middle - lower.reach() < S(-1) || upper.middle + upper.reach() > S(1)};
        }
        return true;
    }

    const Tile& tile;
    const optics::Scene<S>& scene;
    const optics::PixelBlock<S>& block;
    const StandingLenses standing;
    const Room room;
    SeenPlane plane;  // of the lens at hand
    Grids& grids;
    int cuts = 0;
    S reach_along = 0;
    bool outlined = true;  // are corners what pixels see of a lens?
};

}  // namespace

}  // namespace lfdsim
