// The filtered estimator: what the camera's pixel and pupil spread where pixels trace rays of their own.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "optics/bundle.h"
#include "optics/filtered_limits.h"

namespace lfdsim {

namespace {

using SharedBundle = optics::SharedBundle<S>;

/// What the camera's pixel and pupil add to the boxes of the pixels' own rays; squared widths (optics::blur).
struct Blur {
    S width, height;
};

/// Behind a weak diffuser it is measured for each of a block's squares of so many pixels, at most four, row after row; without one
/// it is the pupil's alone, and once a block is enough.
constexpr int blur_step = 4, most_blurs = 4;
/// How many squares along an axis.
LFDSIM_BOTH int blurs_an_axis(const optics::Scene<S>& scene, int block_side) {
    return scene.has_diffuser ? optics::min(block_side / blur_step, 2) : 1;
}

/// By how much the camera's pixel and pupil spread a ray, for square number n of a block's. That ray goes through the middle of
/// what the square sees of the lens, or as near to it as lies well inside the lens: near its edge rays may end far from each other
/// that start close together. `across` and `up` are the grid's stratum along x and y; `rays` is overwritten.
template <optics::Way through>
LFDSIM_BOTH Blur blur_alone(const optics::Scene<S>& scene, const optics::PixelBlock<S>& block, int n, const Grid& grid,
                            const Stratum& across, const Stratum& up, optics::Probes<S>& rays) {
    Blur blur{0, 0};
    const int squares = blurs_an_axis(scene, 2 * block.reach);
    const S size = S(1) / S(squares), right = S(2 * (n % squares) + 1) * size - S(1), down = S(2 * (n / squares) + 1) * size - S(1);
    const auto middle = [&](const Gradient& g) { return g.middle + g.right * right + g.down * down; };
    const Stratum* const of[2] = {&across, &up};
    S at[2], slope[2];
    for (int a = 0; a < 2; ++a) {
        const Gradient &first = grid.axis[a].first, &last = grid.axis[a].last;
        const S reach = first.reach() * size, from = middle(first), to = middle(last);
        const S low = optics::max(of[a]->from, optics::min(from, to) - reach - of[a]->axis),
                high = optics::min(of[a]->to, optics::max(from, to) + reach - of[a]->axis);
        if (a != grid.strip && squares > 1 && !(low < high)) return blur;  // the square does not see the lens
        at[a] = a == grid.strip ? S(0) : S(0.5) * (low + high);
    }
    const S radius =
        scene.hole_radius > 0 ? scene.hole_radius : optics::min(scene.lattice.half_pitch[0], scene.lattice.half_pitch[1]);
    const S far = optics::sqrt(at[0] * at[0] + at[1] * at[1]),
            most = S(FilteredLimits::well_inside) * (grid.strip < 0 ? radius : scene.hole_half);
    for (int a = 0; a < 2 && far > most; ++a) at[a] = at[a] * (most / far);
    for (int a = 0; a < 2; ++a) {
        const S place = of[a]->axis + at[a], below = scene.holes_below[a];
        const optics::Sweep<S>* const sweep = block.sweep[a];
        slope[a] = scene.has_diffuser ? (place - middle(Gradient::of(sweep[0].at, sweep[1].at, sweep[2].at))) / below
                                      : middle(Gradient::of(sweep[0].slope, sweep[1].slope, sweep[2].slope));
        at[a] = place - slope[a] * below;
    }
    const S per = S(1) / S(block.reach);
    for (int p = 0; p < 5; ++p) {  // the middle; a pixel to the right, and down; at the pupil's right and upper edge
        for (int a = 0; a < 2; ++a) {
            const optics::Sweep<S>* const sweep = block.sweep[a];
            S moved = 0, turned = 0;
            if (p == 1 || p == 2) {
                moved = (sweep[p].at - sweep[0].at) * per;
                turned = (sweep[p].slope - sweep[0].slope) * per;
            } else if (p > 2 && scene.thin_lens) {
                moved = block.pupil_at[p - 3][a];
                turned = block.pupil_slope[p - 3][a];
            }
            (a == 0 ? rays.at_x : rays.at_y)[p] = at[a] + moved;
            (a == 0 ? rays.x : rays.y)[p] = at[a] + moved + slope[a] + turned;
        }
    }
    const S one_below[2] = {1, 1};
    optics::trace_probes<through, F>(scene, block, rays, 5, one_below);
    for (int p = 1; p < 5; ++p) {
        const bool counts = p < 3 ? scene.box_filter && scene.has_diffuser : scene.thin_lens;
        const bool same =
            rays.weight[0] * rays.weight[p] > S(0) && rays.cell_i[p] == rays.cell_i[0] && rays.cell_j[p] == rays.cell_j[0];
        if (!counts || !same) continue;
        const S c = rays.column[p] - rays.column[0], r = rays.row[p] - rays.row[0], share = p < 3 ? S(1) : S(3);
        blur.width = blur.width + share * c * c;
        blur.height = blur.height + share * r * r;
    }
    return blur;
}

}  // namespace

}  // namespace lfdsim
