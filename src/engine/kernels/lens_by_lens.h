// The estimator `lens_by_lens`: a pixel's mean light as a sum over its visible lenses.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
//
// A sample of a pixel has up to six coordinates in [-1, 1]: two of the diffuser, two of the position in the pixel's area, two of
// that in the pupil (optics/trace.h, sample_ray()). One pair, the domain, is cut at the outlines of lenses: the diffuser's or,
// where that spreads rays over less of the lenses than a pixel does, the pixel's. The part of the domain within a lens's outline is
// cut into a grid of cells. Each has an exact share of the light and one ray, through the middle of the part of the cell that lies
// in the lens. The distance to the ends of its neighbours is the size of the cell's footprint, a box whose mean is exact. As the
// shares of all cells add up to 1, this is a quadrature rule for any lens: the lens determines the rays, not the rule.
//
// The other pairs are divided into a grid of cells, too, whose middles move the domain's outlines; the spread within a cell widens
// the boxes. docs/model.md, "Lens by lens", has the equations.
//
// Lanes are pixels. A group of 4 x 4 pixels shares the list of visible lenses and the derivatives of a lens's rays, which are
// traced at the group's middle; all else is decided for each pixel, so that no bit depends on the packet that it is in.
#pragma once
#include "engine/estimator/limits.h"
#include "engine/estimator/panel_covariance.h"
#include "engine/estimator/panel_light.h"
#include "engine/kernels/cancelling.h"
#include "engine/kernels/visible_lenses.h"

namespace lfdsim {

namespace {

/// The memory of a thread, too large for its stack.
struct LensByLensMemory {
    LensPart part[most_divisions * most_divisions];
    VisibleLens lens[most_visible_lenses];

    /// Placement new, whose header of the standard library kernels do not include.
    static void* operator new(std::size_t, void* at) noexcept { return at; }
};

/// Renders groups of pixels, one after the other.
class LensByLens : VisibleLenses {
  public:
    LensByLens(const Tile& t, LensByLensMemory& m) : VisibleLenses(t, m.lens), memory(m) {}

    /// Renders the group of 4 x 4 pixels whose first is (x, y) of the frame.
    void render(std::int32_t x, std::int32_t y) {
        using Packet = optics::Block<F>;
        const bool by_lens = list_lenses(x, y);  // else by points: too many lenses, or no domain to cut
        for (std::int32_t row = y; row < y + side; row += Packet::height)
            for (std::int32_t column = x; column < x + side; column += Packet::width) {
                if (column >= tile.x1 || row >= tile.y1 || column + Packet::width <= tile.x0 || row + Packet::height <= tile.y0)
                    continue;
                const auto pixels = optics::pixel_rays<F>(view, column, row);
                const optics::Light<F> light = by_lens ? light_of(pixels) : light_of_points(pixels, column, row);
                for (int k = 0; k < Packet::lanes; ++k) {
                    const std::int32_t c = column + k % Packet::width, r = row + k / Packet::width;
                    if (c < tile.x0 || c >= tile.x1 || r < tile.y0 || r >= tile.y1) continue;
                    float* const out = tile.out + (std::int64_t(r - tile.crop_y) * tile.crop_width + (c - tile.crop_x)) * 3;
                    for (int q = 0; q < 3; ++q) out[q] = light(k, q);
                }
            }
    }

  private:
    /// Returns the light of a packet by 16 points for each sample, where there is no list of lenses.
    optics::Light<F> light_of_points(const optics::PixelRays<F>& pixels, std::int32_t column, std::int32_t row) const {
        std::uint32_t lane[optics::Block<F>::lanes];
        for (int k = 0; k < optics::Block<F>::lanes; ++k)
            lane[k] = std::uint32_t((row + k / optics::Block<F>::width) * view.width + column + k % optics::Block<F>::width);
        const int samples = 16 * tile.strata * tile.strata;
        optics::Sampler<F> sampler(tile.sampling, dimensions, view.seed, optics::load<F>(lane));
        optics::Light<F> light;
        for (int k = 0; k < samples; ++k) {
            SampleCoordinates<F> coordinates{};
            for (int d = 0; d < dimensions; ++d) coordinates.of[d] = sampler(d);
            optics::PanelPoint<F> end = trace(pixels, coordinates, pixels.alive);
            end.weight = end.weight * F(S(1) / S(samples));
            light.add(display.emission, tile.texels, optics::Fetch<F>(optics::panel_pixel(display, pixels.base, end)));
            sampler.next(*tile.directions);
        }
        return light;
    }

