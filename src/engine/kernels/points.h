// The estimator `point`: all samples of a packet of pixels.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "optics/light.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

constexpr std::uint32_t block_samples = 256;  // samples summed in one go (even), so that rounding does not grow with their number

template <optics::Way through, bool pinhole>
LFDSIM_APART optics::PanelHit<F> trace_one(const Tile& tile, const optics::PixelRays<F>& pixels,
                                           const optics::Sampler<F>& sampler) {
    return optics::trace<through, pinhole>(*tile.scene, *tile.view, pixels, sampler);
}

/// Lanes are neighbouring pixels, and each adds its samples in order, two at a time, so that no bit depends on the packet a pixel
/// is in. The light of two samples is fetched while the next two are traced, so that memory latency is hidden.
///
/// With several lanes two samples are traced side by side (optics/pair.h). A GPU thread traces one after the other: there other
/// threads hide latency, and registers are scarce. It does not call trace_one() either, which would keep the sampler out of the
/// registers.
template <optics::Way through, bool pinhole = false>
LFDSIM_FN optics::Light<F> gather(const Tile& tile, const optics::PixelRays<F>& pixels, optics::Uint<F> pixel) {
    constexpr bool one_lane = optics::LaneTraits<F>::width == 1;
    const optics::Scene<float>& scene = *tile.scene;
    optics::Sampler<F> even(tile.sampling, tile.dimensions, tile.view->seed, pixel), odd = even;
    odd.next(*tile.directions);
    const auto twice = optics::twice(pixels);
    optics::Light<F> total;
    for (std::uint32_t sample = 0; sample + 1 < tile.samples;) {
        optics::Light<F> block;
        optics::Fetch<F> first, second;  // of the last two samples
        const std::uint32_t end = tile.samples - sample < block_samples ? tile.samples : sample + block_samples;
        for (; sample + 1 < end; sample += 2) {
            optics::PanelHit<F> a, b;
            if constexpr (one_lane) {
                a = optics::trace<through, pinhole>(scene, *tile.view, pixels, even);
                b = optics::trace<through, pinhole>(scene, *tile.view, pixels, odd);
            } else {
                const auto hit = optics::trace<through, pinhole>(scene, *tile.view, twice, optics::SamplerPair<F>{even, odd});
                a = {hit.pixel.a, hit.weight.a, hit.lit.a};
                b = {hit.pixel.b, hit.weight.b, hit.lit.b};
            }
            block.add(scene.emission, tile.texels, first, second);
            first = optics::Fetch<F>(a);
            second = optics::Fetch<F>(b);
            even.next(*tile.directions);
            even.next(*tile.directions);
            odd.next(*tile.directions);
            odd.next(*tile.directions);
        }
        block.add(scene.emission, tile.texels, first, second);
        total.add(block);
    }
    if (tile.samples % 2 == 1) {
        if constexpr (one_lane)
            total.add(scene.emission, tile.texels,
                      optics::Fetch<F>(optics::trace<through, pinhole>(scene, *tile.view, pixels, even)));
        else
            total.add(scene.emission, tile.texels, optics::Fetch<F>(trace_one<through, pinhole>(tile, pixels, even)));
    }
    return total;
}

}  // namespace

}  // namespace lfdsim
