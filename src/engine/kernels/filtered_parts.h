// The filtered estimator: pixels that cut what they see of a lens by themselves, where the block's bundles do not hold, where the
// diffuser is weak, and where there is none.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_bundles.h"
#include "engine/kernels/filtered_grids.h"
#include "engine/kernels/filtered_own.h"
#include "optics/outline.h"

namespace lfdsim {

namespace {

/// A stratum, and what the pixels of a packet see of it.
struct Seen {
    const Bundles* bundles;
    const Grid* grid;
    const Span<F>*across, *up;
    const optics::Corners<F>* corners;  // of the lens's cell, in the diffuser's numbers
    int i, j;
    std::uint32_t number;  // another for each stratum of a block

    /// The share of the square that is the stratum's, and its lens's.
    LFDSIM_BOTH F share() const {
        if (corners->count == 0) return across->share * up->share;
        return F(0.25f) * optics::area_within(*corners, optics::Box<F>{across->low, across->high, up->low, up->high});
    }
};

/// The corners of stratum k across a strip, whose own are given: between (p, -) and (-p, -), and (p, +) and (-p, +).
LFDSIM_BOTH optics::Corners<F> part_of_strip(const optics::Corners<F>& strip, const Grid& grid, int k) {
    const Axis& axis = grid.axis[1 - grid.strip];
    const S extent = axis.stratum[axis.strata - 1].to, per = S(0.5) / extent;
    // Positions along the display's axis may run against those across the strip.
    const Stratum& of = axis.stratum[k];
    const bool against = grid.against;
    const S right = (extent - (against ? -of.from : of.to)) * per, left = (extent - (against ? -of.to : of.from)) * per;
    const auto between = [](F a, F b, S share) { return a + (b - a) * F(share); };
    optics::Corners<F> part;
    part.count = 4;
    for (int end = 0; end < 2; ++end) {
        const int first = end, second = 3 - end;
        part.x[first] = between(strip.x[first], strip.x[second], right);
        part.y[first] = between(strip.y[first], strip.y[second], right);
        part.x[second] = between(strip.x[first], strip.x[second], left);
        part.y[second] = between(strip.y[first], strip.y[second], left);
    }
    return part;
}

/// The corners of the seen lens's cell for pixels at (dx, dy) of the block, -1 .. 1; with a diffuser also between pixels.
LFDSIM_BOTH optics::Corners<F> corners_at(const Grid& grid, F dx, F dy) {
    optics::Corners<F> corners;
    corners.count = grid.corners;
    for (int k = 0; k < grid.corners; ++k) {
        corners.x[k] = grid.corner[k][0].at(dx, dy);
        corners.y[k] = grid.corner[k][1].at(dx, dy);
    }
    return corners;
}

/// A part's place in the pupil, and the tangents of the diffuser's turns.
struct Moves {
    F by[4];

