// The filtered estimator: the loop over blocks, packets and strata.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernels/filtered_bundles.h"
#include "engine/kernels/filtered_own.h"

namespace lfdsim {

namespace {

/// Colour c of a soft bundle for the packet that begins at pixel (x, y) of the block; dx, dy from its middle, pixels.
LFDSIM_FN F soft_light(const Bundle& b, const optics::PixelBlock<S>& block, int x, int y, F dx, F dy, int c) {
    if (b.nodes == 1) return F(b.colour[0][c]);
    const int step = b.node_step(block), i = x / step, j = y / step, n = b.nodes;
    const S(*const corner)[3] = b.colour + j * n + i;
    const S a = corner[0][c], right = corner[1][c] - a, down = corner[n][c] - a, both = corner[n + 1][c] - corner[n][c] - right;
    const S per = S(1) / S(step);
    const F s = dx * F(per) + F(S(block.reach) * per - S(i)), t = dy * F(per) + F(S(block.reach) * per - S(j));
    return F(a) + F(right) * s + (F(down) + F(both) * s) * t;
}

template <optics::Way through>
void render_block(const Tile& tile, const EvenCuts& even, std::int32_t x0, std::int32_t y0) {
    using Packet = optics::Block<F>;
    const optics::Scene<S>& scene = *tile.scene;
    const optics::PixelBlock<S> block = optics::pixel_block<S>(scene, *tile.view, tile.block_side, x0, y0);
    const Axis axis[2] = {cut_axis(scene, block.sweep[0], block.alive, 0, even),
                          cut_axis(scene, block.sweep[1], block.alive, 1, even)};
    Bundles bundles[kMostStrata * kMostStrata];
    if (block.alive)
        BundleMaker<through>(tile, block, axis).make(bundles);
    else
        for (int k = 0; k < axis[0].strata * axis[1].strata; ++k) bundles[k].through.state = Bundle::State::broken;

    S right_of[Packet::lanes], below[Packet::lanes];  // of a packet's first pixel
    std::uint32_t number[Packet::lanes];
    for (int k = 0; k < Packet::lanes; ++k) {
        right_of[k] = S(k % Packet::width);
        below[k] = S(k / Packet::width);
        number[k] = std::uint32_t(k / Packet::width * tile.view->width + k % Packet::width);
    }
    const F lane_right = optics::load<F>(right_of), lane_below = optics::load<F>(below);
    for (std::int32_t y = y0; y < y0 + tile.block_side; y += Packet::height) {
        for (std::int32_t x = x0; x < x0 + tile.block_side; x += Packet::width) {
            if (x >= tile.x1 || y >= tile.y1 || x + Packet::width <= tile.x0 || y + Packet::height <= tile.y0) continue;
            const F dx = lane_right + F(S(x - x0 - block.reach) + S(0.5)), dy = lane_below + F(S(y - y0 - block.reach) + S(0.5)),
                    per = F(S(1) / S(block.reach));
            Span<F> spans[2][kMostStrata];
            for (int a = 0; a < 2; ++a) spans_of(scene, axis[a], dx * per, dy * per, spans[a]);

            optics::Light<F> light;
            F flat[3] = {F(0), F(0), F(0)};
            bool own_ready = false;
            optics::PixelRays<F> pixels;
            auto add_own = [&](const Span<F>& a, const Span<F>& b, Own part, F weight) {
                if (!own_ready) pixels = optics::pixel_rays<F>(*tile.view, x, y);
                own_ready = true;
                const auto first = std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x);
                optics::Sampler<F> sampler(Sampling::random, 2, tile.view->seed, optics::load<F>(number) + optics::Uint<F>(first));
                sampler.sample = std::uint32_t((&b - spans[1]) * kMostStrata + (&a - spans[0])) * 8;
                add_own_rays<through>(tile, pixels, a, b, part, weight, sampler, light);
            };
            const Bundles* next = bundles;
            for (int j = 0; j < axis[1].strata; ++j) {
                for (int i = 0; i < axis[0].strata; ++i) {
                    const Bundles& b = *next++;
                    const Span<F>&across = spans[0][i], &up = spans[1][j];
                    const F share = across.share * up.share;
                    if (optics::none(share > F(0))) continue;  // a border that only other packets of the block see
                    if (b.through.state == Bundle::State::broken) {
                        const bool covered =
                            scene.hole_radius > 0 && !scene.leaky && block.alive && !axis[0].straddles[i] && !axis[1].straddles[j];
                        add_own(across, up, covered ? Own::covered : Own::all, share);
                        continue;
                    }
                    const F cover = scene.hole_radius > 0 ? optics::hole_cover(across, up) : F(1);
                    auto add = [&](const Bundle& bundle, F part) {
                        if (bundle.state == Bundle::State::dark) return;
                        const F weight = share * part * F(bundle.weight);
                        if (bundle.state == Bundle::State::soft) {
                            for (int c = 0; c < 3; ++c)
                                flat[c] = flat[c] + weight * soft_light(bundle, block, x - x0, y - y0, dx, dy, c);
                            return;
                        }
                        bundle.footprint.add(light, F(bundle.column) + F(bundle.column_right) * dx + F(bundle.column_down) * dy,
                                             F(bundle.row) + F(bundle.row_right) * dx + F(bundle.row_down) * dy, weight);
                    };
                    add(b.through, cover);
                    if (!scene.leaky || scene.hole_radius == 0) continue;
                    if (b.beside.state != Bundle::State::broken)
                        add(b.beside, F(1) - cover);
                    else if (optics::any(cover < F(0.9999f)))
                        add_own(across, up, Own::beside, share * (F(1) - cover));
                }
            }
            S moved[4 * Packet::lanes], still[3][Packet::lanes];
            light.store(moved);
            for (int c = 0; c < 3; ++c) optics::store(flat[c], still[c]);
            for (int k = 0; k < Packet::lanes; ++k) {
                const std::int32_t column = x + k % Packet::width, row = y + k / Packet::width;
                if (column < tile.x0 || column >= tile.x1 || row < tile.y0 || row >= tile.y1) continue;
                float* const out = tile.out + (std::int64_t(row - tile.crop_y) * tile.crop_width + (column - tile.crop_x)) * 3;
                for (int c = 0; c < 3; ++c) out[c] = moved[4 * k + c] + still[c][k];
            }
        }
    }
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
