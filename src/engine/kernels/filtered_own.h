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
#include "engine/kernels/filtered_blur.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"
#include "optics/outline.h"
#include "optics/panel_light.h"
#include "optics/spread.h"
#include "optics/strata.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

/// What else a pixel's ray has than the square's two numbers: a place in the pupil, in radii, and the other two numbers: those of
/// a point of its area, in half pixels to the right and upwards from its centre, or the diffuser's, where the square is that area.
struct Start {
    F x = F(0), y = F(0), lens_x = F(0), lens_y = F(0);
};

/// Each pixel's ray with the square's numbers (a, b): the diffuser's, or those of a point of the pixel's area. `aimed`: the
/// diffuser's two turns are taken as independent, so that the ray goes where strata and outlines have its numbers.
LFDSIM_FN optics::Ray<F> own_ray(const Tile& tile, const optics::PixelRays<F>& pixels, const Start& start, F a, F b, bool aimed) {
    const optics::Scene<S>& scene = *tile.scene;
    const bool of_pixel = tile.square.of_pixel;
    optics::Ray<F> ray{{pixels.x, pixels.y, F(0)}, pixels.to};
    if (of_pixel || scene.box_filter || scene.thin_lens)
        ray = optics::displaced(*tile.view, pixels, of_pixel ? a : start.x, of_pixel ? b : start.y, start.lens_x, start.lens_y);
    if (!scene.has_diffuser) return ray;
    const F about_y = of_pixel ? start.x : a, about_x = of_pixel ? start.y : b;
    ray.to = aimed ? optics::scatter_apart(scene, ray.to, about_y, about_x) : optics::scatter(scene, ray.to, about_y, about_x);
    return ray;
}

/// Where it ends on the panel.
template <optics::Way through>
LFDSIM_APART optics::PanelPoint<F> trace_own(const Tile& tile, const optics::PixelRays<F>& pixels, const Start& start, F a, F b) {
    return optics::trace_array<through>(*tile.scene, pixels.extent, pixels.base, own_ray(tile, pixels, start, a, b, false),
                                        pixels.alive);
}

/// A random start, of the sampler's current sample.
LFDSIM_BOTH Start random_start(const optics::Scene<S>& scene, const optics::Sampler<F>& sampler) {
    Start start;
    if (scene.box_filter) {
        start.x = sampler(2);
        start.y = sampler(3);
    }
    if (scene.thin_lens) optics::disk(sampler(4), sampler(5), start.lens_x, start.lens_y);
    return start;
}

/// What a pixel's own rays are for: a whole stratum; one of which a round hole covers a known share; the part beside the hole.
enum class Own { all, covered, beside };