    /// from, moved along axis a: Grids' aside or moved.
    LFDSIM_BOTH F apply(F from, const S (&per)[4][2], int a) const {
        for (int k = 0; k < 4; ++k) from = from + by[k] * F(per[k][a]);
        return from;
    }
};

/// Part k of n x n of a pixel's area: its middle, in half pixels to the right and upwards.
LFDSIM_BOTH optics::Place<S> middle_of_part(int k, int n) { return {S(2 * (k % n) + 1 - n) / S(n), S(2 * (k / n) + 1 - n) / S(n)}; }

/// What part k of n x n of a pixel's area sees inside the edge of a round hole, which is taken as straight there: a square about
/// it. The hole bulges beyond its chord by the mean of t^2 / 2r, t along the edge.
LFDSIM_BOTH optics::Corners<F> inside_edge(const optics::Scene<S>& scene, const Grids& grids, const Grid& grid, F dx, F dy,
                                           const Moves& moves, int k, int n) {
    const S(&to)[2][2] = grids.pixel;
    const optics::Place<S> middle = middle_of_part(k, n);
    F at[2];
    for (int a = 0; a < 2; ++a)
        at[a] = moves.apply(grid.axis[a].first.at(dx, dy), grids.aside, a) -
                F(grid.axis[a].stratum[0].axis - middle.x * to[0][a] - middle.y * to[1][a]);
    const F far = optics::sqrt(at[0] * at[0] + at[1] * at[1]), per_far = F(1) / optics::max(far, F(1e-9f)),
            normal[2] = {optics::select(far > F(0), at[0] * per_far, F(1)), at[1] * per_far};
    const F u = normal[0] * F(to[0][0]) + normal[1] * F(to[0][1]),
            v = normal[0] * F(to[1][0]) + normal[1] * F(to[1][1]);  // outwards per number
    const F t_u = normal[0] * F(to[0][1]) - normal[1] * F(to[0][0]), t_v = normal[0] * F(to[1][1]) - normal[1] * F(to[1][0]);
    const F edge = F(scene.hole_radius) - (t_u * t_u + t_v * t_v) * F(S(1.0 / 6) / (scene.hole_radius * S(n * n))) - far;
    const F steep = optics::sqrt(u * u + v * v), per = F(1) / optics::max(steep, F(1e-12f)), x = u * per, y = v * per;
    const F c = optics::min(optics::max(edge * per, F(-4)), F(4)), size = F(8);
    optics::Corners<F> corners;
    corners.count = 4;
    for (int corner = 0; corner < 4; ++corner) {
        const F out = corner < 2 ? c : c - size - size, side = corner == 0 || corner == 3 ? -size : size;
        corners.x[corner] = F(middle.x) + x * out - y * side;
        corners.y[corner] = F(middle.y) + y * out + x * side;
    }
    return corners;
}

/// Times this modulo n, neighbours among 0 .. n-1 go far from each other: a number near 0.618 n without common factor with n.
LFDSIM_BOTH int far_step(int n) {
    auto common = [](int a, int b) {
        while (b != 0) {
            const int rest = a % b;
            a = b;
            b = rest;
        }
        return a;
    };
    int step = int(S(0.618034) * S(n)) + 1;
    while (common(step, n) != 1) ++step;
    return step;
}

/// Part k of n of a span, without positions.
LFDSIM_BOTH Span<F> part_of_span(const Span<F>& of, int k, int n) {
    if (n == 1) return of;
    const F range = of.high - of.low;
    Span<F> part = of;
    part.low = of.low + F(S(k) / S(n)) * range;
    part.high = of.low + F(S(k + 1) / S(n)) * range;
    part.share = F(0.5f) * (part.high - part.low);
    return part;
}

/// The same with positions, which may run against the numbers. Of third degree in them as the axis says, they differ from those on
/// the line between the span's ends by (number - low) (number - high) (square + cube (number + low + high)).
LFDSIM_BOTH Span<F> placed_part_of_span(const Span<F>& of, const Axis& axis, S per_radius, bool against, int k, int n) {
    Span<F> part = part_of_span(of, k, n);
    if (n == 1) return part;
    const F square = F(axis.square * per_radius), cube = F(axis.cube * per_radius), range = of.high - of.low, way = of.to - of.from;
    const auto position = [&](F number, S share) {
        const F line = against ? of.to - F(share) * way : of.from + F(share) * way;
        return line - F(share * (S(1) - share)) * range * range * (square + cube * (number + of.low + of.high));
    };
    const F first = position(part.low, S(k) / S(n)), last = position(part.high, S(k + 1) / S(n));
    part.from = against ? last : first;
    part.to = against ? first : last;
    return part;
}

/// The pixels of a packet: their numbers in the frame, and where they are in the block, -1 .. 1, which is so many pixels wide.
struct OwnPixels {
    const optics::PixelRays<F>& rays;
    optics::Uint<F> number;
    F dx, dy;
    S per_reach;
    int square;  // of the block's, whose Blur is theirs

