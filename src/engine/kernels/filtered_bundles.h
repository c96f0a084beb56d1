// The filtered estimator: makes the bundles of a block (optics/bundle.h), one or two for each stratum.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
//
// A stratum is a cell of the grid into which cut_axis() cuts the diffuser's two angles; what it spans is also a rectangle in the
// plane of the lenses' holes, in mm. Its probes go from where the ray of the block's middle meets the diffuser through points of
// that rectangle. A hole is the clear opening of a lens, or of a stop in front of it, round or the whole cell.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_blur.h"
#include "engine/kernels/filtered_grids.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"
#include "optics/strata.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

/// What a block sees through a stratum: through its hole and, where light passes there too, beside the hole.
struct Bundles {
    SharedBundle through, beside;
    bool straddles;         // the stratum sees other lenses too
    Blur blur[most_blurs];  // where pixels trace their own rays behind a weak diffuser or none
};

/// Do pixels trace their own rays where footprints are wide? With many strata and the smallest blocks: interpolating the light over
/// such a block would blur details of the picture, and the pixels' own rays cost no more there.
LFDSIM_BOTH bool fine_alone(const Tile& tile, const optics::Scene<S>& scene) {
    return tile.strata > 2 * few_strata && tile.block_side <= FilteredLimits::place_step && !scene.leaky;
}

/// A range of a stratum along one axis, mm from the axis of its lens.
struct Range {
    S from, to;
    LFDSIM_BOTH S middle() const { return S(0.5) * (from + to); }
    LFDSIM_BOTH S length() const { return to - from; }
};

/// Shrinks the ranges to the bounding box of the part that a round hole covers; false: it covers none.
LFDSIM_BOTH bool clip_to_hole(S radius, Range& x, Range& y) {
    auto nearest = [](Range r) { return optics::min(optics::max(S(0), r.from), r.to); };
    const S near_x = nearest(x), near_y = nearest(y);
    if (near_x * near_x + near_y * near_y >= radius * radius) return false;
    const S reach_x = optics::sqrt(radius * radius - near_y * near_y), reach_y = optics::sqrt(radius * radius - near_x * near_x);
    x = {optics::max(x.from, -reach_x), optics::min(x.to, reach_x)};
    y = {optics::max(y.from, -reach_y), optics::min(y.to, reach_y)};
    return true;
}

/// Shrinks the ranges to the bounding box of the part beside a round hole; false: there is none.
LFDSIM_BOTH bool clip_beside_hole(S radius, Range& x, Range& y) {
    auto farthest = [](Range r) { return optics::max(optics::abs(r.from), optics::abs(r.to)); };
    const S far_x = farthest(x), far_y = farthest(y), r2 = radius * radius;
    if (far_x * far_x + far_y * far_y <= r2) return false;
    auto clip = [&](Range& r, S far) {
        const S near = optics::sqrt(optics::max(r2 - far * far, S(0)));
        if (r.from > -near) r.from = optics::max(r.from, near);
        if (r.to < near) r.to = optics::min(r.to, -near);
    };
    clip(x, far_y);
    clip(y, far_x);
    return true;
}

template <optics::Way through>
class BundleMaker {
  public:
    LFDSIM_BOTH BundleMaker(const Tile& t, const optics::PixelBlock<S>& of)
        : tile(t),
          scene(*t.scene),
          block(of),
          per_axis(t.strata <= 4   ? 4
                   : t.strata <= 8 ? 3
                                   : 2) {
        probes.lay_out(per_axis);
        for (int p = 0; p < optics::probes_each; ++p) {  // all of them: the last lanes of a packet trace something, too
            probes.at_x[p] = block.sweep[0][0].at;
            probes.at_y[p] = block.sweep[1][0].at;
            rays.at_x[p] = rays.at_y[p] = rays.x[p] = rays.y[p] = 0;
            const int number = optics::probe_number(p);
            grid_x[p] = (S(number % per_axis) + S(0.5)) / S(per_axis);
            grid_y[p] = (S(number / per_axis) + S(0.5)) / S(per_axis);
            counts[p] = number < per_axis * per_axis ? S(1) : S(0);
        }
    }

    /// All bundles of the block, grid after grid and row after row.
    LFDSIM_BOTH void make_all(const Grids& grids, Bundles* bundles) {
        Bundles* next = bundles;
        for (int k = 0; k < grids.count; ++k) {
            use(grids.grid[k]);
            for (int j = 0; j < axis[1].strata; ++j)
                for (int i = 0; i < axis[0].strata; ++i) start(*next++, i, j);
        }
        finish();
        while (bundles != next) settle(*bundles++);
    }
    /// The bundles of a grid's stratum (i, j).
    LFDSIM_BOTH void make(Bundles& b, const Grid& of, int i, int j) {
        use(of);
        start(b, i, j);
        finish();
        settle(b);
    }

