// The filtered estimator: pixels of blocks in which they share nothing.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/kernels/filtered_axis.h"
#include "engine/kernels/filtered_own.h"
#include "optics/camera.h"

namespace lfdsim {

namespace {

/// The numbers, in the frame, of the packet of pixels at (x, y).
LFDSIM_FN optics::Uint<F> pixel_numbers(const Tile& tile, std::int32_t x, std::int32_t y) {
    using Packet = optics::Block<F>;
    const auto width = std::uint32_t(tile.view->width);
    std::uint32_t number[Packet::lanes];
    for (int k = 0; k < Packet::lanes; ++k)
        number[k] =
            (std::uint32_t(y) + std::uint32_t(k / Packet::width)) * width + std::uint32_t(x) + std::uint32_t(k % Packet::width);
    return optics::load<F>(number);
}

/// Do the camera's pixels or its pupil spread the light?
LFDSIM_BOTH bool camera_spreads(const optics::Scene<S>& scene) { return scene.box_filter || scene.thin_lens; }

/// Random numbers for a stratum, which is one of max_strata x max_strata, in all its pixels.
LFDSIM_FN optics::Sampler<F> own_sampler(const Tile& tile, optics::Uint<F> pixels, std::uint32_t stratum) {
    optics::Sampler<F> sampler(Sampling::random, camera_spreads(*tile.scene) ? 6 : 2, tile.view->seed, pixels);
    sampler.sample = stratum * 8;
    return sampler;
}

/// The light of the packet of pixels at (x, y): by rays of their own in each cell of the square's even cuts.
template <optics::Way through>
LFDSIM_BOTH optics::Light<F> light_alone(const Tile& tile, const EvenCuts& even, std::int32_t x, std::int32_t y) {
    const optics::PixelRays<F> pixels = optics::pixel_rays<F>(*tile.view, x, y);
    const optics::Uint<F> numbers = pixel_numbers(tile, x, y);
    const auto span = [&](int k) {
        const F low = F(even.number[k]), high = F(even.number[k + 1]), none = F(0);
        return Span<F>{low, high, F(0.5f) * (high - low), none, none, none, none};
    };
    optics::Corners<F> whole;  // of no cell
    whole.count = 0;
    optics::Light<F> light;
    for (int j = 0; j < even.strata; ++j) {
        for (int i = 0; i < even.strata; ++i) {
            const Span<F> across = span(i), up = span(j);
            add_own_rays<through>(tile, pixels, across, up, whole, Own::all, across.share * up.share,
                                  own_sampler(tile, numbers, std::uint32_t(j * max_strata + i)), light);
        }
    }
    return light;
}

}  // namespace

}  // namespace lfdsim
