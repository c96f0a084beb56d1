// The filtered estimator: the shared footprints of a block (engine/estimator/shared_footprint.h), one or two for each stratum.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
//
// A stratum is a cell of the grid into which cut_axis() cuts the diffuser's two angles; what it spans is also a rectangle in the
// plane of the lenses' holes, in mm. Its probes go from where the ray of the block's middle meets the diffuser through points of
// that rectangle. A hole is the clear opening of a lens, or of a stop in front of it, round or the whole cell.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/estimator/limits.h"
#include "engine/estimator/probes.h"
#include "engine/estimator/shared_footprint.h"
#include "engine/kernels/filtered_axis.h"

namespace lfdsim {

namespace {

using LitFootprint = optics::LitFootprint<S>;

/// The footprints of a block through a stratum: through its hole and, where light passes there too, beside the hole.
struct SharedFootprints {
    LitFootprint through, beside;
};

/// A range of a stratum along one axis, mm from the axis of its lens.
struct StratumRange {
    S from, to;
    S middle() const { return S(0.5) * (from + to); }
    S length() const { return to - from; }
};

/// Shrinks the ranges to the bounding box of the part that a round hole covers; false: it covers none.
bool clip_to_hole(S radius, StratumRange& x, StratumRange& y) {
    auto nearest = [](StratumRange r) { return optics::min(optics::max(S(0), r.from), r.to); };
    const S near_x = nearest(x), near_y = nearest(y);
    if (near_x * near_x + near_y * near_y >= radius * radius) return false;
    const S reach_x = optics::sqrt(radius * radius - near_y * near_y), reach_y = optics::sqrt(radius * radius - near_x * near_x);
    x = {optics::max(x.from, -reach_x), optics::min(x.to, reach_x)};
    y = {optics::max(y.from, -reach_y), optics::min(y.to, reach_y)};
    return true;
}

/// Shrinks the ranges to the bounding box of the part beside a round hole; false: there is none.
bool clip_beside_hole(S radius, StratumRange& x, StratumRange& y) {
    auto farthest = [](StratumRange r) { return optics::max(optics::abs(r.from), optics::abs(r.to)); };
    const S far_x = farthest(x), far_y = farthest(y), r2 = radius * radius;
    if (far_x * far_x + far_y * far_y <= r2) return false;
    auto clip = [&](StratumRange& r, S far) {
        const S near = optics::sqrt(optics::max(r2 - far * far, S(0)));
        if (r.from > -near) r.from = optics::max(r.from, near);
        if (r.to < near) r.to = optics::min(r.to, -near);
    };
    clip(x, far_y);
    clip(y, far_x);
    return true;
}

/// Traces the footprints that the pixels of a block share.
class FootprintMaker {
  public:
    FootprintMaker(const Tile& t, const optics::PixelBlock<S>& of, const Axis (&axes)[2])
        : tile(t),
          display(*t.display),
          block(of),
          axis(axes),
          per_axis(t.strata <= 4   ? 4
                   : t.strata <= 8 ? 3
                                   : 2) {
        probes.lay_out(per_axis);
        for (int p = 0; p < optics::most_probes; ++p) {  // all of them: the last lanes of a packet trace something, too
            probes.at_x[p] = block.sweep[0][0].at;
            probes.at_y[p] = block.sweep[1][0].at;
            rays.at_x[p] = rays.at_y[p] = rays.x[p] = rays.y[p] = 0;
            grid_x[p] = (S(p % per_axis) + S(0.5)) / S(per_axis);
            grid_y[p] = (S(p / per_axis) + S(0.5)) / S(per_axis);
            counts[p] = p < per_axis * per_axis ? S(1) : S(0);
        }
    }

    /// Makes all footprints of the block, row after row of strata. False: one is unshared.
    bool make_all(SharedFootprints* footprints) {
        const int across = axis[0].strata, count = across * axis[1].strata;
        const auto unshared = [](const SharedFootprints& b) {
            return b.through.state == State::unshared || b.beside.state == State::unshared;
        };
        for (int k = 0; k < count; ++k) {
            make(footprints[k], k % across, k / across);
            if (unshared(footprints[k])) return false;
        }
        finish();
        for (int k = 0; k < count; ++k)
            if (unshared(footprints[k])) return false;
        return true;
    }

