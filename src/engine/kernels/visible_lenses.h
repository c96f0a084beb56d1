// The estimator `lens_by_lens`: the lenses visible to a group of 4 x 4 pixels, and the derivatives of their rays' ends.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/estimator/limits.h"
#include "engine/kernels/lens_domain.h"
#include "optics/camera.h"

namespace lfdsim {

namespace {

/// The derivatives of a ray's end on the panel by each of its sample coordinates, panel pixels.
struct Derivatives {
    S column[optics::sampler_dimensions], row[optics::sampler_dimensions];
    bool known;  // the ray reaches the panel
};

constexpr int most_divisions = max_strata;  // of a coordinate
constexpr int most_visible_lenses = 256;    // to a group

/// A lens that is visible to the pixels of a group.
struct VisibleLens {
    S i, j;  // its cell, from the group's base lens
    Derivatives by;
};

/// The lenses visible to a group of pixels, and the number of cells into which each pair of sample coordinates is divided.
class VisibleLenses : public LensDomain {
  public:
    /// `padded`: memory for most_visible_lenses.
    VisibleLenses(const Tile& t, VisibleLens* padded) : LensDomain(t), lenses(padded) {}

    /// Lists the lenses visible to a group, with the derivatives of their rays; false: there are too many, or the domain has no
    /// area.
    bool list_lenses(std::int32_t x, std::int32_t y) {
        // The group's middle, as the packets' rays are: relative to the base lens that they share.
        const double middle_x = x + side / 2, middle_y = y + side / 2;
        const optics::BaseLens<S> base = optics::base_lens<S>(view, middle_x, middle_y);
        const auto ray_at = [&](double column, double row) {
            double d[3], px, py;
            optics::follow_to_first_plane(view, column, row, d, px, py);
            const double inverse = 1 / __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
            const S z = S(d[2] * inverse);
            return optics::PixelRays<S>{S(px - base.x), S(py - base.y), {S(d[0] * inverse), S(d[1] * inverse), z},
                                        S(inverse),     z < S(-1e-9),   base.extent,
                                        base.panel};
        };
        const optics::PixelRays<S> middle = ray_at(middle_x, middle_y);
        count = 0;
        for (S& of : spread) of = 0;
        if (!middle.alive) return false;
        const SampleCoordinates<S> none{};
        const DomainMap<S> map = map_of(middle, none);
        if (!(optics::abs(map.per_area) < S(1e12))) return false;
        // The motion over the plane of the holes due to the group's pixels and to coordinates other than the domain's: in mm and in
        // the domain's coordinates.
        optics::Vec2<S> half = reach_of(map, S(1)), more{S(0), S(0)};
        S widen_u = 0, widen_v = 0;
        const auto moved = [&](optics::Vec2<S> to) {
            const S dx = to.x - map.x, dy = to.y - map.y;
            more = {more.x + optics::abs(dx), more.y + optics::abs(dy)};
            widen_u = widen_u + optics::abs(map.u_of(dx, dy));
            widen_v = widen_v + optics::abs(map.v_of(dx, dy));
        };
        moved(at_holes(ray_at(middle_x + side / 2, middle_y), none));
        moved(at_holes(ray_at(middle_x, middle_y + side / 2), none));
        for (int d = 0; d < dimensions; ++d) {
            if (d / 2 == domain / 2) continue;
            SampleCoordinates<S> one = none;
            one.of[d] = 1;
            moved(at_holes(middle, one));
        }
        half = {half.x + more.x, half.y + more.y};
        const S columns = S(2) * half.x * display.lattice.per_pitch[0] + S(2),
                rows = display.lattice.strips ? S(1) : S(2) * half.y * display.lattice.per_pitch[1] + S(2);
        if (!(columns * rows < S(2 * most_visible_lenses))) return false;
        // The lenses whose part of the widened domain has an area, with derivatives at the middle of that part; the spread of each
        // pair of coordinates over the panel is the mean over lenses, weighted by their areas.
        const optics::Box<S> widened{-1 - widen_u, 1 + widen_u, -1 - widen_v, 1 + widen_v};
        S weight = 0;
        for_cells(map.x, map.y, half.x, half.y, [&](S i, S j) {
            if (!display.lit_between && !base.extent.holds(optics::Cell<S>{i, j})) return;
            const optics::Vec2<S> axis = optics::axis_of(display.lattice, optics::Cell<S>{i, j});
            optics::Moments<S> part = display.hole_radius > S(0) && !display.lit_between
                                          ? part_in_hole(map, map.x - axis.x, map.y - axis.y, widened)
                                          : optics::part_within(outline_of(map, {i, j}), widened);
            if (!(part.area > 0)) return;
            if (count++ >= most_visible_lenses) return;
            VisibleLens& lens = lenses[count - 1];
            lens.i = i;
            lens.j = j;
            lens.by = derivatives_at(middle, part);
            if (!lens.by.known) {  // hidden by another lens, perhaps: through the lens's middle
                part.x = map.u_of(axis.x - map.x, display.lattice.strips ? S(0) : axis.y - map.y);
                part.y = map.v_of(axis.x - map.x, display.lattice.strips ? S(0) : axis.y - map.y);
                lens.by = derivatives_at(middle, part);
            }
            if (!lens.by.known) return;
            weight = weight + part.area;
            for (int d = 0; d < dimensions; ++d)
                spread[d / 2] = spread[d / 2] + part.area * (optics::abs(lens.by.column[d]) + optics::abs(lens.by.row[d]));
        });
        for (S& of : spread) of = weight > 0 ? of / weight : S(0);
        divide();
        return count <= most_visible_lenses;
    }