    /// Returns the light of a packet of the group: for each cell of the other coordinates' grids, the sum over the lenses.
    optics::Light<F> light_of(const optics::PixelRays<F>& pixels) {
        optics::Light<F> light;
        const int domain_pair = domain / 2;
        int other[2], others = 0, cells[2] = {1, 1};
        for (int q = 0; q < dimensions / 2; ++q)
            if (q != domain_pair) other[others] = q, cells[others++] = divisions[q] * divisions[q];
        for (int a = 0; a < cells[0]; ++a)
            for (int b = 0; b < cells[1]; ++b) {
                SampleCoordinates<F> coordinates;
                for (F& of : coordinates.of) of = F(0);
                S width[optics::sampler_dimensions] = {};  // of a cell, in its coordinates
                for (int k = 0; k < others; ++k) {
                    const int n = divisions[other[k]], cell = k == 0 ? a : b;
                    const auto middle = [n](int at) { return (S(at) + S(0.5)) * (S(2) / S(n)) - S(1); };
                    coordinates.of[2 * other[k]] = F(middle(cell % n));
                    coordinates.of[2 * other[k] + 1] = F(middle(cell / n));
                    // A disk's variance along an axis, r^2/4, is that of a box sqrt(3) r wide.
                    width[2 * other[k]] = width[2 * other[k] + 1] = other[k] == 2 ? S(1.7320508) / S(n) : S(2) / S(n);
                }
                const DomainMap<F> map = map_of(pixels, coordinates);
                for (int k = 0; k < count; ++k)
                    add_lens(pixels, coordinates, map, lenses[k], width, F(S(1) / S(cells[0] * cells[1])), light);
            }
        return light;
    }

