// The filtered estimator: a block of pixels, in steps that CPU and GPU have in common.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_bundles.h"
#include "engine/kernels/filtered_own.h"
#include "optics/bundle.h"
#include "optics/camera.h"
#include "optics/filtered_limits.h"
#include "optics/light.h"
#include "optics/strata.h"

namespace lfdsim {

namespace {

/// The light of a soft bundle, colour c, at (dx, dy), -1 .. 1 across the block: bilinear between its nodes.
LFDSIM_FN F soft_light(const SharedBundle& b, F dx, F dy, int c) {
    auto between = [](S low, S middle, S high, F at) {
        return F(middle) + F(high - middle) * optics::max(at, F(0)) + F(middle - low) * optics::min(at, F(0));
    };
    const int n = b.nodes;
    if (n == 1) return F(b.colour[0][c]);
    F row[optics::most_nodes];
    auto at = [&](int j, int i) { return b.colour[j * n + i][c]; };
    if (n == 2) {
        const F half = F(S(0.5)), s = half + half * dx, t = half + half * dy;
        for (int j = 0; j < 2; ++j) row[j] = F(at(j, 0)) + F(at(j, 1) - at(j, 0)) * s;
        return row[0] + (row[1] - row[0]) * t;
    }
    for (int j = 0; j < 3; ++j) row[j] = between(at(j, 0), at(j, 1), at(j, 2), dx);
    return row[1] + (row[2] - row[1]) * optics::max(dy, F(0)) + (row[1] - row[0]) * optics::min(dy, F(0));
}

/// The light that a packet of pixels, or of places, sees.
struct PacketLight {
    optics::Light<F> boxes;          // looked up on the panel
    F flat[3] = {F(0), F(0), F(0)};  // of soft bundles: R, G, B

    /// R, G, B and an unused number of each lane.
    LFDSIM_FN void store(S* to, bool with_flat) const {
        boxes.store(to);
        if (!with_flat) return;
        constexpr int lanes = optics::LaneTraits<F>::width;
        S colour[lanes];
        for (int c = 0; c < 3; ++c) {
            optics::store(flat[c], colour);
            for (int k = 0; k < lanes; ++k) to[4 * k + c] = to[4 * k + c] + colour[k];
        }
    }
};

/// Light that varies smoothly over a block is computed at its places, the corners of squares of place_step pixels, at most 5 x 5,
/// and interpolated between them, unless many strata ask for a finer picture.
constexpr int most_side = 16, place_step = FilteredLimits::place_step, most_places = most_side / place_step + 1, most_lanes = 32;

/// 0: none.
LFDSIM_FN int places_per_axis(const Tile& tile) {
    return tile.strata > few_strata || tile.block_side <= place_step ? 0 : tile.block_side / place_step + 1;
}

/// A sharp bundle, and the share of the light at each place that comes through it.
struct Sharp {
    const SharedBundle* bundle;
    S weight[most_lanes];
};
constexpr int most_sharps = 2 * (few_strata + more_strata) * (few_strata + more_strata);

/// The results of a block's steps. The arrays belong to the caller.
struct BlockState {
    std::int32_t x0, y0;  // first pixel
    optics::PixelBlock<S> block;
    Axis axis[2];
    int per_axis;      // places along an axis; 0: none
    int sharps;        // sharp bundles, where there are places
    bool any_soft;     // bundles
    bool any_alone;    // strata that each pixel looks up by itself
    Bundles* bundles;  // row after row
    Sharp* sharp;      // in the order of the bundles
    S (*light)[4];     // at places, of soft bundles
};

template <optics::Way through>
class BlockWork {
  public:
    using Packet = optics::Block<F>;

    LFDSIM_BOTH BlockWork(const Tile& t, BlockState& of) : tile(t), scene(*t.scene), at(of) {}

