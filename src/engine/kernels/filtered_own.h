// The filtered estimator: the pixels' own rays, where a bundle does not describe what all pixels of a block see.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
//
// The lanes of a packet are pixels. A Span (optics/strata.h) is a pixel's part of a stratum along one axis: low .. high of the
// diffuser's number, which is in [-1, 1], and from .. to in the plane of the holes, in units of the hole's radius from the lens's
// axis. Along x, positions decrease as the number grows (optics::sense()); along y they increase. Positions on the panel are in
// panel pixels.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"
#include "optics/footprint.h"
#include "optics/strata.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

/// Where each pixel's ray ends on the panel if the diffuser turns it by the angles of the numbers (a, b).
template <optics::Way through>
LFDSIM_APART optics::PanelPoint<F> trace_own(const optics::Scene<S>& scene, const optics::PixelRays<F>& pixels, F a, F b) {
    return optics::trace_array<through>(scene, pixels.extent, pixels.base,
                                        optics::Ray<F>{{pixels.x, pixels.y, F(0)}, optics::scatter(scene, pixels.to, a, b)},
                                        pixels.alive);
}

/// What a pixel's own rays are for: a whole stratum; one of which a round hole covers a known share; the part beside the hole.
enum class Own { all, covered, beside };

/// Adds the light that pixels see through a stratum (x, y) whose bundle is broken, by rays of their own; `weight` is its share of
/// the pixel's light. One ray, in a random direction of the stratum, determines whether light gets through, unless the covered
/// share is known. If two more rays end close to it, the three give a footprint by finite differences (Igehy 1999), and the panel's
/// mean over it counts; otherwise the panel pixel at the first ray's end.
template <optics::Way through>
LFDSIM_APART void add_own_rays(const Tile& tile, const optics::PixelRays<F>& pixels, const Span<F>& x, const Span<F>& y, Own part,
                               F weight, const optics::Sampler<F>& first, optics::Light<F>& light) {
    const optics::Scene<S>& scene = *tile.scene;
    // Not passed by value: with clang's address sanitizer the stack of such a call is aligned to only 32 bytes, whatever F's width.
    optics::Sampler<F> sampler = first;
    const F half = F(0.5f), quarter = F(0.25f);
    F a = F(0), b = F(0);
    optics::Mask<F> found = F(1) < F(0);
    for (int attempt = 0; attempt < (part == Own::beside ? FilteredLimits::attempts : 1);
         ++attempt) {  // the last is used if none of them lies beside the hole
        ++sampler.sample;
        const F s = half + half * sampler(0), t = half + half * sampler(1);
        a = optics::select(found, a, x.low + s * (x.high - x.low));
        b = optics::select(found, b, y.low + t * (y.high - y.low));
        const F px = x.to - s * (x.to - x.from), py = y.from + t * (y.to - y.from);  // along x against the number
        found = found || (px * px + py * py > F(1));
    }
    if (part == Own::covered) {
        // On the hole's edge: take a point near the corner next to the lens's axis, if that corner lies in the hole.
        auto towards_axis = [](const Span<F>& span, F at_from, F at_to) {
            return optics::select(optics::abs(span.from) < optics::abs(span.to), F(0.9f) * at_from + F(0.1f) * at_to,
                                  F(0.1f) * at_from + F(0.9f) * at_to);
        };
        // Otherwise, where the hole is smaller than the stratum, the point nearest to the axis.
        auto next_to_axis = [](const Span<F>& span, F at_from, F at_to) {
            const F place = optics::min(optics::max(F(0), span.from), span.to);
            return at_from + (place - span.from) / optics::max(span.to - span.from, F(1e-6f)) * (at_to - at_from);
        };
        const F corner_x = towards_axis(x, x.from, x.to), corner_y = towards_axis(y, y.from, y.to);
        const optics::Mask<F> corner_in = corner_x * corner_x + corner_y * corner_y < F(1);
        const F cover = optics::hole_cover(x, y);
        const optics::Mask<F> at_edge = (cover > F(S(FilteredLimits::hole_edge))) && (cover < F(S(1 - FilteredLimits::hole_edge)));
        a = optics::select(at_edge, optics::select(corner_in, towards_axis(x, x.high, x.low), next_to_axis(x, x.high, x.low)), a);
        b = optics::select(at_edge, optics::select(corner_in, towards_axis(y, y.low, y.high), next_to_axis(y, y.low, y.high)), b);
        weight = optics::select(at_edge, weight * cover, weight);
    }
    auto one = trace_own<through>(scene, pixels, a, b);
    weight = optics::select(one.alive, weight * one.weight, F(0));
    if (part != Own::beside) {
        // Two more rays, each a quarter of the stratum towards its middle, give where the ray through the middle ends, and the size
        // of the footprint: four steps along each axis, added up.
        auto step = [&](const Span<F>& span, F at) {
            const F mid = half * (span.low + span.high), size = quarter * (span.high - span.low);
            return optics::select(at < mid, size, -size);
        };
        auto steps = [&](const Span<F>& span, F at, F one_step) {  // from `at` to the middle
            return (half * (span.low + span.high) - at) / optics::select(one_step == F(0), F(1), one_step);
        };
        const F step_a = step(x, a), step_b = step(y, b), to_a = steps(x, a, step_a), to_b = steps(y, b, step_b);
        const auto across = trace_own<through>(scene, pixels, a + step_a, b);
        const auto along = trace_own<through>(scene, pixels, a, b + step_b);
        auto near = [&](const optics::PanelPoint<F>& p) {
            const F far_x = F(S(FilteredLimits::together) * scene.pitch_pixels[0]),
                    far_y = F(S(FilteredLimits::together) * scene.pitch_pixels[1]);
            return p.alive && (p.cell.i == one.cell.i) && (p.cell.j == one.cell.j) &&
                   (optics::abs(p.column - one.column) < far_x) && (optics::abs(p.row - one.row) < far_y);
        };
        const optics::Mask<F> together = one.alive && near(across) && near(along);
        const F across_c = across.column - one.column, across_r = across.row - one.row, along_c = along.column - one.column,
                along_r = along.row - one.row;
        const F wide = F(4) * (optics::abs(across_c) + optics::abs(along_c)),
                high = F(4) * (optics::abs(across_r) + optics::abs(along_r));
        const F column = one.column + across_c * to_a + along_c * to_b, row = one.row + across_r * to_a + along_r * to_b;
        S in_box[optics::LaneTraits<F>::width][4];
        optics::light_of_boxes(tile.levels, tile.level_count, pixels.base, column, row, wide, high,
                               optics::select(together, weight, F(0)), in_box);
        light.add(in_box);
        one.alive = one.alive && !together;
    }
    if (optics::none(one.alive)) return;
    optics::PanelHit<F> hit = optics::panel_pixel(scene, pixels.base, one);
    hit.weight = weight;
    light.add(tile.texels, optics::Fetch<F>(hit));
}