  private:
    using Shape = optics::BundleShape<S>;
    using State = Shape::State;
    static constexpr bool follows_at_once = optics::probe_threads > 1;  // else the rays of several bundles are traced together
    using Sums = optics::NodeSums<S, optics::most_nodes * optics::most_nodes>;

    LFDSIM_BOTH void use(const Grid& of) {
        grid = &of;
        axis = of.axis;
    }

    /// Where the bundle through the hole is broken, the pixels' own rays also cover what lies beside the hole.
    LFDSIM_BOTH static void settle(Bundles& b) {
        if (b.through.state == State::broken) b.beside.state = State::dark;
    }

    /// Traces the probes of stratum (i, j), column i and row j, and queues the rays that follow sharp bundles over the block.
    LFDSIM_BOTH void start(Bundles& b, int i, int j) {
        const S r = scene.hole_radius;
        const Stratum &across = axis[0].stratum[i], &up = axis[1].stratum[j];
        const Range x{across.from, across.to}, y{up.from, up.to};
        aside[0] = grid->strip == 1 ? grid->lean * y.middle() : S(0);
        aside[1] = grid->strip == 0 ? grid->lean * x.middle() : S(0);
        Range hole_x = x, hole_y = y;
        const bool straddles = across.straddles || up.straddles;
        b.straddles = straddles;
        b.through.state = b.beside.state = State::dark;
        if (scene.by_lens && tile.square.weak) {
            b.through.state = State::broken;
            const int squares = blurs_an_axis(tile);
            if (scene.thin_lens || (scene.box_filter && scene.has_diffuser))
                for (int n = 0; n < squares * squares; ++n)
                    b.blur[n] = blur_alone<through>(tile, block, n, *grid, across, up, rays);
            return;
        }
        if (straddles || (r > 0 && hole_edge_near(x, y))) {
            b.through.state = State::broken;
            return;
        }
        for (int side = 0; side < (scene.leaky && r > 0 ? 2 : 1); ++side) {
            const bool inside = side == 0;
            SharedBundle& to = inside ? b.through : b.beside;
            Shape shape;
            shape.state = State::dark;
            hole_x = x, hole_y = y;
            if (r == 0 || (inside ? clip_to_hole(r, hole_x, hole_y) : clip_beside_hole(r, hole_x, hole_y)))
                shape = probe(i, hole_x, j, hole_y, inside, to.colour);
            // Where a stop hides the panel from the middle of a block, other pixels may see through it.
            if (inside && shape.state == State::dark && scene.has_stop && (axis[0].moving || axis[1].moving))
                shape.state = State::broken;
            to.state = shape.state;
            if (shape.state == State::dark || shape.state == State::broken) continue;
            static_cast<Shape&>(to) = shape;
            if (!follows_at_once && shape.state == State::sharp) follow(to);
        }
    }

    /// Do some pixels see a moving stratum inside the hole and others outside?
    LFDSIM_BOTH bool hole_edge_near(Range x, Range y) const {
        if (!axis[0].moving && !axis[1].moving) return false;
        const S mid_x = S(0.5) * (x.from + x.to), mid_y = S(0.5) * (y.from + y.to), move_x = axis[0].first.reach() + x.to - mid_x,
                move_y = axis[1].first.reach() + y.to - mid_y;
        const S far = optics::sqrt(mid_x * mid_x + mid_y * mid_y), move = optics::sqrt(move_x * move_x + move_y * move_y);
        return optics::abs(far - scene.hole_radius) < move;
    }

