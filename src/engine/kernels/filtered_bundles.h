// The filtered estimator: the bundles of a block.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernels/filtered_axis.h"
#include "optics/footprint.h"

namespace lfdsim {

namespace {

using Bundle = optics::Bundle<S>;

/// What a block sees through each stratum: through its hole, and beside that where light passes there too.
struct Bundles {
    Bundle through, beside;
};

/// A range of a stratum along one axis, mm from the axis of its lens.
struct Range {
    S from, to;
};

/// The part of a stratum that its hole covers lies in these ranges; false: it covers none.
bool clip_to_hole(S radius, Range& x, Range& y) {
    auto nearest = [](Range r) { return optics::min(optics::max(S(0), r.from), r.to); };
    const S near_x = nearest(x), near_y = nearest(y);
    if (near_x * near_x + near_y * near_y >= radius * radius) return false;
    const S reach_x = optics::sqrt(radius * radius - near_y * near_y), reach_y = optics::sqrt(radius * radius - near_x * near_x);
    x = {optics::max(x.from, -reach_x), optics::min(x.to, reach_x)};
    y = {optics::max(y.from, -reach_y), optics::min(y.to, reach_y)};
    return true;
}

template <optics::Way through>
class BundleMaker {
  public:
    BundleMaker(const Tile& t, const optics::PixelBlock<S>& of, const Axis* both)
        : tile(t),
          scene(*t.scene),
          block(of),
          axis(both),
          per_axis(t.strata <= 4   ? 4
                   : t.strata <= 8 ? 3
                                   : 2) {
        for (int p = 0; p < optics::kMostProbes; ++p) {  // the last lanes of a packet trace something, too
            probes.at_x[p] = block.sweep[0][0].at;
            probes.at_y[p] = block.sweep[1][0].at;
            rays.at_x[p] = rays.at_y[p] = rays.x[p] = rays.y[p] = 0;
            grid_x[p] = (S(p % per_axis) + S(0.5)) / S(per_axis);
            grid_y[p] = (S(p / per_axis) + S(0.5)) / S(per_axis);
            counts[p] = p < per_axis * per_axis ? S(1) : S(0);
        }
    }

    void make(Bundles* bundles) {
        for (int j = 0; j < axis[1].strata; ++j)
            for (int i = 0; i < axis[0].strata; ++i) make(*bundles++, i, j);
        finish();
    }

  private:
    void make(Bundles& b, int i, int j) {
        const S r = scene.hole_radius;
        const Range x{axis[0].from[i], axis[0].to[i]}, y{axis[1].from[j], axis[1].to[j]};
        Range hole_x = x, hole_y = y;
        b.through.state = b.beside.state = Bundle::State::dark;
        if (axis[0].straddles[i] || axis[1].straddles[j]) {
            b.through.state = Bundle::State::broken;
            return;
        }
        if (r > 0 && hole_edge_near(x, y)) {
            b.through.state = Bundle::State::broken;
            return;
        }
        if (r == 0 || clip_to_hole(r, hole_x, hole_y)) b.through = probe(i, hole_x, j, hole_y, true);
        if (scene.leaky && r > 0) b.beside = probe(i, x, j, y, false);
        if (b.through.state == Bundle::State::sharp) follow(b.through);
        if (b.beside.state == Bundle::State::sharp) follow(b.beside);
    }

    /// Do some pixels see a moving stratum inside the hole and others outside?
    bool hole_edge_near(Range x, Range y) const {
        if (!axis[0].moving && !axis[1].moving) return false;
        const S mid_x = S(0.5) * (x.from + x.to), mid_y = S(0.5) * (y.from + y.to),
                move_x = axis[0].place[0].reach() + x.to - mid_x, move_y = axis[1].place[0].reach() + y.to - mid_y;
        const S far = optics::sqrt(mid_x * mid_x + mid_y * mid_y), move = optics::sqrt(move_x * move_x + move_y * move_y);
        return optics::abs(far - scene.hole_radius) < move;
    }

    /// Traces the probes of a part of a stratum.
    void trace(int i, Range x, int j, Range y, bool inside) {
        const S lens_x = axis[0].cell[i] * scene.pitch, lens_y = axis[1].cell[j] * scene.pitch;
        const S limit = scene.hole_radius > 0 ? scene.hole_radius * scene.hole_radius : S(1e30);
        for (int p = 0; p < optics::kMostProbes; ++p) {
            const S px = x.from + grid_x[p] * (x.to - x.from), py = y.from + grid_y[p] * (y.to - y.from);
            probes.x[p] = lens_x + px;
            probes.y[p] = lens_y + py;
            probes.in[p] = (px * px + py * py <= limit) == inside ? counts[p] : S(0);
        }
        optics::trace_probes<through, F>(scene, block, probes, per_axis * per_axis);
    }

