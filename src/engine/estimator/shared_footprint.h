// Shared footprints: the area of the panel that a block of neighbouring pixels sees through a stratum, from a few rays. Floor 2.
//
// Neighbouring pixels look through the same point of a lens at nearly the same point of the panel. So a grid of rays, the probes,
// is traced through a stratum from the block's middle only. Their ends on the panel give the footprint: its mean position, its
// spread, and the share of light transmitted. Three rays from other points of the block show how the footprint moves from pixel to
// pixel, and whether this motion is linear. Where rays are lost, or end under different lenses, the block's pixels cannot share
// the footprint.
//
// Positions in the planes of diffuser and holes are in mm along the display's axes, from the axis of the block's base lens;
// positions on the panel are columns and rows, in panel pixels from where that axis meets the panel (PanelBase). The method is ray
// differentials by finite differences (Igehy 1999); docs/model.md, "Filtered estimator", and docs/design.md explain it.
#pragma once
#include "engine/estimator/limits.h"
#include "engine/estimator/panel_light.h"
#include "engine/estimator/probes.h"
#include "engine/estimator/strata.h"
#include "optics/camera.h"
#include "optics/diffuser.h"
#include "optics/trace.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The points of a block through which rays are followed to the diffuser: 0 its middle; 1 half a block to the right; 2 half a block
/// down; 3 half a block to the left and up. For any linear motion the offsets of 1, 2 and 3 from the middle add up to 0.
constexpr int block_rays = 4;
/// Returns a point's offset from the middle, to the right or down, in half blocks.
LFDSIM_FN int block_right(int ray) { return ray == 1 ? 1 : ray == 3 ? -1 : 0; }
LFDSIM_FN int block_down(int ray) { return ray == 2 ? 1 : ray == 3 ? -1 : 0; }

/// The light of a wide footprint is computed at its nodes, the corners of squares of FilteredLimits::node_step pixels: at most 3
/// x 3.
constexpr int most_nodes = 3;

/// A block of pixels whose rays are shared, and its four rays in the first plane of the display.
template <class S>
struct PixelBlock {
    int reach;                      // pixels from the block's middle to its border
    BaseLens<S> lens;               // the origin of x and y
    Vec3<S> to[block_rays];         // unit directions in the display's frame, before the diffuser
    Sweep<S> sweep[2][block_rays];  // along x' and y': where the diffuser sends the ray in the plane of the holes
    /// Returns the number of nodes along an axis: 3 of blocks of 16 x 16 pixels, 2 of smaller ones.
    LFDSIM_FN int nodes() const { return 2 * reach > FilteredLimits::node_step ? 2 * reach / FilteredLimits::node_step + 1 : 2; }
    bool alive;  // all rays reach the display, evenly spaced on it, and strata may treat the diffuser's two turns as independent
};

/// Returns whether all rays go down, at no grazing angle, after the diffuser's largest turn a: with the slope m = tan(phi) before
/// it, cos(phi + a)/cos(phi) = cos(a) - m sin(a) exceeds FilteredLimits::steepest. A ray turned past the horizontal does not meet
/// the plane of the holes, so it has no place in a stratum.
template <class S>
LFDSIM_FN bool all_go_down(const TracedDisplay<S>& display, const PixelBlock<S>& block) {
    for (int a = 0; a < 2; ++a) {
        S sine, cosine;
        sincos(diffuser_angle(display, a, S(1)), display.small_angles, sine, cosine);
        for (const Sweep<S>& sweep : block.sweep[a])
            if (!(cosine - abs(sweep.slope) * sine > S(FilteredLimits::steepest))) return false;
    }
    return true;
}

