// The kernel's source, compiled once for each instruction set (kernels.cmake): LFDSIM_ISA names it, LFDSIM_LANES is its width.
// Floor 2. No header of the standard library's templates: a copy of one compiled for AVX-512 must never serve another kernel.
#include "engine/kernel.h"
#if LFDSIM_LANES > 1
#include "optics/simd.h"
#endif
#include "optics/light.h"
#include "optics/trace.h"

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

namespace lfdsim {
namespace {

constexpr std::uint32_t kBlock = 256;  // samples summed in one go (even), so that rounding does not grow with their number

template <optics::Way through>
__attribute__((noinline)) optics::PanelHit<F> trace_one(const Tile& tile, const optics::PixelRays<F>& pixels,
                                                        const optics::Sampler<F>& sampler) {
    return optics::trace<through>(*tile.scene, *tile.view, pixels, sampler);
}

/// Lanes are neighbouring pixels and each adds its samples in their order, two at a time, so that no bit depends on the packet a
/// pixel is in. The light of two samples is fetched while the next two are traced: neither then waits for the other.
template <optics::Way through>
LFDSIM_FN optics::Light<F> gather(const Tile& tile, const optics::PixelRays<F>& pixels, optics::Uint<F> pixel) {
    optics::Sampler<F> even(tile.sampling, tile.dimensions, tile.view->seed, pixel), odd = even;
    odd.next(*tile.directions);
    const auto twice = optics::twice(pixels);
    optics::Light<F> total;
    for (std::uint32_t sample = 0; sample + 1 < tile.samples;) {
        optics::Light<F> block;
        optics::Fetch<F> first, second;  // of the last two samples
        const std::uint32_t end = tile.samples - sample < kBlock ? tile.samples : sample + kBlock;
        for (; sample + 1 < end; sample += 2) {
            const auto hit = optics::trace<through>(*tile.scene, *tile.view, twice, optics::SamplerPair<F>{even, odd});
            block.add(tile.texels, first, second);
            first = optics::Fetch<F>({hit.pixel.a, hit.weight.a, hit.lit.a});
            second = optics::Fetch<F>({hit.pixel.b, hit.weight.b, hit.lit.b});
            even.next(*tile.directions);
            even.next(*tile.directions);
            odd.next(*tile.directions);
            odd.next(*tile.directions);
        }
        block.add(tile.texels, first, second);
        total.add(block);
    }
    if (tile.samples % 2 == 1) total.add(tile.texels, optics::Fetch<F>(trace_one<through>(tile, pixels, even)));
    return total;
}

template <optics::Way through>
void render_points(const Tile& tile) {
    using Block = optics::Block<F>;
    std::uint32_t lane[Block::lanes];  // number of its pixel in the frame, from the block's first
    for (int k = 0; k < Block::lanes; ++k) lane[k] = std::uint32_t(k / Block::width * tile.view->width + k % Block::width);
    for (std::int32_t y = tile.y0 / Block::height * Block::height; y < tile.y1; y += Block::height) {
        for (std::int32_t x = tile.x0 / Block::width * Block::width; x < tile.x1; x += Block::width) {
            const auto pixel =
                optics::load<F>(lane) + optics::Uint<F>(std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x));
            const optics::Light<F> light = gather<through>(tile, optics::pixel_rays<F>(*tile.view, x, y), pixel);
            for (int k = 0; k < Block::lanes; ++k) {
                const std::int32_t column = x + k % Block::width, row = y + k / Block::width;
                if (column < tile.x0 || column >= tile.x1 || row < tile.y0 || row >= tile.y1) continue;
                float* const out = tile.out + (std::int64_t(row - tile.crop_y) * tile.crop_width + (column - tile.crop_x)) * 3;
                for (int c = 0; c < 3; ++c) out[c] = light(k, c) / float(tile.samples);
            }
        }
    }
}

template <optics::Way through>
void render_tile(const Tile& tile) {
    tile.strata > 0 ? render_filtered<through>(tile) : render_points<through>(tile);
}

}  // namespace

void LFDSIM_KERNEL(const Tile& tile) {
    switch (optics::way_through(*tile.scene)) {
        case optics::Way::plano_convex:
            return render_tile<optics::Way::plano_convex>(tile);
        case optics::Way::opaque:
            return render_tile<optics::Way::opaque>(tile);
        case optics::Way::ideal:
            return render_tile<optics::Way::ideal>(tile);
        case optics::Way::glass:
            return render_tile<optics::Way::glass>(tile);
    }
}

}  // namespace lfdsim
