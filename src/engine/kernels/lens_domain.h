// The estimator `lens_by_lens`: the map from the sample domain to the plane of the holes, and the parts of the domain in a lens.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/estimator/outline.h"
#include "engine/kernels/filtered_axis.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

using optics::any;
using optics::select;

/// The coordinates of a sample, in the form in which sample_ray() takes them.
template <class G>
struct SampleCoordinates {
    G of[optics::sampler_dimensions];
    LFDSIM_FN G operator()(int d) const { return of[d]; }
};

/// The affine map from the domain to the plane of the holes about the middle of the domain: (x, y) + u (x_u, y_u) + v (x_v, y_v),
/// mm in the array's frame.
template <class G>
struct DomainMap {
    G x, y, x_u, y_u, x_v, y_v, per_area;  // per_area: 1 over the determinant x_u y_v - x_v y_u

    /// Returns the coordinate u, or v, of the point at (dx, dy) from (x, y): the inverse of the map.
    LFDSIM_FN G u_of(G dx, G dy) const { return (dx * y_v - dy * x_v) * per_area; }
    LFDSIM_FN G v_of(G dx, G dy) const { return (dy * x_u - dx * y_u) * per_area; }
};

/// A part of a lens in the domain: one cell of the grid over its outline.
struct LensPart {
    F share, u, v, half_u, half_v;  // of the domain; the part's middle; half of its width and height
    optics::PanelPoint<F> end;      // of the ray through the middle
};

/// The sample domain, which the lenses' outlines cut, and a sample's rays.
class LensDomain {
  public:
    explicit LensDomain(const Tile& t)
        : tile(t), display(*t.display), view(*t.view), domain(tile.cuts_pixel ? 2 : 0), dimensions(t.dimensions) {}

    /// Returns the points at which rays with these coordinates cross the plane of the holes, mm from the base lens's axis in the
    /// array's frame.
    template <class G>
    LFDSIM_FN optics::Vec2<G> at_holes(const optics::PixelRays<G>& pixels, const SampleCoordinates<G>& coordinates) const {
        optics::Ray<G> ray;
        optics::sample_ray(display, view, pixels, coordinates, ray);
        optics::Vec2<G> to{ray.to.x, ray.to.y};
        if (display.rotated) to = optics::to_array(display.lattice, to.x, to.y);
        const G per = G(-1) / ray.to.z;
        return {ray.at.x + to.x * per * G(display.holes_below[0]), ray.at.y + to.y * per * G(display.holes_below[1])};
    }
    /// Returns the map, by central differences at +-1/2, half way from the middle of the domain to its ends. `coordinates` has the
    /// other coordinates.
    template <class G>
    LFDSIM_FN DomainMap<G> map_of(const optics::PixelRays<G>& pixels, SampleCoordinates<G> coordinates) const {
        const G step = G(S(0.5)), zero = G(S(0));
        optics::Vec2<G> at[5];
        for (int k = 0; k < 5; ++k) {
            coordinates.of[domain] = k == 1 ? -step : k == 2 ? step : zero;
            coordinates.of[domain + 1] = k == 3 ? -step : k == 4 ? step : zero;
            at[k] = at_holes(pixels, coordinates);
        }
        DomainMap<G> map{at[0].x, at[0].y, at[2].x - at[1].x, at[2].y - at[1].y, at[4].x - at[3].x, at[4].y - at[3].y, zero};
        map.per_area = G(S(1)) / (map.x_u * map.y_v - map.x_v * map.y_u);
        return map;
    }

    /// Returns half the size, along x' and y', of the image of the domain's square [-width, width]^2 in the plane of the holes.
    template <class G>
    LFDSIM_FN static optics::Vec2<G> reach_of(const DomainMap<G>& map, G width) {
        return {width * (optics::abs(map.x_u) + optics::abs(map.x_v)), width * (optics::abs(map.y_u) + optics::abs(map.y_v))};
    }