/// Returns whether strata may treat the diffuser's two turns as independent, as if each moved the ray along one axis only: the
/// light that comes from any point is then misjudged by less than the share `most`. Tested at the four corners of the sample
/// domain, from the block's middle.
///
/// The diffuser turns the unit direction i by a about y, after which its z component is z', then by b about x, to t. As the first
/// turn keeps y and the second x, z'^2 = 1 - t_x^2 - i_y^2. The Jacobian of the two turns gives the solid angle |z'| da db; seen
/// from the diffuser, dx dy in the plane H below spans |t_z|^3 dx dy / H^2. Equating both gives the true density of light on that
/// plane, da db / (dx dy). With the slopes s = t_x/t_z and s' = t_y/t_z the strata take da db = dx dy / (H^2 (1 + s^2) (1 + s'^2)).
/// `ratio` is the true density divided by that of the strata.
template <class S>
LFDSIM_FN bool turns_independent(const TracedDisplay<S>& display, const PixelBlock<S>& block, S most) {
    S tangent[2];
    for (int a = 0; a < 2; ++a) {
        S sine, cosine;
        sincos(display.angle_scale[a], display.small_angles, sine, cosine);
        tangent[a] = sine / cosine;
    }
    for (int corner = 0; corner < 4; ++corner) {
        S s[2];
        for (int a = 0; a < 2; ++a) {
            s[a] = block.sweep[a][0].turned(corner >> a & 1 ? tangent[a] : -tangent[a]);
        }
        const S xx = s[0] * s[0], yy = s[1] * s[1], n2 = S(1) + xx + yy, i_y = block.to[0].y, z2 = S(1) - xx / n2 - i_y * i_y;
        const S ratio = (S(1) + xx) * (S(1) + yy) / (n2 * sqrt(n2) * sqrt(max(z2, S(1e-6))));
        if (!(abs(ratio - S(1)) < most)) return false;
    }
    return true;
}

/// Returns the block of side x side pixels whose first is (column, row). Blocks lie on a grid of the whole frame.
template <class S>
LFDSIM_FN PixelBlock<S> pixel_block(const TracedDisplay<S>& display, const RayOrigin& view, int side, S most_misjudged,
                                    std::int32_t column, std::int32_t row) {
    PixelBlock<S> block;
    block.reach = side / 2;
    const double middle_x = column + block.reach, middle_y = row + block.reach;
    block.lens = base_lens<S>(view, middle_x, middle_y);
    block.alive = true;
    for (int k = 0; k < block_rays; ++k) {
        double d[3], x, y;
        follow_to_first_plane(view, middle_x + block.reach * block_right(k), middle_y + block.reach * block_down(k), d, x, y);
        const double inverse = 1 / __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double z = d[2] * inverse;
        block.to[k] = {S(d[0] * inverse), S(d[1] * inverse), S(z)};
        block.sweep[0][k] = {S(x - block.lens.x), S(-d[0] / d[2]), display.holes_below[0], S(sense(0))};
        block.sweep[1][k] = {S(y - block.lens.y), S(-d[1] / d[2]), display.holes_below[1], S(sense(1))};
        block.alive = block.alive && z < -1e-6;
    }
    // Linear motion of the rays over the block: the offsets of the three outer ones from the middle add up to 0.
    for (int a = 0; a < 2 && block.alive; ++a) {
        const Sweep<S>* s = block.sweep[a];
        const S bend = s[1].at + s[2].at + s[3].at - S(3) * s[0].at,
                turn = s[1].slope + s[2].slope + s[3].slope - S(3) * s[0].slope;
        block.alive = abs(bend) + abs(turn * display.holes_below[a]) < S(FilteredLimits::bend) * display.lattice.pitch[a];
    }
    block.alive = block.alive && all_go_down(display, block) && turns_independent(display, block, most_misjudged);
    return block;
}

/// Rays from points (at_x, at_y) of the diffuser's plane through points (x, y) of the plane of the holes, mm from the base lens's
/// axis; and where on the panel they end.
template <class S>
struct Probes {
    S at_x[most_probes], at_y[most_probes], x[most_probes], y[most_probes];
    S column[most_probes], row[most_probes], weight[most_probes];  // the ends; the transmitted share, 0: lost
    S cell_i[most_probes], cell_j[most_probes];                    // the lens
    S in[most_probes];                                             // 1: lies in the part of the stratum that is probed, else 0
    S has_right[most_probes], has_left[most_probes], has_above[most_probes], has_below[most_probes];  // 1: has that neighbour

    /// Arranges per_axis x per_axis probes, row after row. The rest count as lost: sums include them, but a narrow packet never
    /// traces them.
    LFDSIM_FN void lay_out(int per_axis) {
        for (int p = 0; p < most_probes; ++p) {
            column[p] = row[p] = weight[p] = cell_i[p] = cell_j[p] = in[p] = S(0);
            const int i = p % per_axis, j = p / per_axis;
            has_right[p] = i + 1 < per_axis ? S(1) : S(0);
            has_left[p] = i > 0 ? S(1) : S(0);
            has_above[p] = j + 1 < per_axis ? S(1) : S(0);
            has_below[p] = j > 0 ? S(1) : S(0);
        }
    }
};

