// The kernel's source, compiled once for each instruction set (kernels.cmake): LFDSIM_ISA names it, LFDSIM_LANES is its width.
// Floor 2. No header with templates of the standard library: a copy compiled for AVX-512 must never be linked into another kernel.
#include "engine/devices/kernel.h"
#if LFDSIM_LANES > 1
#include "simd/simd.h"
#else
#include "simd/lane.h"
#endif

namespace lfdsim {

namespace {

#if LFDSIM_LANES > 1
using F = optics::Lane<LFDSIM_LANES>;
#else
using F = float;
#endif

}  // namespace
}  // namespace lfdsim

#include "engine/kernels/filtered.h"
#include "engine/kernels/lens_by_lens.h"
#include "engine/kernels/points.h"
#include "optics/camera.h"
#include "optics/light.h"
#include "optics/trace.h"

namespace lfdsim {
namespace {

/// Keeps the rays of a packet's pixels, those whose light gather() sums. (x, y): the pixel of the first lane.
template <optics::Facts facts>
LFDSIM_APART void keep_rays(const Tile& tile, const optics::PixelRays<F>& pixels, optics::Uint<F> pixel, std::int32_t x,
                            std::int32_t y) {
    using Block = optics::Block<F>;
    optics::Sampler<F> sampler(tile.sampling, tile.dimensions, tile.view->seed, pixel);
    for (std::uint32_t sample = 0; sample < tile.samples; ++sample) {
        const optics::Fetch<F> fetch(trace_one<facts>(tile, pixels, sampler));
        std::uint32_t place[Block::lanes];
        float share[Block::lanes];
        optics::store(fetch.place >> optics::Fetch<F>::shift, place);
        optics::store(fetch.weight, share);
        for (int k = 0; k < Block::lanes; ++k) {
            const std::int32_t column = x + k % Block::width, row = y + k / Block::width;
            if (column < tile.x0 || column >= tile.x1 || row < tile.y0 || row >= tile.y1) continue;
            const std::int64_t number = std::int64_t(row - tile.crop_y) * tile.crop_width + (column - tile.crop_x);
            tile.rays[number * tile.samples + sample] = {place[k], share[k]};
        }
        sampler.next(*tile.directions);
    }
}

/// Renders a tile by points, packet by packet. A packet's pixels that lie outside the tile are traced, too, but not written.
template <optics::Facts facts>
bool render_points(const Tile& tile) {
    using Block = optics::Block<F>;
    Cancelling cancelling(tile);
    std::uint32_t lane[Block::lanes];  // number of the lane's pixel in the frame, minus that of the block's first
    for (int k = 0; k < Block::lanes; ++k) lane[k] = std::uint32_t(k / Block::width * tile.view->width + k % Block::width);
    for (std::int32_t y = tile.y0 / Block::height * Block::height; y < tile.y1; y += Block::height) {
        for (std::int32_t x = tile.x0 / Block::width * Block::width; x < tile.x1; x += Block::width) {
            const auto pixel =
                optics::load<F>(lane) + optics::Uint<F>(std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x));
            const optics::PixelRays<F> pixels = optics::pixel_rays<F>(*tile.view, x, y);
            if (tile.rays) {
                if (cancelling.ends_before(std::int64_t(tile.samples) * Block::lanes)) return false;
                keep_rays<facts>(tile, pixels, pixel, x, y);
                continue;
            }
            const optics::Light<F> light = gather<facts>(tile, pixels, pixel, cancelling);
            if (cancelling.ended()) return false;
            for (int k = 0; k < Block::lanes; ++k) {
                const std::int32_t column = x + k % Block::width, row = y + k / Block::width;
                if (column < tile.x0 || column >= tile.x1 || row < tile.y0 || row >= tile.y1) continue;
                float* const out = tile.out + (std::int64_t(row - tile.crop_y) * tile.crop_width + (column - tile.crop_x)) * 3;
                for (int c = 0; c < 3; ++c) out[c] = light(k, c) / float(tile.samples);
            }
        }
    }
    return true;
}

}  // namespace

/// The kernel of this instruction set (engine/devices/kernel.h).
bool LFDSIM_KERNEL(const Tile& tile) {
    if (tile.strata > 0 && tile.lens_by_lens) return render_lens_by_lens(tile);
    if (tile.strata > 0) return render_filtered(tile);
    return optics::with_facts(*tile.display, [&]<optics::Facts facts>() { return render_points<facts>(tile); });
}

}  // namespace lfdsim