/// Adds the light that pixels see through a stratum (x, y) whose bundle is broken, by rays of their own; `weight` is its share of
/// the pixel's light. One ray, in a random direction of the stratum, determines whether light gets through, unless the covered
/// share is known. If two more rays end close to it, the three give a footprint by finite differences (Igehy 1999), and the panel's
/// mean over it counts; otherwise the panel pixel at the first ray's end.
template <optics::Way through>
LFDSIM_APART void add_own_rays(const Tile& tile, const optics::PixelRays<F>& pixels, const Span<F>& x, const Span<F>& y,
                               const optics::Corners<F>& cell, Own part, F weight, const optics::Sampler<F>& first,
                               optics::Light<F>& light) {
    const optics::Scene<S>& scene = *tile.scene;
    // Not passed by value: with clang's address sanitizer the stack of such a call is aligned to only 32 bytes, whatever F's width.
    optics::Sampler<F> sampler = first;
    const F half = F(0.5f), quarter = F(0.25f);
    F a = F(0), b = F(0);
    optics::Mask<F> found = F(1) < F(0);
    for (int attempt = 0; attempt < (part == Own::beside || cell.count > 0 ? FilteredLimits::attempts : 1);
         ++attempt) {  // the last is used if none of them lies beside the hole
        ++sampler.sample;
        const F s = half + half * sampler(0), t = half + half * sampler(1);
        a = optics::select(found, a, x.low + s * (x.high - x.low));
        b = optics::select(found, b, y.low + t * (y.high - y.low));
        const F px = x.to - s * (x.to - x.from), py = y.from + t * (y.to - y.from);  // along x against the number
        optics::Mask<F> meant = optics::lies_in(cell, a, b);
        if (part == Own::beside) meant = meant && (px * px + py * py > F(1));
        found = found || meant;
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
        const F cover = optics::hole_cover_alone(x, y);
        const optics::Mask<F> at_edge = (cover > F(S(FilteredLimits::hole_edge))) && (cover < F(S(1 - FilteredLimits::hole_edge)));
        a = optics::select(at_edge, optics::select(corner_in, towards_axis(x, x.high, x.low), next_to_axis(x, x.high, x.low)), a);
        b = optics::select(at_edge, optics::select(corner_in, towards_axis(y, y.low, y.high), next_to_axis(y, y.low, y.high)), b);
        weight = optics::select(at_edge, weight * cover, weight);
    }
    const Start start = random_start(scene, sampler);
    auto one = trace_own<through>(tile, pixels, start, a, b);
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
        const auto across = trace_own<through>(tile, pixels, start, a + step_a, b);
        const auto along = trace_own<through>(tile, pixels, start, a, b + step_b);
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
        optics::add_light(tile.panel, pixels.base,
                          optics::Boxes<F>{column, row, wide, high, optics::select(together, weight, F(0))}, light);
        one.alive = one.alive && !together;
    }
    if (optics::none(one.alive)) return;
    one.weight = weight;
    light.add(scene.emission, tile.texels, optics::Fetch<F>(optics::panel_pixel(scene, pixels.base, one)));
}

/// Where rays start, and how far light spreads about each ray's end by other than the square's numbers, in parts of the square that
/// lie within the lens's outline, and on it.
struct Spread {
    Start start;
    optics::PanelSpread<F> on_panel{}, at_edge{};
    const Blur* one_ray = nullptr;    // where one serves for four: how far each of the square's numbers spreads light;
    optics::PanelSpread<F> square{};  // how far the part of the square does then
};

/// Four rays of each pixel, two by two at the square's numbers (a, b), of which those that count carry `weight` each.
struct FourRays {
    F a[4], b[4];
    optics::Mask<F> counts[4];
    F weight;
};

/// Where they end on the panel.
template <optics::Way through>
LFDSIM_APART void trace_four(const Tile& tile, const optics::PixelRays<F>& pixels, const Start& start, const FourRays& rays,
                             optics::PanelPoint<F> (&end)[4]) {
    const bool aimed = tile.scene->by_lens && !tile.square.exact_turns;
    for (int p = 0; p < 4; ++p) {
        if (optics::none(rays.counts[p])) continue;
        end[p] = optics::trace_array<through>(*tile.scene, pixels.extent, pixels.base,
                                              own_ray(tile, pixels, start, rays.a[p], rays.b[p], aimed), pixels.alive);
    }
}

/// The rays of a packet's pixels that wait to be traced. Pixels of a packet see different lenses and different parts of them: as
/// long as no pixel has rays through two, all of them are traced at once. Each pixel's light is added in the order of its own rays.
template <optics::Way through>
class WaitingRays {
  public:
    LFDSIM_BOTH WaitingRays(const Tile& t, const optics::PixelRays<F>& of, bool of_clear, optics::Light<F>& to)
        : tile(t), pixels(of), clear(of_clear), light(to) {}