/// Traces the first `count` probes (up to a full packet more) to the panel.
template <class F>
LFDSIM_FN void trace_probes(const TracedDisplay<Scalar<F>>& display, const PixelBlock<Scalar<F>>& block, Probes<Scalar<F>>& probes,
                            int count) {
    // The holes' edges across y' may lie at another height than those across x': the displacement in y is scaled to the plane of x;
    // the factor is 1 where both are the same plane.
    const F down = F(display.holes_below[0]), to_plane_x = F(display.holes_below[0] / display.holes_below[1]);
    for (int p = 0; p < min(count, most_probes); p += LaneTraits<F>::width) {
        const F x = load<F>(probes.at_x + p), y = load<F>(probes.at_y + p), across = load<F>(probes.x + p) - x,
                up = (load<F>(probes.y + p) - y) * to_plane_x;
        const F per = F(1) / sqrt(across * across + up * up + down * down);
        const PanelPoint<F> point = trace_any<F>(display, block.lens.extent, block.lens.panel,
                                                 Ray<F>{{x, y, F(0)}, {across * per, up * per, -(down * per)}}, F(0) < F(1));
        store(point.column, probes.column + p);
        store(point.row, probes.row + p);
        store(select(point.alive, point.weight, F(0)), probes.weight + p);
        store(point.cell.i, probes.cell_i + p);
        store(point.cell.j, probes.cell_j + p);
    }
}

/// The footprint of a block through a stratum, or through the part of it inside its round hole, or beside that hole. Its state:
/// - unlit: no ray reaches the panel;
/// - narrow: at most FilteredLimits::narrow panel pixels wide; each pixel reads one box of the panel;
/// - wide: wider; its light is the mean over a box around each probe, computed at nodes and interpolated between them;
/// - unshared: rays are lost, end under several lenses or move non-linearly, so the block's pixels cannot share the footprint.
template <class S>
struct SharedFootprint {
    enum class State { unlit, narrow, wide, unshared } state;
    S column, row;  // mean position on the panel, for rays from the block's middle: panel pixels from the block's base
    S column_right, row_right, column_down, row_down;  // its motion per picture pixel to the right and down
    S width, height;                                   // of a box of the same spread, panel pixels
    S weight;                                          // mean share of light transmitted over the part, lost rays counted as 0
    S x, y, probe_column, probe_row;                   // the probe nearest to the middle: mm, and its end on the panel
    S part_column[2], part_row[2];                     // narrow: motion of the visible part of its stratum, added to the above
    bool stationary;                                   // wide: the footprint is the same for all pixels of the block
    int nodes;                                         // wide: along an axis of the block; 1: its light is the same everywhere
};
/// A footprint with the light of a wide one.
template <class S>
struct LitFootprint : SharedFootprint<S> {
    alignas(16) S colour[most_nodes * most_nodes][4];  // wide: the light at its nodes; interpolated between them
};