    /// First step: the block and its axes.
    LFDSIM_BOTH void begin(const EvenCuts& even, std::int32_t left, std::int32_t top) {
        at.x0 = left;
        at.y0 = top;
        at.block = optics::pixel_block<S>(scene, *tile.view, tile.block_side,
                                          S(tile.strata > few_strata ? FilteredLimits::misjudged_fine : FilteredLimits::misjudged),
                                          left, top);
        for (int a = 0; a < 2; ++a) cut_axis(scene, at.block.sweep[a], tile.weak || !at.block.alive, a, even, at.axis[a]);
        at.per_axis = places_per_axis(tile);
    }

    /// Second step: all bundles of a block, or one.
    LFDSIM_BOTH void make_bundles() {
        if (at.block.alive)
            BundleMaker<through>(tile, at.block, at.axis).make_all(at.bundles);
        else
            for (int k = 0; k < strata(); ++k) make_broken(at.bundles[k]);
    }
    LFDSIM_BOTH void make_bundle(int k) {
        const int i = k % at.axis[0].strata, j = k / at.axis[0].strata;
        if (at.block.alive)
            BundleMaker<through>(tile, at.block, at.axis).make(at.bundles[k], i, j);
        else
            make_broken(at.bundles[k]);
    }
    LFDSIM_BOTH int strata() const { return at.axis[0].strata * at.axis[1].strata; }

    /// Third step: lists the sharp bundles, and whether there are soft ones, and strata for each pixel alone.
    LFDSIM_BOTH void survey() {
        at.any_soft = false;
        at.any_alone = at.per_axis == 0;
        at.sharps = 0;
        for (int k = 0; k < strata(); ++k) {
            const Bundles& b = at.bundles[k];
            const bool broken = b.through.state == SharedBundle::State::broken;
            at.any_alone = at.any_alone || broken || b.beside.state == SharedBundle::State::broken;
            if (at.per_axis == 0 || broken) continue;
            note(b.through);
            note(b.beside);
        }
    }

    /// Fourth step: for a packet of places from number k on, the light of soft bundles and the weights of the sharp ones.
    template <int most_strata>
    LFDSIM_BOTH void look_at_places(int k) {
        constexpr int lanes = Packet::lanes;
        const int per_axis = at.per_axis, reach = at.block.reach;
        const S per_reach = S(1) / S(reach);
        S right[lanes], down[lanes];
        for (int n = 0; n < lanes; ++n) {
            right[n] = S((k + n) % per_axis * place_step - reach);
            down[n] = S(optics::min((k + n) / per_axis, per_axis - 1) * place_step - reach);
        }
        F flat[3] = {F(0), F(0), F(0)};
        Sharp* next = at.sharp;
        const F dx = optics::load<F>(right) * F(per_reach), dy = optics::load<F>(down) * F(per_reach);
        for_strata<most_strata>(dx, dy, [&](const Bundles& b, const Span<F>& across, const Span<F>& up, std::uint32_t) {
            auto weigh = [&](const SharedBundle& bundle, F weight) {
                weight = weight * F(bundle.weight);
                if (bundle.state == SharedBundle::State::soft)
                    for (int c = 0; c < 3; ++c) flat[c] = flat[c] + weight * soft_light(bundle, dx, dy, c);
                if (bundle.state == SharedBundle::State::sharp) optics::store(weight, next++->weight + k);
            };
            if (b.through.state == SharedBundle::State::broken) return;
            const F cover = scene.hole_radius > 0 ? optics::hole_cover(across, up) : F(1), share = across.share * up.share;
            weigh(b.through, share * cover);
            weigh(b.beside, share * (F(1) - cover));
        });
        S colour[3][lanes];
        for (int c = 0; c < 3; ++c) optics::store(flat[c], colour[c]);
        for (int n = 0; n < lanes; ++n)
            for (int c = 0; c < 3; ++c) at.light[k + n][c] = colour[c][n];
    }