    LFDSIM_BOTH optics::Sampler<F> sampler(const Tile& tile, std::uint32_t sample) const {
        optics::Sampler<F> own(Sampling::random, 6, tile.view->seed, number);
        own.sample = sample;
        return own;
    }
};

/// Adds the light that pixels see of a lens by rays of their own, four or one through each part of the stratum.
/// Boxes are wider by what the numbers spread that are not the square's. Where those are divided too, the rays of a part have them
/// in one of as many cells as there are parts, in a lattice in which neighbouring parts have cells far from each other; boxes are
/// wider by what a cell spreads.
template <optics::Way through>
LFDSIM_APART void add_parts(const Tile& tile, const Grids& grids, const OwnPixels& pixels, const Seen& seen,
                            WaitingRays<through>& waiting) {
    const optics::Scene<S>& scene = *tile.scene;
    const Grid& grid = *seen.grid;
    const Blur& known = seen.bundles->blur[pixels.square];
    const bool two_pairs = scene.box_filter && scene.has_diffuser, spreads = scene.thin_lens || two_pairs,
               round = scene.hole_radius > 0;
    const int n = tile.square.parts, all = n * n;
    const int far = far_step(n);
    for (int k = 0; k < all; ++k) {
        Spread spread;
        if (spreads && tile.square.weak) {
            const auto of = [](const optics::PanelSpread<S>& one) {
                return optics::PanelSpread<F>{F(one.wide2), F(one.high2), F(one.lean2), F(one.box_wide2), F(one.box_high2)};
            };
            spread.on_panel = of(known.on_panel);
            spread.at_edge = of(known.at_edge);
            if (known.one_ray) spread.one_ray = &known;
        }
        if (spreads && !tile.square.weak) {
            spread.start = random_start(scene, pixels.sampler(tile, seen.number * 8));
        } else if (spreads && all > 1) {
            const auto cell = [&](int column, int row) {
                return F(S(2 * (far * (column * (k % n) + row * (k / n)) % n) + 1 - n) / S(n));
            };
            if (two_pairs && tile.square.divides_other) {
                spread.start.x = cell(2, 1);
                spread.start.y = cell(1, 3);
            }
            if (scene.thin_lens && tile.square.divides_pupil)
                optics::disk(cell(1, 1), cell(1, 2), spread.start.lens_x, spread.start.lens_y);
        }
        const Start& start = spread.start;
        const F half_pixel = F(tile.square.of_pixel ? S(0) : S(0.5) * pixels.per_reach), right = pixels.dx + start.x * half_pixel,
                down = pixels.dy - start.y * half_pixel;
        if (round && !tile.square.of_pixel) {
            const S per_radius = S(1) / scene.hole_radius;
            const Span<F> x = placed_part_of_span(*seen.across, grid.axis[0], per_radius, true, k % n, n),
                          y = placed_part_of_span(*seen.up, grid.axis[1], per_radius, false, k / n, n);
            add_own_probes(scene, x, y, x.share * y.share, spread, waiting);
            continue;
        }
        const Span<F> x = part_of_span(*seen.across, k % n, n), y = part_of_span(*seen.up, k / n, n);
        if (!round && all == 1) {
            add_own_part(x, y, *seen.corners, spread, waiting);
            continue;
        }
        Moves moves{{start.lens_x, start.lens_y, F(0), F(0)}};
        if (two_pairs && tile.square.of_pixel && tile.square.divides_other) {
            moves.by[2] = optics::diffuser_tangent(scene, 0, start.x);
            moves.by[3] = optics::diffuser_tangent(scene, 1, start.y);
        }
        optics::Corners<F> corners;
        if (grid.corners == 0) {
            corners = inside_edge(scene, grids, grid, right, down, moves, k, n);
        } else {
            corners = corners_at(grid, right, down);
            for (int c = 0; c < corners.count; ++c) {
                corners.x[c] = moves.apply(corners.x[c], grids.moved, 0);
                corners.y[c] = moves.apply(corners.y[c], grids.moved, 1);
            }
        }
        add_own_part(x, y, corners, spread, waiting);
    }
}

/// The same where light also passes beside round lenses: through each part of the stratum one random ray, with two more beside it.
template <optics::Way through>
LFDSIM_APART void add_random_parts(const Tile& tile, const OwnPixels& pixels, const Seen& seen, optics::Light<F>& light) {
    const int n = tile.square.weak ? tile.strata : 1;
    optics::Sampler<F> sampler = pixels.sampler(tile, 0);
    for (int k = 0; k < n * n; ++k) {
        const Span<F> x = part_of_span(*seen.across, k % n, n), y = part_of_span(*seen.up, k / n, n);
        const optics::Box<F> box{x.low, x.high, y.low, y.high};
        // Decided for each pixel, as rounding leaves some area, of either sign, to those that see nothing of the part.
        const F area = optics::area_within(*seen.corners, box);
        const F share = F(0.25f) * optics::select(reaches(*seen.corners, box), optics::max(area, F(0)), F(0));
        if (optics::none(share > F(0))) continue;
        sampler.sample = (seen.number + std::uint32_t(k * max_strata * max_strata)) * 8;
        add_own_rays<through>(tile, pixels.rays, x, y, *seen.corners, Own::all, share, sampler, light);
    }
}

}  // namespace

}  // namespace lfdsim