/// Returns the footprint of a stratum's per_axis x per_axis probes, as far as they determine it: position, spread, transmitted
/// share. It is unlit if no probe reaches the panel, unshared if those that do pass several lenses or none is in the part, and else
/// counts as narrow until its width is tested.
template <class S>
LFDSIM_FN SharedFootprint<S> sum_up(const Probes<S>& probes, int per_axis) {
    using State = typename SharedFootprint<S>::State;
    S lit[most_probes], t[most_probes], c[most_probes], r[most_probes];
    for (int p = 0; p < most_probes; ++p) lit[p] = probes.in[p] * probes.weight[p] > S(0) ? S(1) : S(0);
    SharedFootprint<S> b;
    const S part = sum_of(probes.in), count = sum_of(lit);
    b.state = part > S(0) ? State::unlit : State::unshared;
    if (count == S(0)) return b;
    // Means over the lit probes, of positions relative to one of them
    bool is_lit[most_probes];
    for (int p = 0; p < most_probes; ++p) is_lit[p] = lit[p] > S(0);
    int one = first_probe(is_lit);
    const S per = S(1) / count;
    auto mean = [&](auto value) {
        for (int p = 0; p < most_probes; ++p) t[p] = lit[p] > S(0) ? value(p) : S(0);
        return sum_of(t) * per;
    };
    const S column = probes.column[one], row = probes.row[one], cell_i = probes.cell_i[one], cell_j = probes.cell_j[one];
    for (int p = 0; p < most_probes; ++p) {  // small numbers, so that squares lose no digits
        c[p] = probes.column[p] - column;
        r[p] = probes.row[p] - row;
    }
    const S mean_c = mean([&](int p) { return c[p]; }), mean_r = mean([&](int p) { return r[p]; });
    const S x = mean([&](int p) { return probes.x[p]; }), y = mean([&](int p) { return probes.y[p]; });
    b.column = column + mean_c;
    b.row = row + mean_r;
    b.weight = mean([&](int p) { return probes.weight[p]; }) * count / part;
    // n evenly spaced points across a box of width w have the variance w^2 / 12 (1 - 1/n^2); here n = per_axis.
    const S all = S(per_axis * per_axis), spread = S(12) * all / (all - S(1));
    b.width = sqrt(max(spread * (mean([&](int p) { return c[p] * c[p]; }) - mean_c * mean_c), S(0)));
    b.height = sqrt(max(spread * (mean([&](int p) { return r[p] * r[p]; }) - mean_r * mean_r), S(0)));
    const S others = mean([&](int p) { return probes.cell_i[p] == cell_i && probes.cell_j[p] == cell_j ? S(0) : S(1); });
    // The lit probe nearest to the middle of the lit ones: its point is the one through which the motion is followed.
    for (int p = 0; p < most_probes; ++p) {
        const S dx = probes.x[p] - x, dy = probes.y[p] - y;
        t[p] = lit[p] > S(0) ? dx * dx + dy * dy : S(1e30);
    }
    const S nearest = least_of(t);
    bool is_nearest[most_probes];
    for (int p = 0; p < most_probes; ++p) is_nearest[p] = t[p] == nearest;
    one = first_probe(is_nearest);
    b.x = probes.x[one];
    b.y = probes.y[one];
    b.probe_column = probes.column[one];
    b.probe_row = probes.row[one];
    for (int k = 0; k < 2; ++k) b.part_column[k] = b.part_row[k] = S(0);
    b.state = others == S(0) ? State::narrow : State::unshared;
    return b;
}

/// The derivatives of the position on the panel by the position in the plane of the holes: least squares over the probes, panel
/// pixels per mm.
template <class S>
struct PanelSlopes {
    S column[2], row[2];  // along x and y

    LFDSIM_FN PanelSlopes(const Probes<S>& probes, const SharedFootprint<S>& b) {
        S lit[most_probes], t[most_probes];
        for (int p = 0; p < most_probes; ++p) lit[p] = probes.in[p] * probes.weight[p] > S(0) ? S(1) : S(0);
        const S count = sum_of(lit);
        for (int a = 0; a < 2; ++a) {
            const S* const at = a == 0 ? probes.x : probes.y;
            for (int p = 0; p < most_probes; ++p) t[p] = lit[p] * at[p];
            const S mean = sum_of(t) / count;
            auto sum = [&](auto value) {
                for (int p = 0; p < most_probes; ++p) t[p] = lit[p] > S(0) ? (at[p] - mean) * value(p) : S(0);
                return sum_of(t);
            };
            const S spread = sum([&](int p) { return at[p] - mean; }), per = spread > S(0) ? S(1) / spread : S(0);
            column[a] = per * sum([&](int p) { return probes.column[p] - b.column; });
            row[a] = per * sum([&](int p) { return probes.row[p] - b.row; });
        }
    }
};

/// The panel's light over small boxes around the probes of a part of a stratum, each as wide as the distance to the next probes.
template <class S>
struct ProbeBoxes {
    S width[most_probes], height[most_probes], weight[most_probes];  // panel pixels; 0: lost