    /// Four more rays of the pixels `seen`; of a part that lies `within` the outline.
    LFDSIM_BOTH void add(const FourRays& more, const Spread& with, optics::Mask<F> seen, optics::Mask<F> within) {
        if (optics::any(waits && seen)) trace();
        const auto take = [seen](F& to, F from) { to = optics::select(seen, from, to); };
        for (int p = 0; p < 4; ++p) {
            take(rays.a[p], more.a[p]);
            take(rays.b[p], more.b[p]);
            rays.counts[p] = (seen && more.counts[p]) || (!seen && rays.counts[p]);
        }
        take(rays.weight, more.weight);
        take(spread.start.x, with.start.x);
        take(spread.start.y, with.start.y);
        take(spread.start.lens_x, with.start.lens_x);
        take(spread.start.lens_y, with.start.lens_y);
        spread.on_panel = optics::select(seen, optics::select(within, with.on_panel, with.at_edge), spread.on_panel);
        spread.square = optics::select(seen, with.square, spread.square);
        waits = waits || seen;
    }

    /// Adds the light of all that wait: the panel's mean around the end of each ray, as far as to the ends of the next ones.
    LFDSIM_APART void trace() {
        if (optics::none(waits)) return;
        const F none = F(0);
        optics::PanelPoint<F> end[4]{};
        optics::by_way<through>(*tile.scene, [&]<optics::Way way>() { trace_four<way>(tile, pixels, spread.start, rays, end); });
        if (clear) skip_lost(end);
        for (int p = 0; p < 4; ++p) {
            if (optics::none(rays.counts[p])) continue;
            optics::PanelSpread<F> square = spread.square;  // the spreads of two directions add up
            for (int step = 1; step <= 2; ++step) {
                const optics::PanelPoint<F>& next = end[p ^ step];
                const optics::Mask<F> lit =
                    rays.counts[p ^ step] && next.alive && (next.cell.i == end[p].cell.i) && (next.cell.j == end[p].cell.j);
                square.add(optics::select(lit, next.column - end[p].column, none),
                           optics::select(lit, next.row - end[p].row, none));
            }
            const F weight = optics::select(rays.counts[p] && end[p].alive, rays.weight * end[p].weight, none);
            optics::add_spread(tile.panel, pixels.base, end[p].column, end[p].row, square, spread.on_panel, weight, light);
        }
        waits = none > none;
        for (int p = 0; p < 4; ++p) rays.counts[p] = waits;
    }

  private:
    /// What a lens's borders hide is left out of its outline: rays that are lost there as well do not count.
    LFDSIM_BOTH void skip_lost(const optics::PanelPoint<F> (&end)[4]) {
        F all = F(0), passed = F(0);
        for (int p = 0; p < 4; ++p) {
            all = all + optics::select(rays.counts[p], F(1), F(0));
            passed = passed + optics::select(rays.counts[p] && end[p].alive, F(1), F(0));
        }
        rays.weight = rays.weight * all / optics::max(passed, F(1));
    }

    const Tile& tile;
    const optics::PixelRays<F>& pixels;
    const bool clear;  // of lenses whose outlines leave out what their borders hide
    optics::Light<F>& light;
    optics::Mask<F> waits = F(0) > F(0);
    FourRays rays{};
    Spread spread;
};

/// May a polygon overlap a box?
LFDSIM_BOTH optics::Mask<F> reaches(const optics::Corners<F>& of, const optics::Box<F>& box) {
    F left = of.x[0], right = of.x[0], low = of.y[0], high = of.y[0];
    for (int k = 1; k < of.count; ++k) {
        left = optics::min(left, of.x[k]);
        right = optics::max(right, of.x[k]);
        low = optics::min(low, of.y[k]);
        high = optics::max(high, of.y[k]);
    }
    return (left < box.right) && (right > box.left) && (low < box.high) && (high > box.low);
}

/// A whole box.
LFDSIM_BOTH optics::Moments<F> middle_of(const optics::Box<F>& box) {
    const F half = F(0.5f), wide = box.right - box.left, high = box.high - box.low;
    return {wide * high, half * (box.left + box.right), half * (box.low + box.high), half * wide, half * high};
}
LFDSIM_BOTH optics::Moments<F> choose(optics::Mask<F> first, const optics::Moments<F>& a, const optics::Moments<F>& b) {
    return {optics::select(first, a.area, b.area), optics::select(first, a.x, b.x), optics::select(first, a.y, b.y),
            optics::select(first, a.half_width, b.half_width), optics::select(first, a.half_height, b.half_height)};
}