    /// Traces the probes of a part of stratum (i, j): a grid over x and y, of which those inside the hole count, or those outside.
    LFDSIM_BOTH void trace(int i, Range x, int j, Range y, bool inside) {
        const optics::Place<S> lens{axis[0].stratum[i].axis, axis[1].stratum[j].axis};
        const S limit = scene.hole_radius > 0 ? scene.hole_radius * scene.hole_radius : S(1e30);
        for (int p = 0; p < optics::probes_each; ++p) {
            const S px = x.from + grid_x[p] * (x.to - x.from), py = y.from + grid_y[p] * (y.to - y.from);
            probes.x[p] = lens.x + px;
            probes.y[p] = lens.y + py;
            probes.in[p] = (px * px + py * py <= limit) == inside ? counts[p] : S(0);
        }
        if (grid->strip == 1)
            for (int p = 0; p < optics::probes_each; ++p) probes.x[p] = probes.x[p] + grid->lean * (probes.y[p] - lens.y);
        else if (grid->strip == 0)
            for (int p = 0; p < optics::probes_each; ++p) probes.y[p] = probes.y[p] + grid->lean * (probes.x[p] - lens.x);
        else if (grid->corners > 0)
            for (int p = 0; p < optics::probes_each; ++p) {
                const optics::Place<S> at = optics::to_array(scene.lattice, probes.x[p] - lens.x, probes.y[p] - lens.y);
                if (!optics::in_cell(scene.lattice, at.x, at.y)) probes.in[p] = 0;
            }
        const S below[2] = {scene.holes_below[0] - grid->raised, scene.holes_below[1] - grid->raised};
        optics::trace_probes<through, F>(scene, block, probes, per_axis * per_axis, below);
    }

    /// The bundle of a part of stratum (i, j), inside its hole or beside it. The motion of sharp ones may be left to follow(); the
    /// light of soft ones goes to `colour`.
    LFDSIM_BOTH Shape probe(int i, Range x, int j, Range y, bool inside, S (*colour)[4]) {
        trace(i, x, j, y, inside);
        Shape b = optics::sum_up(probes, per_axis);
        if (b.state != State::sharp) return b;
        bool soft = optics::is_soft(scene, b);
        const bool uneven = !scene.emission.whole && optics::max(b.width, b.height) < S(FilteredLimits::masked);
        if (soft && (fine_alone(tile, scene) || grid->narrow || uneven)) {
            b.state = State::broken;
            return b;
        }
        if (!soft) lean(b, i, x, j, y);
        if (soft || !inside || follows_at_once) {
            follow(b);
            finish();
        }
        // The little light beside holes, where it moves unevenly, counts as the block's middle sees it.
        if (!inside && b.state == State::broken) {
            b.state = State::soft;
            b.still = soft = true;
        }
        if (!soft || b.state == State::broken) return b;
        if (scene.by_lens && !b.still && runs_away(b)) {
            b.state = State::broken;
            return b;
        }
        b.state = State::soft;
        // The part of an outermost stratum that a pixel sees changes over the block.
        const bool ends = axis[0].stratum[i].cut_off || axis[1].stratum[j].cut_off;
        b.nodes = !b.still ? block.nodes() : ends ? 2 : 1;
        Sums sums;
        // Wider footprints get more probes.
        const int parts =
            b.still ? optics::min(FilteredLimits::most_parts, 1 + int(optics::max(b.width, b.height) * part_per_pixel)) : 1;
        for (int k = 0; k < parts * parts; ++k) {
            auto part = [parts](Range r, int n) {
                const S step = (r.to - r.from) / S(parts);
                return Range{r.from + S(n) * step, r.from + S(n + 1) * step};
            };
            const Range here_x = part(x, k % parts), here_y = part(y, k / parts);
            if (parts > 1) trace(i, here_x, j, here_y, inside);
            add_nodes(b, i, here_x, j, here_y, sums);
        }
        b.weight = 1;
        // Did the first probes meet only points at the edge of the part?
        if (!sums.means(b.nodes * b.nodes, colour)) b.state = State::broken;
        return b;
    }

    /// Does a soft footprint move by more than its own size from node to node, so that its light there tells nothing of that in
    /// between? Along a strip it does, as the camera's pixels do.
    LFDSIM_BOTH static bool runs_away(const Shape& b) {
        const S step = S(FilteredLimits::node_step);
        return step * (optics::abs(b.column_right) + optics::abs(b.column_down)) > b.width ||
               step * (optics::abs(b.row_right) + optics::abs(b.row_down)) > b.height;
    }