    /// Returns the derivatives at the middle of a part. Traces the ray through it, and rays to both sides of it in each coordinate,
    /// all from the group's middle: the derivative is the mean of both differences, or one of them where the other ray is lost or
    /// ends under another lens, or 0.
    Derivatives derivatives_at(const optics::PixelRays<S>& middle, const optics::Moments<S>& part) const {
        // Ray 0 is the middle's; rays 2 d + 1 and 2 d + 2 are a step ahead and behind in coordinate d.
        constexpr int rays = 1 + 2 * optics::sampler_dimensions, lanes = optics::LaneTraits<F>::width,
                      padded = (rays + lanes - 1) / lanes * lanes;
        S coordinates[optics::sampler_dimensions][padded] = {}, step[optics::sampler_dimensions];
        for (int d = 0; d < optics::sampler_dimensions; ++d) step[d] = S(0.25);
        step[domain] = optics::max(S(0.5) * part.half_width, S(0.01));
        step[domain + 1] = optics::max(S(0.5) * part.half_height, S(0.01));
        for (int k = 0; k < padded; ++k) {
            coordinates[domain][k] = part.x;
            coordinates[domain + 1][k] = part.y;
        }
        for (int d = 0; d < dimensions; ++d) {
            coordinates[d][2 * d + 1] = coordinates[d][2 * d + 1] + step[d];
            coordinates[d][2 * d + 2] = coordinates[d][2 * d + 2] - step[d];
        }
        // All rays, a packet at a time
        S column[padded], row[padded], lit[padded], i[padded], j[padded];
        const optics::PixelRays<F> same{F(middle.x),          F(middle.y), {F(middle.to.x), F(middle.to.y), F(middle.to.z)},
                                        F(middle.per_length), F(0) < F(1), middle.extent,
                                        middle.base};
        for (int k = 0; k < padded; k += lanes) {
            SampleCoordinates<F> of;
            for (int d = 0; d < optics::sampler_dimensions; ++d) of.of[d] = optics::load<F>(coordinates[d] + k);
            const optics::PanelPoint<F> end = trace(same, of, same.alive);
            optics::store(end.column, column + k);
            optics::store(end.row, row + k);
            optics::store(select(end.alive, F(1), F(0)), lit + k);
            optics::store(end.cell.i, i + k);
            optics::store(end.cell.j, j + k);
        }
        // Differences to the middle's ray
        Derivatives by{};
        by.known = lit[0] > 0;
        if (!by.known) return by;
        for (int d = 0; d < dimensions; ++d) {
            S sides = 0;
            for (int k = 1 + 2 * d; k < 3 + 2 * d; ++k) {
                if (!(lit[k] > 0 && i[k] == i[0] && j[k] == j[0])) continue;
                const S per = (k % 2 == 1 ? S(1) : S(-1)) / step[d];
                by.column[d] = by.column[d] + (column[k] - column[0]) * per;
                by.row[d] = by.row[d] + (row[k] - row[0]) * per;
                sides = sides + 1;
            }
            if (sides == 2) by.column[d] = S(0.5) * by.column[d], by.row[d] = S(0.5) * by.row[d];
        }
        return by;
    }

    /// Divides the pairs of coordinates, N = strata^2 cells in all at most: always the pair with the largest spread on the panel
    /// per division. The widest of the pairs other than the domain is read as a box, so it counts less.
    void divide() {
        const int pairs = dimensions / 2, domain_pair = domain / 2, most = tile.strata * tile.strata;
        for (int& n : divisions) n = 1;
        S of[3] = {spread[0], spread[1], spread[2]};
        int widest = -1;
        for (int q = 0; q < pairs; ++q)
            if (q != domain_pair && (widest < 0 || of[q] > of[widest])) widest = q;
        if (widest >= 0) of[widest] = of[widest] * S(FilteredLimits::boxed_spread);
        of[domain_pair] = optics::max(of[domain_pair], S(0.5) * (spread[0] + spread[1] + spread[2]));
        if (pairs == 1) {
            divisions[domain_pair] = tile.strata;
            return;
        }
        for (;;) {
            int best = -1;
            const int product = divisions[0] * divisions[0] * divisions[1] * divisions[1] * divisions[2] * divisions[2];
            for (int q = 0; q < pairs; ++q) {
                const int n = divisions[q], next = product / (n * n) * (n + 1) * (n + 1);
                if (next <= most && n < most_divisions && (best < 0 || of[q] / S(n) > of[best] / S(divisions[best]))) best = q;
            }
            if (best < 0) return;
            ++divisions[best];
        }
    }

    static constexpr int side = optics::shared_width;  // of a group
    VisibleLens* const lenses;
    int count = 0;                 // of visible lenses
    S spread[3] = {};              // of each pair of coordinates, over the panel, pixels
    int divisions[3] = {1, 1, 1};  // of each pair along both of its coordinates
};

}  // namespace

}  // namespace lfdsim
