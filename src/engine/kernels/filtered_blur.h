// The filtered estimator: what a pixel's area, the pupil and a diffuser spread where pixels trace rays of their own, besides what
// the square's two numbers do.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"
#include "optics/spread.h"

namespace lfdsim {

namespace {

using SharedBundle = optics::SharedBundle<S>;

/// How far the pixel's area, or the diffuser where the square is that area, and the pupil spread light about the ends of the
/// pixels' own rays.
struct Blur {
    optics::PanelSpread<S> on_panel, at_edge;  // in parts of the square that lie within the lens's outline, and on it
    // One ray serves for four where a part of the square is narrow beside them, and of a single sample. How far each of the
    // square's numbers moves its light, panel pixels.
    bool one_ray;
    S column[2], row[2];
};

/// The pixel's is measured for each of a block's squares of so many pixels, at most four, row after row; what the others add
/// changes less, and once a block is enough.
constexpr int blur_step = 4, most_blurs = 4;
/// How many squares along an axis.
LFDSIM_BOTH int blurs_an_axis(const Tile& tile) { return tile.square.of_pixel ? 1 : optics::min(tile.block_side / blur_step, 2); }

/// By how much the diffuser's largest turn along an axis changes the slope of the block's middle ray along axis a.
LFDSIM_BOTH S turn_of_diffuser(const optics::Scene<S>& scene, const optics::PixelBlock<S>& block, int axis, int a) {
    S sine, cosine;
    optics::sincos(scene.half_angle[axis], scene.small_angles, sine, cosine);
    const optics::Sweep<S>&x = block.sweep[0][0], &y = block.sweep[1][0], &own = block.sweep[a][0];
    return a == axis ? own.turned(sine / cosine) - own.slope : optics::turned_aside(x.slope, y.slope, axis, sine / cosine);
}

/// By how much they spread a ray, for the n-th of those squares of pixels. That ray goes through the middle of what they see of the
/// lens, or as near to it as lies well inside the lens: near its edge rays may end far from each other that start close together.
/// `across` and `up` are the grid's stratum along x and y; `rays` is overwritten.
template <optics::Way through>
LFDSIM_BOTH Blur blur_alone(const Tile& tile, const optics::PixelBlock<S>& block, int n, const Grid& grid, const Stratum& across,
                            const Stratum& up, optics::Probes<S>& rays) {
    Blur blur{{}, {}, false, {}, {}};
    const bool of_pixel = tile.square.of_pixel;
    const optics::Scene<S>& scene = *tile.scene;
    const int squares = blurs_an_axis(tile);
    const S size = S(1) / S(squares), right = S(2 * (n % squares) + 1) * size - S(1), down = S(2 * (n / squares) + 1) * size - S(1);
    const auto middle = [&](const Gradient& g) { return g.middle + g.right * right + g.down * down; };
    const Stratum* const of[2] = {&across, &up};
    S at[2], slope[2], with_hole[2];
    for (int a = 0; a < 2; ++a) {
        const Gradient &first = grid.axis[a].first, &last = grid.axis[a].last;
        const S reach = first.reach() * size, from = middle(first), to = middle(last);
        const S low = optics::max(of[a]->from, optics::min(from, to) - reach - of[a]->axis),
                high = optics::min(of[a]->to, optics::max(from, to) + reach - of[a]->axis);
        if (a != grid.strip && squares > 1 && !(low < high)) return blur;  // those pixels do not see the lens
        at[a] = a == grid.strip ? S(0) : S(0.5) * (low + high);
        // The part of the square that is seen of the lens, as a share of its variance. A lens that is seen whole keeps its rays
        // where they are on it, whatever else moves: the square's number moves against it.
        const S all = optics::max(optics::abs(to - from), S(1e-9)),
                part = optics::min(of[a]->to, optics::max(from, to) - of[a]->axis) -
                       optics::max(of[a]->from, optics::min(from, to) - of[a]->axis),
                share = optics::min(optics::max(part / all, S(0)), S(1));
        with_hole[a] = a == grid.strip ? S(1) : share * share;
    }
    const S radius =
        scene.hole_radius > 0 ? scene.hole_radius : optics::min(scene.lattice.half_pitch[0], scene.lattice.half_pitch[1]);
    const S far = optics::sqrt(at[0] * at[0] + at[1] * at[1]),
            most = S(FilteredLimits::well_inside) * (grid.strip < 0 ? radius : scene.hole_half);
    for (int a = 0; a < 2 && far > most; ++a) at[a] = at[a] * (most / far);
    for (int a = 0; a < 2; ++a) {
        const S place = of[a]->axis + at[a], below = scene.holes_below[a] - grid.raised;
        const optics::Sweep<S>* const sweep = block.sweep[a];
        slope[a] = of_pixel ? middle(Gradient::of(sweep[0].slope, sweep[1].slope, sweep[2].slope))
                            : (place - middle(Gradient::of(sweep[0].at, sweep[1].at, sweep[2].at))) / below;
        at[a] = place - slope[a] * below;
    }
    // The middle; the pair that is not the square's: a pixel to the right and one down, or the diffuser's two turns; the pupil's
    // right and upper edge; and where the square is the pixel's area, a part of a pixel to the right and one down: a whole pixel
    // may be wider than the lens.
    const int count = of_pixel ? 7 : 5;
    const S per = S(1) / S(block.reach), part = S(0.125);
    S on_lens[7][2];  // mm, by how much a ray is moved in the plane of the holes, where the lens's edge is not moved with it
    for (int p = 0; p < count; ++p) {
        const int of_pair = (p + 1) % 2;
        for (int a = 0; a < 2; ++a) {
            const optics::Sweep<S>* const sweep = block.sweep[a];
            S moved = 0, turned = 0;
            if (p > 4 || (!of_pixel && (p == 1 || p == 2))) {
                const S steps = p > 4 ? per * part : per;
                moved = (sweep[of_pair + 1].at - sweep[0].at) * steps;
                turned = (sweep[of_pair + 1].slope - sweep[0].slope) * steps;
            } else if (p > 2 && scene.thin_lens) {
                moved = block.pupil_at[of_pair][a];
                turned = block.pupil_slope[of_pair][a];
            } else if ((p == 1 || p == 2) && scene.has_diffuser) {
                turned = turn_of_diffuser(scene, block, of_pair, a);
            }
            const bool divided = p > 2 ? tile.square.divides_pupil : tile.square.divides_other;
            if (!of_pixel && !divided) turned = turned - (S(1) - with_hole[a]) * (turned + moved / scene.holes_below[a]);
            on_lens[p][a] = p < 5 && (divided || a == grid.strip) ? S(0) : moved + turned * scene.holes_below[a];
            optics::set_probe(a == 0 ? rays.at_x : rays.at_y, p, at[a] + moved);
            optics::set_probe(a == 0 ? rays.x : rays.y, p, at[a] + moved + slope[a] + turned);
        }
    }
    const S one_below[2] = {1, 1};
    optics::trace_probes<through, F>(scene, block, rays, count, one_below);
    const auto same = [&](int p) {
        const bool same_cell = optics::of_probe(rays.cell_i, p) == optics::of_probe(rays.cell_i, 0) &&
                               optics::of_probe(rays.cell_j, p) == optics::of_probe(rays.cell_j, 0);
        return optics::of_probe(rays.weight, 0) * optics::of_probe(rays.weight, p) > S(0) && same_cell;
    };
    S on_panel[7][2];  // panel pixels, from where the middle ends
    for (int p = 0; p < count; ++p) {
        on_panel[p][0] = optics::of_probe(rays.column, p) - optics::of_probe(rays.column, 0);
        on_panel[p][1] = optics::of_probe(rays.row, p) - optics::of_probe(rays.row, 0);
    }
    // At the lens's edge less what rays 5 and 6 do there that together are moved on the lens as ray p is.
    const auto widen = [&](optics::PanelSpread<S>& to, int p, S share, bool at_edge) {
        S column = on_panel[p][0], row = on_panel[p][1];
        const auto turn = [&](int first, int second) {
            return on_lens[first][0] * on_lens[second][1] - on_lens[first][1] * on_lens[second][0];
        };
        if (at_edge && turn(5, 6) != S(0)) {
            const S of_5 = turn(p, 6) / turn(5, 6), of_6 = turn(5, p) / turn(5, 6);
            column = column - of_5 * on_panel[5][0] - of_6 * on_panel[6][0];
            row = row - of_5 * on_panel[5][1] - of_6 * on_panel[6][1];
        }
        to.add(column, row, share);
    };
    // The width of a box that varies as much, in steps; squared. Of the variance, the shares that lie within cells; a pupil's are
    // mapped to a disk.
    const S diffuser = 4, pupil = 3;
    const S cells = S(tile.square.parts * tile.square.parts), in_other = tile.square.divides_other ? S(1) / cells : S(1),
            in_pupil = tile.square.divides_pupil ? optics::min(S(2) / cells, S(1)) : S(1);
    const auto spread_of_pairs = [&](bool at_edge) {
        optics::PanelSpread<S> spread{};
        for (int p = 1; p < 3 && scene.box_filter && scene.has_diffuser; ++p)
            if (same(p)) widen(spread, p, of_pixel ? diffuser * in_other : in_other, false);
        spread.box_wide2 = spread.wide2;
        spread.box_high2 = spread.high2;
        for (int p = 3; p < 5 && scene.thin_lens; ++p)
            if (same(p)) widen(spread, p, pupil * in_pupil, at_edge);
        return spread;
    };
    blur.on_panel = blur.at_edge = spread_of_pairs(false);
    if (!of_pixel || !same(5) || !same(6)) return blur;
    blur.at_edge = spread_of_pairs(true);
    const S per_number = S(0.5) / part;
    for (int k = 0; k < 2; ++k) {
        const S each = k == 0 ? per_number : -per_number;  // the second number is upwards
        blur.column[k] = each * on_panel[5 + k][0];
        blur.row[k] = each * on_panel[5 + k][1];
    }
    optics::PanelSpread<S> square{};
    for (int p = 5; p < 7; ++p) widen(square, p, S(1) / (part * part * cells), false);
    const auto beside = [](S wide2) { return S(FilteredLimits::beside * FilteredLimits::beside) * wide2; };
    blur.one_ray = (tile.strata == 1 && !scene.emission.whole) ||
                   (square.wide2 <= beside(blur.on_panel.wide2) && square.high2 <= beside(blur.on_panel.high2));
    return blur;
}

}  // namespace

}  // namespace lfdsim