    /// Pixels see only parts of the outermost strata. Reduces a sharp footprint, made by probes over all of stratum (i, j), to what
    /// the block's middle sees, and adds the motion of the seen part's middle to that of the bundle (lean). The map from holes to
    /// panel is taken as linear (optics::Slopes); the variance of a box of width w is w^2 / 12, so squared widths subtract.
    LFDSIM_BOTH void lean(Shape& b, int i, Range x, int j, Range y) const {
        if (!axis[0].stratum[i].cut_off && !axis[1].stratum[j].cut_off) return;
        const optics::Slopes<S> slopes(probes, b);
        const Range ranges[2] = {x, y};
        const int strata[2] = {i, j};
        S width = b.width * b.width, height = b.height * b.height;
        for (int a = 0; a < 2; ++a) {
            if (!axis[a].stratum[strata[a]].cut_off) continue;
            const Range all = ranges[a], here = seen_of(a, strata[a], all, 0, 0), right = seen_of(a, strata[a], all, 1, 0),
                        down = seen_of(a, strata[a], all, 0, 1);
            if (!(here.length() > S(FilteredLimits::part_seen) * all.length()))
                continue;  // other pixels see parts of it that differ too much from this one
            const S from_all = here.middle() - all.middle(), per = S(1) / S(block.reach),
                    moves[2] = {(right.middle() - here.middle()) * per, (down.middle() - here.middle()) * per};
            b.column = b.column + slopes.column[a] * from_all;
            b.row = b.row + slopes.row[a] * from_all;
            for (int k = 0; k < 2; ++k) {
                b.lean_column[k] = b.lean_column[k] + slopes.column[a] * moves[k];
                b.lean_row[k] = b.lean_row[k] + slopes.row[a] * moves[k];
            }
            const S less = all.length() * all.length() - here.length() * here.length();
            width = width - slopes.column[a] * slopes.column[a] * less;
            height = height - slopes.row[a] * slopes.row[a] * less;
        }
        b.width = optics::sqrt(optics::max(width, S(0)));
        b.height = optics::sqrt(optics::max(height, S(0)));
    }

    /// The part of a range of a stratum along axis a that a pixel at (dx, dy) of the block, -1 .. 1, sees; an empty range at the
    /// nearest end if it sees none.
    LFDSIM_BOTH Range seen_of(int a, int stratum, Range r, S dx, S dy) const {
        const Gradient &first = axis[a].first, &last = axis[a].last;
        const S start = first.middle + first.right * dx + first.down * dy, end = last.middle + last.right * dx + last.down * dy,
                at = axis[a].stratum[stratum].axis + aside[a], low = optics::min(start, end) - at,
                high = optics::max(start, end) - at;
        return {optics::min(optics::max(r.from, low), r.to), optics::max(optics::min(r.to, high), r.from)};
    }

    /// Adds the light of the probes' boxes to the sums at the nodes, each weighted with the share of its part of the range that a
    /// pixel at the node sees.
    LFDSIM_BOTH void add_nodes(const Shape& b, int i, Range x, int j, Range y, Sums& sums) {
        optics::ProbeBoxes<S> boxes;
        boxes.make<F>(probes, per_axis);
        if (b.blur_width > 0 || b.blur_height > 0) boxes.blur(b.blur_width, b.blur_height);
        const bool cut_off[2] = {axis[0].stratum[i].cut_off, axis[1].stratum[j].cut_off};
        const optics::PanelLight panel = tile.panel;
        const optics::PanelBase<S> base = block.lens.panel;
        S light[optics::probes_each][4];
        const S step = b.nodes == 1 ? S(0) : S(2) / S(b.nodes - 1), first = b.nodes == 1 ? S(0) : S(-1), reach = S(block.reach);
        for (int row = 0; row < b.nodes; ++row) {
            for (int column = 0; column < b.nodes; ++column) {
                const S right = first + S(column) * step, down = first + S(row) * step;  // -1 .. 1
                const int n = row * b.nodes + column;
                if (n == 0 || !b.still) {
                    const S move = b.still ? S(0) : reach;
                    boxes.look<F>(probes, panel, base, (b.column_right * right + b.column_down * down) * move,
                                  (b.row_right * right + b.row_down * down) * move, light);
                }
                S seen[optics::probes_each];
                for (int p = 0; p < optics::probes_each; ++p) seen[p] = counts[p];
                if (cut_off[0]) narrow(0, i, x, grid_x, right, down, seen);
                if (cut_off[1]) narrow(1, j, y, grid_y, right, down, seen);
                sums.add(n, seen, light);
            }
        }
    }

    /// Multiplies `seen` of each probe by the share of its part of a range along axis a that a pixel at (dx, dy) of the block sees.
    LFDSIM_BOTH void narrow(int a, int stratum, Range r, const S* places, S dx, S dy, S* seen) const {
        const Gradient &first = axis[a].first, &last = axis[a].last;
        const S start = first.middle + first.right * dx + first.down * dy, end = last.middle + last.right * dx + last.down * dy,
                at = axis[a].stratum[stratum].axis + aside[a], low = optics::min(start, end) - at,
                high = optics::max(start, end) - at;
        const S range = r.to - r.from, half = S(0.5) * range / S(per_axis);
        if (!(half > 0)) return;
        const S per = S(0.5) / half,
                least = S(FilteredLimits::least_seen);  // where nothing is seen, the mean over all of it serves interpolation
        for (int p = 0; p < optics::probes_each; ++p) {
            const S middle = r.from + places[p] * range, part = optics::min(high, middle + half) - optics::max(low, middle - half);
            seen[p] = seen[p] * optics::min(optics::max(part * per, least), S(1));
        }
    }