    /// Last step: the light that is looked up for each pixel of the packet at (x, y) of the frame.
    template <int most_strata>
    LFDSIM_BOTH PacketLight look_from(std::int32_t x, std::int32_t y) const {
        S right_of[Packet::lanes], below[Packet::lanes];  // of the packet's first pixel
        std::uint32_t number[Packet::lanes];
        for (int k = 0; k < Packet::lanes; ++k) {
            right_of[k] = S(k % Packet::width) + S(0.5);
            below[k] = S(k / Packet::width) + S(0.5);
            number[k] = std::uint32_t(k / Packet::width * tile.view->width + k % Packet::width);
        }
        const F right = optics::load<F>(right_of), down = optics::load<F>(below);
        const F dx = right + F(S(x - at.x0 - at.block.reach)), dy = down + F(S(y - at.y0 - at.block.reach));
        PacketLight light;
        if (at.sharps > 0) add_sharp(x - at.x0, y - at.y0, right, down, dx, dy, light);
        if (at.any_alone) add_alone<most_strata>(x, y, optics::load<F>(number), dx, dy, light);
        return light;
    }

  private:
    /// May each pixel cut a stratum at the lenses' borders? If it sees little of a lens through it, and no light beside the holes.
    LFDSIM_BOTH bool cut_by_pixels(int i, int j) const {
        return at.block.alive && !scene.leaky && at.axis[0].moving && at.axis[1].moving &&
               within_a_pitch(scene, at.axis[0], 0, i) && within_a_pitch(scene, at.axis[1], 1, j);
    }

    LFDSIM_BOTH static void make_broken(Bundles& b) {
        b.through.state = SharedBundle::State::broken;
        b.beside.state = SharedBundle::State::dark;
        b.straddles = false;
    }

    LFDSIM_BOTH void note(const SharedBundle& b) {
        at.any_soft = at.any_soft || b.state == SharedBundle::State::soft;
        if (b.state == SharedBundle::State::sharp) at.sharp[at.sharps++].bundle = &b;
    }

    /// Adds the light of sharp bundles for the packet whose first pixel is (x, y) of the block.
    LFDSIM_BOTH void add_sharp(int x, int y, F right, F down, F dx, F dy, PacketLight& to) const {
        const int corner = y / place_step * at.per_axis + x / place_step;
        const F per = F(S(1) / S(place_step)), s = (right + F(S(x % place_step))) * per, t = (down + F(S(y % place_step))) * per;
        for (const Sharp* k = at.sharp; k < at.sharp + at.sharps; ++k) {
            const S *const upper = k->weight + corner, *const lower = upper + at.per_axis;
            if (!(upper[0] + upper[1] + lower[0] + lower[1] > S(0))) continue;
            const F above = F(upper[0]) + F(upper[1] - upper[0]) * s, beneath = F(lower[0]) + F(lower[1] - lower[0]) * s;
            add_box(*k->bundle, dx, dy, above + (beneath - above) * t, to);
        }
    }

    LFDSIM_BOTH static void add_box(const SharedBundle& b, F dx, F dy, F weight, PacketLight& to) {
        b.footprint.add(to.boxes, F(b.column) + F(b.column_right) * dx + F(b.column_down) * dy,
                        F(b.row) + F(b.row_right) * dx + F(b.row_down) * dy, weight);
    }

