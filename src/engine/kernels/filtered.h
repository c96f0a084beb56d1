// The filtered estimator: the loop over blocks, places, packets and strata.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernels/filtered_bundles.h"
#include "engine/kernels/filtered_own.h"

namespace lfdsim {

namespace {

/// The light of a soft bundle, colour c, at (dx, dy), -1 .. 1 across the block: between its nodes it is linear in both.
LFDSIM_FN F soft_light(const Bundle& b, F dx, F dy, int c) {
    auto between = [](S low, S middle, S high, F at) {
        return F(middle) + F(high - middle) * optics::max(at, F(0)) + F(middle - low) * optics::min(at, F(0));
    };
    const int n = b.nodes;
    if (n == 1) return F(b.colour[0][c]);
    F row[optics::kNodes];
    auto at = [&](int j, int i) { return b.colour[j * n + i][c]; };
    if (n == 2) {
        const F half = F(S(0.5)), s = half + half * dx, t = half + half * dy;
        for (int j = 0; j < 2; ++j) row[j] = F(at(j, 0)) + F(at(j, 1) - at(j, 0)) * s;
        return row[0] + (row[1] - row[0]) * t;
    }
    for (int j = 0; j < 3; ++j) row[j] = between(at(j, 0), at(j, 1), at(j, 2), dx);
    return row[1] + (row[2] - row[1]) * optics::max(dy, F(0)) + (row[1] - row[0]) * optics::min(dy, F(0));
}

/// What a packet of pixels, or of places, sees.
struct PacketLight {
    optics::Light<F> boxes;
    F flat[3] = {F(0), F(0), F(0)};