    /// Sets the boxes' widths and heights: the distances on the panel to the next lit probe (else to the one before) along both
    /// axes of the grid of probes, added up.
    template <class F>
    LFDSIM_FN void make(const Probes<S>& probes, int per_axis) {
        S lit[most_probes];
        for (int p = 0; p < most_probes; ++p) {
            weight[p] = probes.in[p] * probes.weight[p];
            lit[p] = weight[p] > S(0) ? S(1) : S(0);
        }
        const Neighbours<S> columns(probes.column), rows(probes.row), lights(lit);
        for (int p = 0; p < most_probes; p += LaneTraits<F>::width) {
            F wide = F(0), high = F(0);
            auto add_step = [&](const S* behind, const S* before, int step) {  // to the next probe, else from the last
                const F c = load<F>(probes.column + p), r = load<F>(probes.row + p);
                const F next_c = abs(columns.template at<F>(p, step) - c), last_c = abs(columns.template at<F>(p, -step) - c),
                        next_r = abs(rows.template at<F>(p, step) - r), last_r = abs(rows.template at<F>(p, -step) - r);
                const Mask<F> next = load<F>(behind + p) * lights.template at<F>(p, step) > F(0),
                              last = load<F>(before + p) * lights.template at<F>(p, -step) > F(0);
                wide = wide + select(next, next_c, select(last, last_c, F(0)));
                high = high + select(next, next_r, select(last, last_r, F(0)));
            };
            add_step(probes.has_right, probes.has_left, 1);
            add_step(probes.has_above, probes.has_below, per_axis);
            store(wide, width + p);
            store(high, height + p);
        }
    }

    /// Looks up the light of each box, moved by (column, row), times its weight: R, G, B and Probes::in.
    template <class F>
    LFDSIM_FN void look(const Probes<S>& probes, const PanelLight& panel, const PanelBase<S>& base, S column, S row,
                        S (&light)[most_probes][4]) const {
        for (int p = 0; p < most_probes; p += LaneTraits<F>::width) {
            Light<F> found;
            add_light(panel, base,
                      Boxes<F>{load<F>(probes.column + p) + F(column), load<F>(probes.row + p) + F(row), load<F>(width + p),
                               load<F>(height + p), load<F>(weight + p)},
                      found);
            found.store(light[p]);
        }
        for (int p = 0; p < most_probes; ++p) light[p][3] = probes.in[p];
    }
};

/// Derives a footprint's motion per picture pixel from rays p .. p + 2, which go through its probe's point from the block's points
/// 1, 2 and 3, `reach` pixels from the middle. The footprint becomes unshared if the motion is not linear, or a ray is lost or ends
/// under another lens, unless it is wider than FilteredLimits::always_stationary.
template <class S>
LFDSIM_FN void follow(SharedFootprint<S>& b, const Probes<S>& rays, int p, int reach) {
    const S column = b.probe_column, row = b.probe_row, per = S(1) / S(reach);
    b.column_right = (rays.column[p] - column) * per;
    b.row_right = (rays.row[p] - row) * per;
    b.column_down = (rays.column[p + 1] - column) * per;
    b.row_down = (rays.row[p + 1] - row) * per;
    const S uneven_column = abs(rays.column[p] + rays.column[p + 1] + rays.column[p + 2] - S(3) * column),
            uneven_row = abs(rays.row[p] + rays.row[p + 1] + rays.row[p + 2] - S(3) * row);
    const auto even = [](S uneven, S size) { return uneven <= S(FilteredLimits::least_uneven) + S(FilteredLimits::uneven) * size; };
    bool whole = even(uneven_column, b.width) && even(uneven_row, b.height);
    for (int k = p; k < p + 3; ++k)
        whole = whole && rays.weight[k] > S(0) && rays.cell_i[k] == rays.cell_i[p] && rays.cell_j[k] == rays.cell_j[p];
    // A footprint much wider than its motion over the block is stationary, and so is a very wide one whose rays scatter.
    const S motion_column = S(reach) * (abs(b.column_right) + abs(b.column_down)),
            motion_row = S(reach) * (abs(b.row_right) + abs(b.row_down));
    const auto is_stationary = [](S motion, S size) {
        return motion <= S(FilteredLimits::least_uneven) + S(FilteredLimits::stationary) * size;
    };
    b.stationary = is_stationary(motion_column, b.width) && is_stationary(motion_row, b.height);
    if (whole) return;
    b.stationary = max(b.width, b.height) > S(FilteredLimits::always_stationary);
    if (!b.stationary) b.state = SharedFootprint<S>::State::unshared;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