    /// Adds what each pixel of the packet at (x, y) of the frame computes by itself: all strata where there are no places, else the
    /// broken ones.
    template <int most_strata>
    LFDSIM_BOTH void add_alone(std::int32_t x, std::int32_t y, optics::Uint<F> number, F dx, F dy, PacketLight& to) const {
        bool own_ready = false;
        optics::PixelRays<F> pixels;
        const auto first = std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x);
        const S reach = S(at.block.reach), per_reach = S(1) / reach;
        dx = dx * F(per_reach);
        dy = dy * F(per_reach);
        for_strata<most_strata>(dx, dy, [&](const Bundles& b, const Span<F>& across, const Span<F>& up, std::uint32_t stratum) {
            auto ready = [&] {
                if (!own_ready) pixels = optics::pixel_rays<F>(*tile.view, x, y);
                own_ready = true;
            };
            auto add_own = [&](Own part, F weight) {
                ready();
                optics::Sampler<F> sampler(Sampling::random, 2, tile.view->seed, number + optics::Uint<F>(first));
                sampler.sample = stratum * 8;
                add_own_rays<through>(tile, pixels, across, up, part, weight, sampler, to.boxes);
            };
            const bool own_beside = b.beside.state == SharedBundle::State::broken,
                       own = b.through.state == SharedBundle::State::broken;
            if (at.per_axis > 0 && !own && !own_beside) return;
            const F share = across.share * up.share;
            if (optics::none(share > F(0))) return;  // a border that only other pixels of the block see
            const int i = int(stratum % max_strata), j = int(stratum / max_strata);
            if (own && cut_by_pixels(i, j)) {
                Span<F> x_parts[2], y_parts[2];
                cut_at_border(scene, at.axis[0], 0, i, dx, dy, x_parts);
                cut_at_border(scene, at.axis[1], 1, j, dx, dy, y_parts);
                for (const Span<F>& part_y : y_parts) {
                    for (const Span<F>& part_x : x_parts) {
                        const F part = part_x.share * part_y.share;
                        if (optics::none(part > F(0))) continue;
                        ready();
                        add_own_probes<through>(tile, pixels, part_x, part_y, part, to.boxes);
                    }
                }
                return;
            }
            if (own && at.block.alive && !b.straddles && fine_alone(tile, scene)) {
                ready();
                return add_own_probes<through>(tile, pixels, across, up, share, to.boxes);
            }
            if (own) {
                const bool covered = scene.hole_radius > 0 && !scene.leaky && at.block.alive && !b.straddles;
                return add_own(covered ? Own::covered : Own::all, share);
            }
            const F cover = scene.hole_radius > 0 ? optics::hole_cover(across, up) : F(1);
            auto add = [&](const SharedBundle& bundle, F weight) {
                if (bundle.state == SharedBundle::State::dark) return;
                weight = weight * F(bundle.weight);
                if (bundle.state == SharedBundle::State::soft)
                    for (int c = 0; c < 3; ++c) to.flat[c] = to.flat[c] + weight * soft_light(bundle, dx, dy, c);
                else
                    add_box(bundle, dx * F(reach), dy * F(reach), weight, to);
            };
            if (at.per_axis == 0) add(b.through, share * cover);
            if (own_beside) {
                // Decided for each pixel, so that none depends on the others of its packet.
                const optics::Mask<F> seen = cover < F(0.9999f);
                if (optics::any(seen)) add_own(Own::beside, optics::select(seen, share * (F(1) - cover), F(0)));
            } else if (at.per_axis == 0) {
                add(b.beside, share * (F(1) - cover));
            }
        });
    }

    /// f(bundles, span along x', span along y', number) for each stratum; the spans are those of the lanes at (dx, dy) of the
    /// block, -1 .. 1. An axis has at most `most` strata.
    template <int most, class Do>
    LFDSIM_BOTH void for_strata(F dx, F dy, Do f) const {
        Span<F> spans[2][most];
        for (int a = 0; a < 2; ++a) spans_of(scene, at.axis[a], a, dx, dy, spans[a]);
        for (int j = 0; j < at.axis[1].strata; ++j)
            for (int i = 0; i < at.axis[0].strata; ++i)
                f(at.bundles[j * at.axis[0].strata + i], spans[0][i], spans[1][j], std::uint32_t(j * max_strata + i));
    }

    const Tile& tile;
    const optics::Scene<S>& scene;
    BlockState& at;
};

/// Interpolates the light between two places.
LFDSIM_FN S between_places(S a, S b, S share) { return a + (b - a) * share; }

}  // namespace

}  // namespace lfdsim