    /// R, G, B and an idle number of each lane.
    void store(S* to, bool with_flat) const {
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

/// What is even over a block is told at the corners of squares of so many pixels, at most 5 x 5 places, and interpolated between
/// them, unless there are so many strata that a finer picture is asked for.
constexpr int kMostSide = 16, kPlaceStep = 4, kMostPlaces = kMostSide / kPlaceStep + 1, kMostLanes = 32;

template <optics::Way through>
class BlockRenderer {
  public:
    BlockRenderer(const Tile& t, const EvenCuts& even, std::int32_t left, std::int32_t top)
        : tile(t),
          scene(*t.scene),
          x0(left),
          y0(top),
          block(optics::pixel_block<S>(scene, *t.view, t.block_side, t.strata > kFewStrata ? S(0.002) : S(0.05), left, top)),
          axis{cut_axis(scene, block.sweep[0], block.alive, 0, even), cut_axis(scene, block.sweep[1], block.alive, 1, even)},
          per_reach(S(1) / S(block.reach)),
          per_axis(t.strata > kFewStrata || t.block_side <= kPlaceStep ? 0 : t.block_side / kPlaceStep + 1) {
        const int strata = axis[0].strata * axis[1].strata;
        if (block.alive)
            BundleMaker<through>(tile, block, axis).make(bundles);
        else
            for (int k = 0; k < strata; ++k) {
                bundles[k].through.state = Bundle::State::broken;
                bundles[k].beside.state = Bundle::State::dark;
                bundles[k].straddles = false;
            }
        any_alone = per_axis == 0;
        for (int k = 0; k < strata; ++k)
            if (bundles[k].through.state == Bundle::State::broken || bundles[k].beside.state == Bundle::State::broken)
                any_alone = true;
    }

    void render() {
        if (per_axis > 0) look_at_places();
        if (any_soft)
            interpolate();
        else
            __builtin_memset(picture, 0, sizeof picture);
        if (sharps > 0 || any_alone) add_pixels();
        write();
    }

  private:
    using Packet = optics::Block<F>;

    /// What is told at places, which lie at the corners of squares of pixels: the light of soft bundles, and what the sharp ones
    /// count.
    void look_at_places() {
        constexpr int lanes = Packet::lanes;
        S right[kMostLanes], down[kMostLanes];
        for (int k = 0; k < kMostLanes; ++k) {
            right[k] = S(k % per_axis * kPlaceStep - block.reach);
            down[k] = S(optics::min(k / per_axis, per_axis - 1) * kPlaceStep - block.reach);
        }
        for (int k = 0; k < per_axis * per_axis; k += lanes) {
            F flat[3] = {F(0), F(0), F(0)};
            Sharp* next = sharp;
            const F dx = optics::load<F>(right + k) * F(per_reach), dy = optics::load<F>(down + k) * F(per_reach);
            for_strata(dx, dy, [&](const Bundles& b, const Span<F>& across, const Span<F>& up, std::uint32_t) {
                auto weigh = [&](const Bundle& bundle, F weight) {
                    weight = weight * F(bundle.weight);
                    if (bundle.state == Bundle::State::soft) {
                        any_soft = true;
                        for (int c = 0; c < 3; ++c) flat[c] = flat[c] + weight * soft_light(bundle, dx, dy, c);
                    }
                    if (bundle.state != Bundle::State::sharp) return;
                    next->bundle = &bundle;
                    optics::store(weight, next++->weight + k);
                };
                if (b.through.state == Bundle::State::broken) return;
                const F cover = scene.hole_radius > 0 ? optics::hole_cover(across, up) : F(1), share = across.share * up.share;
                weigh(b.through, share * cover);
                weigh(b.beside, share * (F(1) - cover));
            });
            sharps = int(next - sharp);
            S colour[3][lanes];
            for (int c = 0; c < 3; ++c) optics::store(flat[c], colour[c]);
            for (int i = 0; i < lanes; ++i)
                for (int c = 0; c < 3; ++c) light[k + i][c] = colour[c][i];
        }
    }

    /// The light at places, to the pixels between them.
    void interpolate() {
        const S per = S(1) / S(kPlaceStep);
        for (int y = 0; y < tile.block_side; ++y) {
            const S t = (S(y % kPlaceStep) + S(0.5)) * per;
            const S(*const upper)[4] = light + y / kPlaceStep * per_axis;
            S row[kMostPlaces][4];
            for (int i = 0; i < per_axis; ++i)
                for (int c = 0; c < 4; ++c) row[i][c] = upper[i][c] + (upper[per_axis + i][c] - upper[i][c]) * t;
            for (int i = 0; i + 1 < per_axis; ++i)
                for (int k = 0; k < kPlaceStep; ++k)
                    for (int c = 0; c < 4; ++c)
                        picture[y][i * kPlaceStep + k][c] = row[i][c] + (row[i + 1][c] - row[i][c]) * ((S(k) + S(0.5)) * per);
        }
    }

    /// Those pixels of the block that the tile has.
    void write() const {
        const int from = optics::max(int(tile.x0 - x0), 0), to = optics::min(int(tile.x1 - x0), tile.block_side);
        for (int y = optics::max(int(tile.y0 - y0), 0); y < optics::min(int(tile.y1 - y0), tile.block_side); ++y) {
            S* out = tile.out + (std::int64_t(y0 + y - tile.crop_y) * tile.crop_width + (x0 + from - tile.crop_x)) * 3;
            for (int x = from; x < to; ++x, out += 3) __builtin_memcpy(out, picture[y][x], 3 * sizeof(S));
        }
    }

    /// Adds the light that is looked up for each pixel.
    void add_pixels() {
        S right_of[Packet::lanes], below[Packet::lanes];  // of a packet's first pixel
        std::uint32_t number[Packet::lanes];
        for (int k = 0; k < Packet::lanes; ++k) {
            right_of[k] = S(k % Packet::width) + S(0.5);
            below[k] = S(k / Packet::width) + S(0.5);
            number[k] = std::uint32_t(k / Packet::width * tile.view->width + k % Packet::width);
        }
        const F right = optics::load<F>(right_of), down = optics::load<F>(below);
        for (std::int32_t y = y0; y < y0 + tile.block_side; y += Packet::height) {
            for (std::int32_t x = x0; x < x0 + tile.block_side; x += Packet::width) {
                if (x >= tile.x1 || y >= tile.y1 || x + Packet::width <= tile.x0 || y + Packet::height <= tile.y0) continue;
                PacketLight of;
                const F dx = right + F(S(x - x0 - block.reach)), dy = down + F(S(y - y0 - block.reach));
                if (sharps > 0) add_sharp(x - x0, y - y0, right, down, dx, dy, of);
                if (any_alone) add_alone(x, y, optics::load<F>(number), dx, dy, of);
                S found[Packet::height][Packet::width * 4];
                of.store(found[0], per_axis == 0);
                for (int row = 0; row < Packet::height; ++row) {
                    S* const to = picture[y - y0 + row][x - x0];
                    for (int k = 0; k < Packet::width * 4; ++k) to[k] = to[k] + found[row][k];
                }
            }
        }
    }

    /// Sharp bundles for the packet whose first pixel is (x, y) of the block.
    void add_sharp(int x, int y, F right, F down, F dx, F dy, PacketLight& to) const {
        const int corner = y / kPlaceStep * per_axis + x / kPlaceStep;
        const F per = F(S(1) / S(kPlaceStep)), s = (right + F(S(x % kPlaceStep))) * per, t = (down + F(S(y % kPlaceStep))) * per;
        for (const Sharp* k = sharp; k < sharp + sharps; ++k) {
            const S *const upper = k->weight + corner, *const lower = upper + per_axis;
            if (!(upper[0] + upper[1] + lower[0] + lower[1] > S(0))) continue;
            const F above = F(upper[0]) + F(upper[1] - upper[0]) * s, beneath = F(lower[0]) + F(lower[1] - lower[0]) * s;
            add_box(*k->bundle, dx, dy, above + (beneath - above) * t, to);
        }
    }

    static void add_box(const Bundle& b, F dx, F dy, F weight, PacketLight& to) {
        b.footprint.add(to.boxes, F(b.column) + F(b.column_right) * dx + F(b.column_down) * dy,
                        F(b.row) + F(b.row_right) * dx + F(b.row_down) * dy, weight);
    }

    /// What each pixel of the packet at (x, y) of the frame has to look at alone: where nothing is told at places all strata, else
    /// the broken ones.
    void add_alone(std::int32_t x, std::int32_t y, optics::Uint<F> number, F dx, F dy, PacketLight& to) const {
        bool own_ready = false;
        optics::PixelRays<F> pixels;
        const auto first = std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x);
        dx = dx * F(per_reach);
        dy = dy * F(per_reach);
        for_strata(dx, dy, [&](const Bundles& b, const Span<F>& across, const Span<F>& up, std::uint32_t stratum) {
            auto add_own = [&](Own part, F weight) {
                if (!own_ready) pixels = optics::pixel_rays<F>(*tile.view, x, y);
                own_ready = true;
                optics::Sampler<F> sampler(Sampling::random, 2, tile.view->seed, number + optics::Uint<F>(first));
                sampler.sample = stratum * 8;
                add_own_rays<through>(tile, pixels, across, up, part, weight, sampler, to.boxes);
            };
            const bool own_beside = b.beside.state == Bundle::State::broken, own = b.through.state == Bundle::State::broken;
            if (per_axis > 0 && !own && !own_beside) return;
            const F share = across.share * up.share;
            if (optics::none(share > F(0))) return;  // a border that only other pixels of the block see
            if (own) {
                const bool covered = scene.hole_radius > 0 && !scene.leaky && block.alive && !b.straddles;
                return add_own(covered ? Own::covered : Own::all, share);
            }
            const F cover = scene.hole_radius > 0 ? optics::hole_cover(across, up) : F(1);
            auto add = [&](const Bundle& bundle, F weight) {
                if (bundle.state == Bundle::State::dark) return;
                weight = weight * F(bundle.weight);
                if (bundle.state == Bundle::State::soft)
                    for (int c = 0; c < 3; ++c) to.flat[c] = to.flat[c] + weight * soft_light(bundle, dx, dy, c);
                else
                    add_box(bundle, dx * F(S(block.reach)), dy * F(S(block.reach)), weight, to);
            };
            if (per_axis == 0) add(b.through, share * cover);
            if (own_beside) {
                if (optics::any(cover < F(0.9999f))) add_own(Own::beside, share * (F(1) - cover));
            } else if (per_axis == 0) {
                add(b.beside, share * (F(1) - cover));
            }
        });
    }

    /// f(bundles, span, span, number) for each stratum, of which lanes (dx, dy) of the block, -1 .. 1, have these spans.
    template <class Do>
    void for_strata(F dx, F dy, Do f) const {
        Span<F> spans[2][kMostStrata];
        for (int a = 0; a < 2; ++a) spans_of(scene, axis[a], dx, dy, spans[a]);
        for (int j = 0; j < axis[1].strata; ++j)
            for (int i = 0; i < axis[0].strata; ++i)
                f(bundles[j * axis[0].strata + i], spans[0][i], spans[1][j], std::uint32_t(j * kMostStrata + i));
    }

    const Tile& tile;
    const optics::Scene<S>& scene;
    const std::int32_t x0, y0;
    const optics::PixelBlock<S> block;
    const Axis axis[2];
    const S per_reach;
    const int per_axis;                  // places along an axis; 0: none
    S light[kMostLanes][4];              // at places, of soft bundles
    S picture[kMostSide][kMostSide][4];  // of the block
    struct Sharp {
        const Bundle* bundle;
        S weight[kMostLanes];
    } sharp[2 * (kFewStrata + 2) * (kFewStrata + 2)];
    int sharps = 0;
    bool any_soft = false, any_alone;  // looked up for each pixel
    Bundles bundles[kMostStrata * kMostStrata];
};

/// Not inlined: its stack, some megabytes, is that of one way through the array.
template <optics::Way through>
__attribute__((noinline)) void render_block(const Tile& tile, const EvenCuts& even, std::int32_t x, std::int32_t y) {
    BlockRenderer<through>(tile, even, x, y).render();
}

template <optics::Way through>
void render_filtered(const Tile& tile) {
    const EvenCuts even(*tile.scene, tile.strata);
    const std::int32_t side = tile.block_side;
    for (std::int32_t y = tile.y0 / side * side; y < tile.y1; y += side)
        for (std::int32_t x = tile.x0 / side * side; x < tile.x1; x += side) render_block<through>(tile, even, x, y);
}

}  // namespace

}  // namespace lfdsim