  private:
    using Footprint = optics::SharedFootprint<S>;
    using State = Footprint::State;
    using Sums = optics::NodeSums<S, optics::most_nodes * optics::most_nodes>;

    /// Makes the footprints of stratum (i, j), column i and row j, and queues the rays that follow that through the hole over the
    /// block.
    void make(SharedFootprints& b, int i, int j) {
        const S r = display.hole_radius;
        const Stratum &across = axis[0].stratum[i], &up = axis[1].stratum[j];
        b.through.state = b.beside.state = State::unlit;
        for (int side = 0; side < (display.lit_between && r > 0 ? 2 : 1); ++side) {
            const bool inside = side == 0;
            StratumRange x{across.from, across.to}, y{up.from, up.to};
            if (r > 0 && !(inside ? clip_to_hole(r, x, y) : clip_beside_hole(r, x, y))) continue;
            LitFootprint& to = inside ? b.through : b.beside;
            const Footprint shape = probe(i, x, j, y, inside, to.colour);
            to.state = shape.state;
            if (shape.state == State::unshared) return;
            if (shape.state == State::unlit) continue;
            static_cast<Footprint&>(to) = shape;
            if (inside && shape.state == State::narrow) follow(to);
        }
    }

    /// Traces the probes of a part of stratum (i, j): a grid over x and y, of which those inside the hole count, or those outside.
    void trace(int i, StratumRange x, int j, StratumRange y, bool inside) {
        const optics::Vec2<S> lens{axis[0].stratum[i].axis, axis[1].stratum[j].axis};
        const S limit = display.hole_radius > 0 ? display.hole_radius * display.hole_radius : S(1e30);
        for (int p = 0; p < optics::most_probes; ++p) {
            const S px = x.from + grid_x[p] * (x.to - x.from), py = y.from + grid_y[p] * (y.to - y.from);
            probes.x[p] = lens.x + px;
            probes.y[p] = lens.y + py;
            probes.in[p] = (px * px + py * py <= limit) == inside ? counts[p] : S(0);
        }
        optics::trace_probes<F>(display, block, probes, per_axis * per_axis);
    }

    /// Returns the footprint of a part of stratum (i, j), inside its hole or beside it. The motion of a narrow one through the hole
    /// is left to follow(); the light of a wide one at its nodes goes to `colour`.
    Footprint probe(int i, StratumRange x, int j, StratumRange y, bool inside, S (*colour)[4]) {
        trace(i, x, j, y, inside);
        Footprint b = optics::sum_up(probes, per_axis);
        if (b.state != State::narrow) return b;
        // Narrow or wide? The motion of a wide one is needed at once, as its light is looked up along it.
        const S size = optics::max(b.width, b.height);
        bool wide = size > S(FilteredLimits::narrow);
        if (wide && !display.emission.whole && size < S(FilteredLimits::masked)) {
            b.state = State::unshared;
            return b;
        }
        if (!wide) clip_to_domain(b, i, x, j, y);
        if (wide || !inside) {
            follow(b);
            finish();
            if (inside && b.state == State::unshared) return b;
            // The little light beside holes, where it moves non-linearly, counts for all pixels as from the block's middle.
            if (b.state == State::unshared) b.stationary = wide = true;
        }
        if (!wide) return b;
        b.state = State::wide;
        // Nodes, at which the light is computed. The visible part of an outermost stratum changes over the block.
        const bool ends = axis[0].stratum[i].at_edge || axis[1].stratum[j].at_edge;
        b.nodes = !b.stationary ? block.nodes() : ends ? 2 : 1;
        Sums sums;
        // Wider footprints get more probes.
        const int parts =
            b.stationary ? optics::min(FilteredLimits::most_parts, 1 + int(optics::max(b.width, b.height) * part_per_pixel)) : 1;
        for (int k = 0; k < parts * parts; ++k) {
            auto part = [parts](StratumRange r, int n) {
                const S step = (r.to - r.from) / S(parts);
                return StratumRange{r.from + S(n) * step, r.from + S(n + 1) * step};
            };
            const StratumRange here_x = part(x, k % parts), here_y = part(y, k / parts);
            if (parts > 1) trace(i, here_x, j, here_y, inside);
            add_nodes(b, i, here_x, j, here_y, sums);
        }
        b.weight = 1;  // the light at nodes includes the transmitted shares
        // Did the finer probes find no point of the part, as the first ones met only points at its edge?
        if (!sums.means(b.nodes * b.nodes, colour)) b.state = State::unshared;
        return b;
    }