    /// Calls f(i, j) for the cells of the lattice that a box about (x, y) may meet.
    template <class Do>
    void for_cells(S x, S y, S half_x, S half_y, const Do& f) const {
        const Lattice<S>& lattice = display.lattice;
        const S reach_y = optics::reach_of_cell(lattice);
        const S first_j = lattice.strips ? S(0) : optics::floor((y - half_y - reach_y) * lattice.per_pitch[1] + S(1)),
                last_j = lattice.strips ? S(0) : optics::floor((y + half_y + reach_y) * lattice.per_pitch[1]);
        for (S j = first_j; j <= last_j; ++j) {
            const S from = x - (lattice.staggered ? optics::stagger(lattice, j) : S(0));
            const S first_i = optics::floor((from - half_x) * lattice.per_pitch[0] + S(0.5)),
                    last_i = optics::floor((from + half_x) * lattice.per_pitch[0] + S(0.5));
            for (S i = first_i; i <= last_i; ++i) f(i, j);
        }
    }

    /// Returns the outline of a lens's cell in the domain's coordinates: w = A^-1 (corner - h0) (docs/model.md, "Lens by lens"). A
    /// strip has no end; its outline reaches over all of the domain.
    template <class G>
    LFDSIM_FN optics::LensOutline<G> outline_of(const DomainMap<G>& map, optics::Cell<S> lens) const {
        const Lattice<S>& lattice = display.lattice;
        const optics::Vec2<S> axis = optics::axis_of(lattice, lens);
        const G to_x = G(axis.x) - map.x, to_y = lattice.strips ? G(S(0)) : G(axis.y) - map.y;
        optics::LensOutline<G> outline;
        optics::CellCorners<S> cell = optics::corners_of_cell(lattice);
        if (lattice.strips)
            for (int k = 0; k < 4; ++k) {
                // Between strips light may go on beside them: their cells then meet.
                if (!display.lit_between) cell.x[k] = k < 2 ? display.hole_half : -display.hole_half;
                cell.y[k] = k == 1 || k == 2 ? S(1) : S(-1);
            }
        outline.count = cell.count;
        const G along = lattice.strips ? S(2) * reach_of(map, G(S(1))).y : G(S(1));
        for (int k = 0; k < outline.count; ++k) {
            const G dx = to_x + G(cell.x[k]), dy = to_y + G(cell.y[k]) * along;
            outline.x[k] = map.u_of(dx, dy);
            outline.y[k] = map.v_of(dx, dy);
        }
        return outline;
    }

    /// Returns the ends of rays with these coordinates on the panel.
    optics::PanelPoint<F> trace(const optics::PixelRays<F>& pixels, const SampleCoordinates<F>& coordinates,
                                optics::Mask<F> some) const {
        optics::Ray<F> ray;
        optics::sample_ray(display, view, pixels, coordinates, ray);
        return optics::trace_any<F>(display, pixels.extent, pixels.base, ray, some && pixels.alive);
    }