/// Adds the light that pixels see through a part (x, y) of a stratum that looks through one lens, by probes of their own: 2 x 2
/// rays through what the hole covers of it, each with the panel's mean over a box around its end, as wide as the distance to the
/// ends of the next ones. `weight` is the part's share of the pixel's light.
template <optics::Way through>
LFDSIM_APART void add_own_probes(const Tile& tile, const optics::PixelRays<F>& pixels, const Span<F>& x, const Span<F>& y, F weight,
                                 optics::Light<F>& light) {
    const optics::Scene<S>& scene = *tile.scene;
    const F none = F(0), one = F(1), quarter = F(0.25f);
    const bool round = scene.hole_radius > 0;
    if (round) weight = weight * optics::hole_cover(x, y);
    const optics::Mask<F> seen = weight > none;
    if (optics::none(seen)) return;

    // Where the rays pass, in units of the hole's radius, or as shares of the part where the hole is not round. Along each axis the
    // one nearer to the lens's axis comes first: the ray that has both is always inside the hole.
    const Span<F>* const span[2] = {&x, &y};
    F first[2], per[2], place[2][2];  // position at the number `low`; change of the number per unit of position
    for (int k = 0; k < 2; ++k) {
        F from = none, to = one;
        if (round) {
            from = span[k]->from;
            to = span[k]->to;
        }
        first[k] = k == 0 ? to : from;  // along x against the number
        per[k] = (span[k]->high - span[k]->low) / optics::max(to - from, F(1e-9f));
        if (round) {
            const Span<F>& other = *span[1 - k];
            const F near = optics::min(optics::max(none, other.from), other.to);
            const F reach = optics::sqrt(optics::max(one - near * near, none));
            from = optics::max(from, -reach);
            to = optics::min(to, reach);
        }
        const F in = quarter * (to - from), low = from + in, high = to - in;
        const optics::Mask<F> low_first = optics::abs(low) < optics::abs(high);
        place[k][0] = optics::select(low_first, low, high);
        place[k][1] = optics::select(low_first, high, low);
    }

    optics::PanelPoint<F> end[4];
    optics::Mask<F> in[4];
    F count = none;
    for (int p = 0; p < 4; ++p) {
        const F px = place[0][p % 2], py = place[1][p / 2];
        in[p] = seen;
        if (round && p > 0) in[p] = seen && (px * px + py * py < one);
        count = count + optics::select(in[p], one, none);
        end[p] = trace_own<through>(scene, pixels, x.low + (first[0] - px) * per[0], y.low + (py - first[1]) * per[1]);
    }
    weight = weight / optics::max(count, one);
    for (int p = 0; p < 4; ++p) {
        F wide = none, high = none;  // squared: the spreads of two directions add up like variances
        for (int step = 1; step <= 2; ++step) {
            const optics::PanelPoint<F>& next = end[p ^ step];
            const optics::Mask<F> lit =
                in[p ^ step] && next.alive && (next.cell.i == end[p].cell.i) && (next.cell.j == end[p].cell.j);
            const F across = next.column - end[p].column, up = next.row - end[p].row;
            wide = wide + optics::select(lit, across * across, none);
            high = high + optics::select(lit, up * up, none);
        }
        S in_box[optics::LaneTraits<F>::width][4];
        optics::light_of_boxes(tile.levels, tile.level_count, pixels.base, end[p].column, end[p].row, optics::sqrt(wide),
                               optics::sqrt(high), optics::select(in[p] && end[p].alive, weight * end[p].weight, none), in_box);
        light.add(in_box);
    }
}

}  // namespace

}  // namespace lfdsim