    /// Adds the light that comes through one lens. `coordinates` are those of the middle of a cell of the other pairs, `width` that
    /// cell's size in its coordinates, `share` its share of their domain, `map` the map there.
    void add_lens(const optics::PixelRays<F>& pixels, SampleCoordinates<F> coordinates, const DomainMap<F>& map,
                  const VisibleLens& lens, const S (&width)[optics::sampler_dimensions], F share, optics::Light<F>& light) {
        const F zero = F(0), one = F(1), half = F(S(0.5));
        // The box about the lens's outline within the domain
        const optics::LensOutline<F> outline = outline_of(map, {lens.i, lens.j});
        optics::Box<F> bounds{F(S(1e30)), F(S(-1e30)), F(S(1e30)), F(S(-1e30))};
        for (int k = 0; k < outline.count; ++k)
            bounds = {optics::min(bounds.left, outline.x[k]), optics::max(bounds.right, outline.x[k]),
                      optics::min(bounds.low, outline.y[k]), optics::max(bounds.high, outline.y[k])};
        if (display.hole_radius > S(0) && !display.lit_between) {  // the ellipse's ends
            const optics::Vec2<S> axis = optics::axis_of(display.lattice, optics::Cell<S>{lens.i, lens.j});
            const F u = map.u_of(F(axis.x) - map.x, F(axis.y) - map.y), v = map.v_of(F(axis.x) - map.x, F(axis.y) - map.y),
                    size = F(display.hole_radius) * optics::abs(map.per_area),
                    reach_u = size * optics::sqrt(map.x_v * map.x_v + map.y_v * map.y_v),
                    reach_v = size * optics::sqrt(map.x_u * map.x_u + map.y_u * map.y_u);
            bounds = {u - reach_u, u + reach_u, v - reach_v, v + reach_v};
        }
        bounds = {optics::max(bounds.left, -one), optics::min(bounds.right, one), optics::max(bounds.low, -one),
                  optics::min(bounds.high, one)};
        const optics::Mask<F> visible = (bounds.right > bounds.left) && (bounds.high > bounds.low) && pixels.alive;
        if (!any(visible)) return;
        // The box is cut into cells about as wide as those of the whole domain: max(1, ceil(n R/2 - 0.3)) of a box R wide.
        const auto cells = [&](F size) {
            const F n = F(S(0.5) * S(divisions[domain / 2])) * size - F(S(FilteredLimits::cell_to_spare));
            return optics::max(optics::min(zero - optics::floor(zero - n), F(S(most_divisions))), one);
        };
        const F columns = select(visible, cells(bounds.right - bounds.left), zero),
                rows = select(visible, cells(bounds.high - bounds.low), zero);
        const F du = (bounds.right - bounds.left) / optics::max(columns, one),
                dv = (bounds.high - bounds.low) / optics::max(rows, one);
        const auto most = [](F a) {
            int n = 0;
            while (any(a > F(S(n)))) ++n;
            return n;
        };
        // A ray through the middle of each cell's part in the lens
        const int all_columns = most(columns), all_rows = most(rows);
        for (int j = 0; j < all_rows; ++j)
            for (int i = 0; i < all_columns; ++i) {
                optics::Box<F> cell{bounds.left + F(S(i)) * du, zero, bounds.low + F(S(j)) * dv, zero};
                cell.right = cell.left + du;
                cell.high = cell.low + dv;
                const optics::Mask<F> there = (F(S(i)) < columns) && (F(S(j)) < rows);
                memory.part[j * all_columns + i] = part_of(map, {lens.i, lens.j}, outline, cell, there);
                LensPart& part = memory.part[j * all_columns + i];
                part.share = part.share * share;
                const optics::Mask<F> counts = part.share > zero;
                part.end.alive = zero > one;
                if (!any(counts)) continue;
                coordinates.of[domain] = part.u;
                coordinates.of[domain + 1] = part.v;
                part.end = trace(pixels, coordinates, counts);
            }
        const optics::Vec2<S> axis = optics::axis_of(display.lattice, optics::Cell<S>{lens.i, lens.j});
        // The spread of each pair of the other coordinates on the panel
        optics::PanelCovariance<F> others[3] = {};
        for (int d = 0; d < dimensions; ++d)
            if (d / 2 != domain / 2) others[d / 2].add(F(lens.by.column[d] * width[d]), F(lens.by.row[d] * width[d]));
        // The footprint of each part: how far its edges are apart on the panel, by differences to the rays of neighbouring cells
        for (int j = 0; j < all_rows; ++j)
            for (int i = 0; i < all_columns; ++i) {
                const LensPart& part = memory.part[j * all_columns + i];
                if (!any(part.end.alive && (part.share > zero))) continue;
                F edge[2][2];  // of the part along each coordinate: columns and rows
                for (int a = 0; a < 2; ++a) {
                    const int at = a == 0 ? i : j, last = (a == 0 ? all_columns : all_rows) - 1, step = a == 0 ? 1 : all_columns;
                    F slope_c = zero, slope_r = zero, sides = zero;
                    for (int to = -1; to <= 1; to += 2) {
                        if (at + to < 0 || at + to > last) continue;
                        const LensPart& next = memory.part[j * all_columns + i + to * step];
                        const optics::Mask<F> alike = next.end.alive && (next.share > zero) &&
                                                      (next.end.cell.i == part.end.cell.i) && (next.end.cell.j == part.end.cell.j);
                        const F d = a == 0 ? next.u - part.u : next.v - part.v, per = one / select(alike, d, one);
                        slope_c = slope_c + select(alike, (next.end.column - part.end.column) * per, zero);
                        slope_r = slope_r + select(alike, (next.end.row - part.end.row) * per, zero);
                        sides = sides + select(alike, one, zero);
                    }
                    const F mean = select(sides > one, half, one), size = F(S(2)) * (a == 0 ? part.half_u : part.half_v);
                    optics::Mask<F> has = sides > zero;
                    const optics::Mask<F> isolated = part.end.alive && (part.share > zero) && !has;
                    if (any(isolated)) {  // one more ray, between the part's middle and its end towards the lens's axis
                        const F at_axis = a == 0 ? map.u_of(F(axis.x) - map.x, F(axis.y) - map.y)
                                                 : map.v_of(F(axis.x) - map.x, F(axis.y) - map.y);
                        const F middle = a == 0 ? part.u : part.v, aside = optics::max(F(S(0.25)) * size, F(S(0.01)));
                        const F to = select(at_axis < middle, zero - aside, aside);
                        coordinates.of[domain] = a == 0 ? part.u + to : part.u;
                        coordinates.of[domain + 1] = a == 0 ? part.v : part.v + to;
                        const optics::PanelPoint<F> beside = trace(pixels, coordinates, isolated);
                        const optics::Mask<F> alike =
                            isolated && beside.alive && (beside.cell.i == part.end.cell.i) && (beside.cell.j == part.end.cell.j);
                        slope_c = select(alike, (beside.column - part.end.column) / to, slope_c);
                        slope_r = select(alike, (beside.row - part.end.row) / to, slope_r);
                        has = has || alike;
                    }
                    edge[a][0] = size * select(has, slope_c * mean, F(lens.by.column[domain + a]));
                    edge[a][1] = size * select(has, slope_r * mean, F(lens.by.row[domain + a]));
                }
                add_boxes(pixels, part, edge, others, light);
            }
    }