/// Adds the light that pixels see through the part of a box of the square's numbers (x, y) that is inside a lens's cell, by four
/// rays around its middle or one through it.
template <optics::Way through>
LFDSIM_APART void add_own_part(const Span<F>& x, const Span<F>& y, const optics::Corners<F>& cell, const Spread& spread,
                               WaitingRays<through>& waiting) {
    const optics::Box<F> box{x.low, x.high, y.low, y.high};
    const optics::Mask<F> near = reaches(cell, box);
    if (optics::none(near)) return;
    const optics::Mask<F> whole = near && optics::holds(cell, box);
    optics::Moments<F> part = middle_of(box);
    if (optics::any(near && !whole)) part = choose(whole, part, optics::part_within(cell, box));
    const optics::Mask<F> seen = near && (part.area > F(0));
    if (optics::none(seen)) return;
    FourRays rays;
    if (spread.one_ray) {
        const F none = F(0);
        rays = {{part.x, none, none, none},
                {part.y, none, none, none},
                {seen, none > none, none > none, none > none},
                F(0.25f) * part.area};
        Spread with = spread;
        const Blur& blur = *spread.one_ray;
        const F wide = F(2) * part.half_width, high = F(2) * part.half_height;
        with.square.add(wide * F(blur.column[0]), wide * F(blur.row[0]));
        with.square.add(high * F(blur.column[1]), high * F(blur.row[1]));
        return waiting.add(rays, with, seen, whole);
    }
    rays.weight = F(S(1.0 / 16)) * part.area;  // a quarter each, of the square's area of 4
    for (int p = 0; p < 4; ++p) {
        rays.a[p] = part.x + F(p % 2 == 0 ? -0.5f : 0.5f) * part.half_width;
        rays.b[p] = part.y + F(p < 2 ? -0.5f : 0.5f) * part.half_height;
        rays.counts[p] = seen;
    }
    for (int p = 0; p < 4 && optics::any(near && !whole); ++p) {
        const optics::Mask<F> inside = whole || optics::lies_in(cell, rays.a[p], rays.b[p]);
        rays.a[p] = optics::select(inside, rays.a[p], part.x);
        rays.b[p] = optics::select(inside, rays.b[p], part.y);
    }
    waiting.add(rays, spread, seen, whole);
}

/// Adds the light that pixels see through a part (x, y) of a stratum that looks through one lens, by probes of their own: 2 x 2
/// rays through what the hole covers of it, each with the panel's mean over a box around its end, as wide as the distance to the
/// ends of the next ones. `weight` is the part's share of the pixel's light.
template <optics::Way through>
LFDSIM_APART void add_own_probes(const optics::Scene<S>& scene, const Span<F>& x, const Span<F>& y, F weight, const Spread& spread,
                                 WaitingRays<through>& waiting) {
    const F none = F(0), one = F(1), quarter = F(0.25f);
    const bool round = scene.hole_radius > 0;
    if (round) weight = weight * optics::hole_cover_alone(x, y);
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

    FourRays rays;
    F count = none;
    for (int p = 0; p < 4; ++p) {
        const F px = place[0][p % 2], py = place[1][p / 2];
        rays.counts[p] = seen;
        if (round && p > 0) rays.counts[p] = seen && (px * px + py * py < one);
        count = count + optics::select(rays.counts[p], one, none);
        rays.a[p] = x.low + (first[0] - px) * per[0];
        rays.b[p] = y.low + (py - first[1]) * per[1];
    }
    rays.weight = weight / optics::max(count, one);
    waiting.add(rays, spread, seen, seen);
}

}  // namespace

}  // namespace lfdsim