    Bundle probe(int i, Range x, int j, Range y, bool inside) {
        trace(i, x, j, y, inside);
        Bundle b = optics::sum_up(probes, per_axis);
        if (b.state != Bundle::State::sharp || !optics::is_soft(b)) return b;
        follow(b);
        finish();
        if (b.state == Bundle::State::broken) return b;
        b.state = Bundle::State::soft;
        // The wider the footprint the more probes.
        const int parts = b.still ? optics::min(most_parts, 1 + int(optics::max(b.width, b.height) * part_per_pixel)) : 1;
        const int nodes = b.still ? 1 : block.nodes();
        for (int n = 0; n < nodes * nodes; ++n)
            for (int c = 0; c < 3; ++c) b.colour[n][c] = 0;
        S in = 0, lit = 0;
        for (int k = 0; k < parts * parts; ++k) {
            auto part = [parts](Range r, int n) {
                const S step = (r.to - r.from) / S(parts);
                return Range{r.from + S(n) * step, r.from + S(n + 1) * step};
            };
            if (parts > 1) trace(i, part(x, k % parts), j, part(y, k / parts), inside);
            for (int n = 0; n < nodes * nodes; ++n) {
                const S right = S(n % nodes * block.node_step() - block.reach),
                        down = S(n / nodes * block.node_step() - block.reach);
                const S column = b.still ? S(0) : b.column_right * right + b.column_down * down,
                        row = b.still ? S(0) : b.row_right * right + b.row_down * down;
                optics::add_light<F>(probes, per_axis, tile.levels, tile.level_count, block.lens.panel, column, row, b.colour[n]);
            }
            for (int p = 0; p < optics::kMostProbes; ++p) {
                in = in + probes.in[p];
                lit = lit + probes.in[p] * probes.weight[p];
            }
        }
        b.weight = 1;
        for (int n = 0; n < nodes * nodes; ++n)
            for (int c = 0; c < 3; ++c) b.colour[n][c] = b.colour[n][c] / in;
        return b;
    }

    /// Queues the rays that tell how a bundle moves.
    void follow(Bundle& b) {
        for (int from = 1; from < optics::kBlockRays; ++from) {
            const int p = 3 * waiting + from - 1;
            auto shift = [&](const Axis& a) {
                const Gradient& g = a.place[0];
                return a.moving ? g.right * S(optics::kBlockRight[from]) + g.down * S(optics::kBlockDown[from]) : S(0);
            };
            rays.at_x[p] = block.sweep[0][from].at;
            rays.at_y[p] = block.sweep[1][from].at;
            rays.x[p] = b.x + shift(axis[0]);
            rays.y[p] = b.y + shift(axis[1]);
        }
        followed[waiting++] = &b;
        if (waiting == most_waiting) finish();
    }
    void finish() {
        if (waiting > 0) optics::trace_probes<through, F>(scene, block, rays, 3 * waiting);
        for (int k = 0; k < waiting; ++k) {
            Bundle& b = *followed[k];
            optics::follow(b, rays, 3 * k, block.reach);
            if (b.state == Bundle::State::sharp)
                b.footprint = optics::Footprint<S>(tile.levels, tile.level_count, block.lens.panel, b.width, b.height);
        }
        waiting = 0;
    }

    static constexpr int most_parts = 3;  // of a wide stratum, along an axis
    static constexpr S part_per_pixel = S(1) / S(12);
    static constexpr int most_waiting = optics::kMostProbes / 3;
    const Tile& tile;
    const optics::Scene<S>& scene;
    const optics::PixelBlock<S>& block;
    const Axis* axis;
    int per_axis;  // probes: the coarser the strata the more, as they have to find what is dark in them
    S grid_x[optics::kMostProbes], grid_y[optics::kMostProbes],
        counts[optics::kMostProbes];  // places in a stratum; 1 of those in use
    optics::Probes<S> probes, rays;
    Bundle* followed[most_waiting];
    int waiting = 0;
};

}  // namespace

}  // namespace lfdsim