    /// Reduces a narrow footprint, made by probes over all of stratum (i, j), to the part of an outermost stratum that the block's
    /// middle sees, and stores the motion of that part's middle (part_column, part_row). The map from holes to panel is taken as
    /// linear (optics::PanelSlopes); the variance of a box of width w is w^2 / 12, so squared widths subtract.
    void clip_to_domain(Footprint& b, int i, StratumRange x, int j, StratumRange y) const {
        if (!axis[0].stratum[i].at_edge && !axis[1].stratum[j].at_edge) return;
        const optics::PanelSlopes<S> slopes(probes, b);
        const StratumRange ranges[2] = {x, y};
        const int strata[2] = {i, j};
        S width = b.width * b.width, height = b.height * b.height;
        for (int a = 0; a < 2; ++a) {
            if (!axis[a].stratum[strata[a]].at_edge) continue;
            const StratumRange all = ranges[a], here = visible_part(a, strata[a], all, 0, 0),
                               right = visible_part(a, strata[a], all, 1, 0), down = visible_part(a, strata[a], all, 0, 1);
            if (!(here.length() > S(FilteredLimits::part_visible) * all.length()))
                continue;  // other pixels see parts of it that differ too much from this one
            // How far the visible part's middle is from that of the stratum, and how it moves per picture pixel; mm
            const S from_all = here.middle() - all.middle(), per = S(1) / S(block.reach),
                    moves[2] = {(right.middle() - here.middle()) * per, (down.middle() - here.middle()) * per};
            b.column = b.column + slopes.column[a] * from_all;
            b.row = b.row + slopes.row[a] * from_all;
            for (int k = 0; k < 2; ++k) {
                b.part_column[k] = b.part_column[k] + slopes.column[a] * moves[k];
                b.part_row[k] = b.part_row[k] + slopes.row[a] * moves[k];
            }
            // W^2 - slope^2 (all^2 - here^2): the variances of box and visible part differ by that of the rest.
            const S less = all.length() * all.length() - here.length() * here.length();
            width = width - slopes.column[a] * slopes.column[a] * less;
            height = height - slopes.row[a] * slopes.row[a] * less;
        }
        b.width = optics::sqrt(optics::max(width, S(0)));
        b.height = optics::sqrt(optics::max(height, S(0)));
    }

    /// Returns the ends of the domain of a pixel at (dx, dy) of the block, -1 .. 1, along axis a, mm from a stratum's lens axis.
    StratumRange ends_of(int a, int stratum, S dx, S dy) const {
        const S start = axis[a].first.at(dx, dy), end = axis[a].last.at(dx, dy), at = axis[a].stratum[stratum].axis;
        return {optics::min(start, end) - at, optics::max(start, end) - at};
    }

    /// Returns the part of a range of a stratum along axis a that a pixel at (dx, dy) of the block, -1 .. 1, sees; an empty range
    /// at the nearest end if it sees none.
    StratumRange visible_part(int a, int stratum, StratumRange r, S dx, S dy) const {
        const StratumRange visible = ends_of(a, stratum, dx, dy);
        return {optics::min(optics::max(r.from, visible.from), r.to), optics::max(optics::min(r.to, visible.to), r.from)};
    }