    /// Returns the part of a cell of the domain that lies in a round hole: |(x, y)| <= r, an ellipse in the domain. Six points of
    /// Gauss's rule along v between the part's ends, each with the chord along u. (from_x, from_y): from the hole's axis to (map.x,
    /// map.y).
    template <class G>
    LFDSIM_FN optics::Moments<G> part_in_hole(const DomainMap<G>& map, G from_x, G from_y, const optics::Box<G>& cell) const {
        const G zero = G(0), one = G(1), half = G(S(0.5)), radius2 = G(display.hole_radius * display.hole_radius);
        const G size2 = map.x_u * map.x_u + map.y_u * map.y_u, per = one / size2;
        // The ellipse's ends in v.
        const G middle = zero - map.v_of(from_x, from_y), reach = optics::sqrt(radius2 * size2) * optics::abs(map.per_area);
        const G low = optics::max(cell.low, middle - reach), high = optics::min(cell.high, middle + reach),
                span = optics::max(high - low, zero);
        constexpr S node[6] = {S(0.033765243), S(0.169395307), S(0.380690407), S(0.619309593), S(0.830604693), S(0.966234757)},
                    weight[6] = {S(0.085662246), S(0.180380787), S(0.233956967), S(0.233956967), S(0.180380787), S(0.085662246)};
        const G centre_u = half * (cell.left + cell.right), centre_v = half * (cell.low + cell.high);
        G sum = zero, sum_u = zero, sum_v = zero, sum_uu = zero, sum_vv = zero;
        for (int k = 0; k < 6; ++k) {
            const G v = low + span * G(node[k]), x = from_x + map.x_v * v, y = from_y + map.y_v * v;
            // The chord: |(x, y) + u (x_u, y_u)|^2 = r^2, so u = -b +- sqrt(b^2 - (x^2 + y^2 - r^2)/size2)
            const G b = (x * map.x_u + y * map.y_u) * per,
                    root = optics::sqrt(optics::max(b * b - (x * x + y * y - radius2) * per, zero));
            const G left = optics::max(cell.left, zero - b - root), right = optics::min(cell.right, root - b),
                    wide = optics::max(right - left, zero);
            const G part = wide * G(weight[k]), at_u = half * (left + right) - centre_u, at_v = v - centre_v;
            sum = sum + part;
            sum_u = sum_u + part * at_u;
            sum_v = sum_v + part * at_v;
            sum_uu = sum_uu + part * (at_u * at_u + wide * wide * G(S(1.0 / 12)));
            sum_vv = sum_vv + part * at_v * at_v;
        }
        const G per_sum = one / optics::max(sum, G(S(1e-12))), u = sum_u * per_sum, v = sum_v * per_sum;
        const auto half_width = [&](G variance) { return optics::sqrt(G(S(3)) * optics::max(variance, zero)); };
        return {sum * span, centre_u + u, centre_v + v, half_width(sum_uu * per_sum - u * u), half_width(sum_vv * per_sum - v * v)};
    }
    /// Returns whether the hole contains a cell of the domain: whether it contains its four corners.
    LFDSIM_FN optics::Mask<F> hole_contains(const DomainMap<F>& map, F from_x, F from_y, const optics::Box<F>& cell) const {
        F most = F(0);
        for (int k = 0; k < 4; ++k) {
            const F u = k % 2 == 1 ? cell.right : cell.left, v = k >= 2 ? cell.high : cell.low;
            const F x = from_x + map.x_u * u + map.x_v * v, y = from_y + map.y_u * u + map.y_v * v;
            most = optics::max(most, x * x + y * y);
        }
        return most <= F(display.hole_radius * display.hole_radius);
    }

    /// Returns the part of a cell of the domain that lies in a lens, with its share of the domain, whose area is 4. Where the lens
    /// contains the cell, that is the cell itself. Shares below 1e-7 count as 0.
    LFDSIM_FN LensPart part_of(const DomainMap<F>& map, optics::Cell<S> lens, const optics::LensOutline<F>& outline,
                               const optics::Box<F>& cell, optics::Mask<F> there) const {
        const F zero = F(0), half = F(S(0.5)), du = cell.right - cell.left, dv = cell.high - cell.low;
        LensPart part{
            F(S(0.25)) * du * dv, half * (cell.left + cell.right), half * (cell.low + cell.high), half * du, half * dv, {}};
        const bool round = display.hole_radius > S(0) && !display.lit_between;
        const optics::Vec2<S> axis = optics::axis_of(display.lattice, lens);
        const F from_x = map.x - F(axis.x), from_y = map.y - (display.lattice.strips ? map.y : F(axis.y));
        const optics::Mask<F> cut = there && !(round ? hole_contains(map, from_x, from_y, cell) : optics::contains(outline, cell));
        if (any(cut)) {
            const optics::Moments<F> of = round ? part_in_hole(map, from_x, from_y, cell) : optics::part_within(outline, cell);
            part.share = select(cut, F(S(0.25)) * of.area, part.share);
            part.u = select(cut, of.x, part.u);
            part.v = select(cut, of.y, part.v);
            part.half_u = select(cut, of.half_width, part.half_u);
            part.half_v = select(cut, of.half_height, part.half_v);
        }
        part.share = select(there && (part.share > F(S(1e-7))), part.share, zero);
        return part;
    }

    const Tile& tile;
    const optics::TracedDisplay<S>& display;
    const optics::RayOrigin& view;
    const int domain, dimensions;  // the domain's first coordinate; the number of coordinates of a sample
};

}  // namespace

}  // namespace lfdsim