    /// Adds the light about the end of a part's ray. `edge`: the parallelogram's edges along u and v, as columns and rows;
    /// `others`: the spreads by the other pairs of coordinates. Where pixels emit over their whole area, an oblique parallelogram
    /// is read as boxes side by side; the widest spread is the box, and all others together are two points of Gauss's rule along
    /// each axis.
    LFDSIM_FN void add_boxes(const optics::PixelRays<F>& pixels, const LensPart& part, const F (&edge)[2][2],
                             const optics::PanelCovariance<F> (&others)[3], optics::Light<F>& light) const {
        using L = FilteredLimits;
        const F zero = F(0), one = F(1), half = F(S(0.5));
        optics::PanelCovariance<F> other{};
        for (const optics::PanelCovariance<F>& of : others) {
            other.w2 = other.w2 + of.w2;
            other.h2 = other.h2 + of.h2;
            other.c = other.c + of.c;
        }
        // The parallelogram is cut into pieces along its more oblique edge.
        const auto pieces_along = [&](int a) {
            const int across = 1 - a;
            const F upright = optics::sqrt(edge[across][across] * edge[across][across] + (across == 0 ? other.w2 : other.h2));
            const F skew = optics::abs(edge[a][across]);
            const F n = optics::min(zero - optics::floor(zero - skew / (F(S(L::oblique_edge)) * upright + F(S(1e-6)))),
                                    F(S(L::most_boxes)));
            return select((skew > F(S(L::oblique_edge)) * upright) && (skew > F(S(L::oblique_edge))), n, one);
        };
        F pieces_u = pieces_along(0), pieces_v = pieces_along(1);
        const optics::Mask<F> by_u = pieces_u > pieces_v;
        pieces_u = select(by_u, pieces_u, one);
        pieces_v = select(by_u, one, pieces_v);
        // With a black matrix or subpixels, light that spreads along an oblique line is read along it, and other light as one box.
        optics::Mask<F> counts = part.end.alive;
        if (!tile.panel.whole) {
            optics::PanelCovariance<F> of_domain{};
            for (int a = 0; a < 2; ++a) of_domain.add(edge[a][0], edge[a][1]);
            const F area2 = (of_domain.w2 + other.w2) * (of_domain.h2 + other.h2),
                    skew = optics::abs(of_domain.c) + optics::abs(other.c);
            const optics::Mask<F> oblique =
                counts && (skew * skew > F(S(FilteredLimits::oblique_line * FilteredLimits::oblique_line)) * area2);
            if (any(oblique))
                optics::add_spread(tile.panel, pixels.base, part.end.column, part.end.row, of_domain, other,
                                   select(oblique, part.end.weight * part.share, zero), light);
            counts = counts && !oblique;
            pieces_u = pieces_v = one;
        }
        const F pieces = pieces_u * pieces_v, per = one / pieces;
        const F along_c = select(by_u, edge[0][0], edge[1][0]), along_r = select(by_u, edge[0][1], edge[1][1]);
        F wide = optics::abs(edge[0][0]) / pieces_u + optics::abs(edge[1][0]) / pieces_v,
          high = optics::abs(edge[0][1]) / pieces_u + optics::abs(edge[1][1]) / pieces_v;
        // The widest of all spreads is the box; the others have the variance sum/12, as two points at +- sqrt(sum/12) =
        // sqrt(sum)/(2 sqrt 3).
        F aside_x = zero, aside_y = zero;
        if (dimensions > 2) {
            const auto split = [&](F& size, F largest_other, F others2, F& aside) {
                const F largest = optics::max(size * size, largest_other), sum = size * size + others2;
                aside = F(S(0.28867513)) * optics::sqrt(optics::max(sum - largest, zero));
                size = optics::sqrt(largest);
                aside = select(aside > F(S(L::aside)) * size, aside, zero);
            };
            split(wide, optics::max(optics::max(others[0].w2, others[1].w2), others[2].w2), other.w2, aside_x);
            split(high, optics::max(optics::max(others[0].h2, others[1].h2), others[2].h2), other.h2, aside_y);
        }
        // All pieces, each at one, two or four points
        const bool twice_x = any(aside_x > zero), twice_y = any(aside_y > zero);
        const F points = select(aside_x > zero, F(S(2)), one) * select(aside_y > zero, F(S(2)), one);
        const F weight = select(counts, part.end.weight * part.share * per / points, zero);
        for (int n = 0; any((weight > zero) && (F(S(n)) < pieces)); ++n) {
            const F off = (F(S(n)) + half) * per - half;
            const F column = part.end.column + select(pieces > one, off * along_c, zero),
                    row = part.end.row + select(pieces > one, off * along_r, zero);
            for (int q = 0; q < 4; ++q) {
                const bool right = q % 2 == 1, below = q >= 2;
                if ((right && !twice_x) || (below && !twice_y)) continue;
                const optics::Mask<F> there =
                    (F(S(n)) < pieces) && (!right ? zero < one : aside_x > zero) && (!below ? zero < one : aside_y > zero);
                optics::add_light(tile.panel, pixels.base,
                                  optics::Boxes<F>{right ? column + aside_x : column - aside_x,
                                                   below ? row + aside_y : row - aside_y, wide, high, select(there, weight, zero)},
                                  light);
            }
        }
    }

    LensByLensMemory& memory;
};

/// Renders a tile lens by lens. Not inlined, so that its stack frame is separate.
__attribute__((noinline)) bool render_lens_by_lens(const Tile& tile) {
    LensByLens estimator(tile, *new (block_memory(sizeof(LensByLensMemory))) LensByLensMemory);
    Cancelling cancelling(tile);
    constexpr std::int32_t side = optics::shared_width;
    for (std::int32_t y = tile.y0 / side * side; y < tile.y1; y += side)
        for (std::int32_t x = tile.x0 / side * side; x < tile.x1; x += side) {
            if (cancelling.ends_before(std::int64_t(tile.strata) * tile.strata * side * side)) return false;
            estimator.render(x, y);
        }
    return true;
}

}  // namespace

}  // namespace lfdsim
