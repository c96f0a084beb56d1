// The estimator `point`: all samples of a packet of pixels.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/kernels/cancelling.h"
#include "optics/light.h"
#include "optics/trace.h"

namespace lfdsim {

namespace {

constexpr std::uint32_t block_samples = 256;  // samples summed in one go (even), so that rounding does not grow with their number

/// Returns what one sample of each pixel reaches; a separate function for the samples that are not traced in pairs.
template <optics::Facts facts>
LFDSIM_APART optics::PanelHit<F> trace_one(const Tile& tile, const optics::PixelRays<F>& pixels,
                                           const optics::Sampler<F>& sampler) {
    return optics::trace<facts>(*tile.display, *tile.view, pixels, sampler);
}

/// Returns the sum of a pixel's samples, for a GPU's thread: there other threads hide latency, while registers, and code that does
/// not fit into the cache of instructions, are costly. So one loop, with none inside it, traces all samples. They are added in the
/// order of gather(). It does not call trace_one(), which would keep the sampler out of the registers.
template <optics::Facts facts, bool sobol, class MayEnd>
LFDSIM_FN optics::Light<F> gather_one(const Tile& tile, const optics::PixelRays<F>& pixels, std::uint32_t pixel,
                                      MayEnd& cancelling) {
    const optics::TracedDisplay<float>& display = *tile.display;
    optics::Sampler<F> sampler(sobol ? Sampling::sobol : tile.sampling,
                               facts.plain_light == optics::Known::yes ? 2 : tile.dimensions, tile.view->seed, pixel);
    optics::Light<F> total, block, pair;
#ifdef __CUDACC__
#pragma unroll 1
#endif
    for (std::uint32_t k = 0; k < tile.samples; ++k) {
        const optics::Fetch<F> fetch(optics::trace<facts>(display, *tile.view, pixels, sampler));
        if constexpr (facts.plain_light == optics::Known::yes)
            pair.add(tile.texels, fetch);
        else
            pair.add(display.emission, tile.texels, fetch);
        sampler.next(*tile.directions);
        if (k % 2 == 0 && k + 1 < tile.samples) continue;  // the pair's second is to come
        block.add(pair);
        pair = {};
        if ((k + 1) % block_samples == 0 || k + 2 >= tile.samples) {  // the last of an odd number is a separate block
            total.add(block);
            block = {};
            if (cancelling.ends_before(block_samples)) break;
        }
    }
    return total;
}

/// Returns the sum of the samples of a packet's pixels. Lanes are neighbouring pixels, and each adds its samples in order, two at a
/// time, so that no bit depends on the packet a pixel is in. The light of two samples is fetched while the next two, traced side by
/// side (simd/pair.h), are on their way, so that memory latency is hidden. Where `cancelling` ends, the sum is unfinished.
template <optics::Facts facts>
LFDSIM_FN optics::Light<F> gather(const Tile& tile, const optics::PixelRays<F>& pixels, optics::Uint<F> pixel,
                                  Cancelling& cancelling) {
    if constexpr (optics::LaneTraits<F>::width == 1) return gather_one<facts, false>(tile, pixels, pixel, cancelling);
    const optics::TracedDisplay<float>& display = *tile.display;
    optics::Sampler<F> even(tile.sampling, tile.dimensions, tile.view->seed, pixel), odd = even;
    odd.next(*tile.directions);
    const auto twice = optics::twice(pixels);
    optics::Light<F> total;
    for (std::uint32_t sample = 0; sample + 1 < tile.samples;) {
        optics::Light<F> block;
        optics::Fetch<F> first, second;  // of the last two samples
        const std::uint32_t end = tile.samples - sample < block_samples ? tile.samples : sample + block_samples;
        if (cancelling.ends_before(std::int64_t(end - sample) * optics::Block<F>::lanes)) break;
        for (; sample + 1 < end; sample += 2) {
            const auto hit = optics::trace<facts>(display, *tile.view, twice, optics::SamplerPair<F>{even, odd});
            block.add(display.emission, tile.texels, first, second);
            first = optics::Fetch<F>({hit.pixel.a, hit.weight.a, hit.lit.a});
            second = optics::Fetch<F>({hit.pixel.b, hit.weight.b, hit.lit.b});
            even.next(*tile.directions);
            even.next(*tile.directions);
            odd.next(*tile.directions);
            odd.next(*tile.directions);
        }
        block.add(display.emission, tile.texels, first, second);
        total.add(block);
    }
    if (tile.samples % 2 == 1) total.add(display.emission, tile.texels, optics::Fetch<F>(trace_one<facts>(tile, pixels, even)));
    return total;
}

}  // namespace

}  // namespace lfdsim