    /// Adds the light of the probes' boxes to the sums at the nodes, each weighted with the share of its part of the range that a
    /// pixel at the node sees.
    void add_nodes(const Footprint& b, int i, StratumRange x, int j, StratumRange y, Sums& sums) {
        optics::ProbeBoxes<S> boxes;
        boxes.make<F>(probes, per_axis);
        const bool at_edge[2] = {axis[0].stratum[i].at_edge, axis[1].stratum[j].at_edge};
        const optics::PanelLight panel = tile.panel;
        const optics::PanelBase<S> base = block.lens.panel;
        S light[optics::most_probes][4];
        const S step = b.nodes == 1 ? S(0) : S(2) / S(b.nodes - 1), first = b.nodes == 1 ? S(0) : S(-1), reach = S(block.reach);
        for (int row = 0; row < b.nodes; ++row) {
            for (int column = 0; column < b.nodes; ++column) {
                const S right = first + S(column) * step, down = first + S(row) * step;  // -1 .. 1
                const int n = row * b.nodes + column;
                if (n == 0 || !b.stationary) {  // a stationary footprint has the same light at all nodes
                    const S move = b.stationary ? S(0) : reach;
                    boxes.look<F>(probes, panel, base, (b.column_right * right + b.column_down * down) * move,
                                  (b.row_right * right + b.row_down * down) * move, light);
                }
                S visible[optics::most_probes];
                for (int p = 0; p < optics::most_probes; ++p) visible[p] = counts[p];
                if (at_edge[0]) weigh_visible(0, i, x, grid_x, right, down, visible);
                if (at_edge[1]) weigh_visible(1, j, y, grid_y, right, down, visible);
                sums.add(n, visible, light);
            }
        }
    }

    /// Multiplies `visible` of each probe by the share of its part of a range along axis a that a pixel at (dx, dy) of the block
    /// sees.
    void weigh_visible(int a, int stratum, StratumRange r, const S* places, S dx, S dy, S* visible) const {
        const StratumRange ends = ends_of(a, stratum, dx, dy);
        const S range = r.to - r.from, half = S(0.5) * range / S(per_axis);
        if (!(half > 0)) return;
        const S per = S(0.5) / half,
                least = S(FilteredLimits::least_visible);  // where no part is visible, the mean over all of it serves interpolation
        for (int p = 0; p < optics::most_probes; ++p) {
            const S middle = r.from + places[p] * range,
                    part = optics::min(ends.to, middle + half) - optics::max(ends.from, middle - half);
            visible[p] = visible[p] * optics::min(optics::max(part * per, least), S(1));
        }
    }

    /// Queues three rays from the block's points 1 .. 3 (optics::block_rays) through the footprint's point in the plane of the
    /// holes. finish() derives the footprint's motion over the block from them.
    void follow(Footprint& b) {
        for (int from = 1; from < optics::block_rays; ++from) {
            const int p = rays_each * waiting + from - 1;
            rays.at_x[p] = block.sweep[0][from].at;
            rays.at_y[p] = block.sweep[1][from].at;
            rays.x[p] = b.x;
            rays.y[p] = b.y;
        }
        followed[waiting++] = &b;
        if (waiting == most_waiting) finish();
    }
    /// Traces the queued rays, and completes the footprints that wait for them.
    void finish() {
        if (waiting > 0) optics::trace_probes<F>(display, block, rays, rays_each * waiting);
        for (int k = 0; k < waiting; ++k) {
            Footprint& b = *followed[k];
            optics::follow(b, rays, rays_each * k, block.reach);
            if (b.state != State::narrow) continue;
            b.column_right = b.column_right + b.part_column[0];
            b.row_right = b.row_right + b.part_row[0];
            b.column_down = b.column_down + b.part_column[1];
            b.row_down = b.row_down + b.part_row[1];
        }
        waiting = 0;
    }

    static constexpr S part_per_pixel = S(1) / S(FilteredLimits::pixels_a_part);
    static constexpr int rays_each = optics::block_rays - 1, most_waiting = optics::most_probes / rays_each;
    const Tile& tile;
    const optics::TracedDisplay<S>& display;
    const optics::PixelBlock<S>& block;
    const Axis (&axis)[2];
    int per_axis;  // probes along an axis of a stratum: more in coarser strata, as they also have to find what is unlit there
    S grid_x[optics::most_probes], grid_y[optics::most_probes],
        counts[optics::most_probes];  // the probes' positions in a stratum, 0 .. 1; 1 for those in use
    optics::Probes<S> probes, rays;
    Footprint* followed[most_waiting];
    int waiting = 0;
};

}  // namespace

}  // namespace lfdsim