    /// Queues three rays from the block's points 1 .. 3 (optics::block_rays) through the bundle's point in the plane of the holes,
    /// which moves with the pixels where strata do. finish() derives the bundle's motion over the block from them.
    LFDSIM_BOTH void follow(Shape& b) {
        const int each = rays_each();
        for (int from = 1; from < optics::block_rays; ++from) {
            const int p = each * waiting + from - 1;
            auto shift = [&](const Axis& a) {
                const Gradient& g = a.first;
                return a.moving ? g.right * S(optics::block_right(from)) + g.down * S(optics::block_down(from)) : S(0);
            };
            const S right = shift(axis[0]), up = shift(axis[1]);
            aim(p, block.sweep[0][from].at, block.sweep[1][from].at, b.x + right + (grid->strip == 1 ? grid->lean * up : S(0)),
                b.y + up + (grid->strip == 0 ? grid->lean * right : S(0)));
        }
        for (int k = 0; k < 2 && scene.thin_lens; ++k)
            aim(each * waiting + 3 + k, block.sweep[0][0].at + block.pupil_at[k][0], block.sweep[1][0].at + block.pupil_at[k][1],
                b.x, b.y);
        if constexpr (follows_at_once) {
            optics::trace_probes<through, F>(scene, block, rays, each, scene.holes_below);
            return complete(b, 0);
        }
        followed[waiting++] = &b;
        if ((waiting + 1) * each > optics::most_probes) finish();
    }
    /// Queued ray p goes from there in the diffuser's plane to a place (x, y) of the grid's, and on to the plane of the holes.
    LFDSIM_BOTH void aim(int p, S from_x, S from_y, S x, S y) {
        const auto below = [&](int a, S from, S place) {
            const S height = scene.holes_below[a];
            return grid->raised == S(0) ? place : from + (place - from) * (height / (height - grid->raised));
        };
        optics::set_probe(rays.at_x, p, from_x);
        optics::set_probe(rays.at_y, p, from_y);
        optics::set_probe(rays.x, p, below(0, from_x, x));
        optics::set_probe(rays.y, p, below(1, from_y, y));
    }
    /// Traces the queued rays, and completes the bundles that wait for them.
    LFDSIM_BOTH void finish() {
        const int each = rays_each();
        if (waiting > 0) optics::trace_probes<through, F>(scene, block, rays, each * waiting, scene.holes_below);
        for (int k = 0; k < waiting; ++k) complete(*followed[k], each * k);
        waiting = 0;
    }
    /// By rays p, p + 1, ...
    LFDSIM_BOTH void complete(Shape& b, int p) const {
        optics::follow(b, rays, p, block.reach);
        if (b.state != State::sharp) return;
        b.column_right = b.column_right + b.lean_column[0];
        b.row_right = b.row_right + b.lean_row[0];
        b.column_down = b.column_down + b.lean_column[1];
        b.row_down = b.row_down + b.lean_row[1];
        if (scene.box_filter || scene.thin_lens) {
            optics::blur(scene, b, rays, p + 3);
            b.width = optics::sqrt(b.width * b.width + b.blur_width);
            b.height = optics::sqrt(b.height * b.height + b.blur_height);
        }
    }

    static constexpr S part_per_pixel = S(1) / S(FilteredLimits::pixels_a_part);
    /// Rays that follow a bundle over the block, and over the pupil.
    LFDSIM_BOTH int rays_each() const { return scene.thin_lens ? 5 : 3; }

    static constexpr int most_waiting = optics::most_probes / 3;
    const Tile& tile;
    const optics::Scene<S>& scene;
    const optics::PixelBlock<S>& block;
    const Grid* grid = nullptr;
    const Axis* axis = nullptr;  // the grid's
    S aside[2];                  // of a strip: how far its axis has leant aside in the stratum at hand
    int per_axis;  // probes along an axis of a stratum: more in coarser strata, as they also have to find what is dark there
    S grid_x[optics::probes_each], grid_y[optics::probes_each],
        counts[optics::probes_each];  // the probes' positions in a stratum, 0 .. 1; 1 for those in use
    optics::Probes<S> probes, rays;
    Shape* followed[most_waiting];
    int waiting = 0;
};

}  // namespace

}  // namespace lfdsim
