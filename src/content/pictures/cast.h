// Casting of the rays of a picture, in packets, on all threads. Floor 2, internal to content.
#pragma once
#include "base/on_threads.h"
#include "base/seconds.h"
#include "content/pictures/ray_block.h"

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/parallel_for.h>

#include <atomic>
#include <chrono>

namespace lfdsim {

/// The rays to cast: `samples` for each pixel of `crop`, in a frame of width x height pixels. A pixel's light is the mean over
/// those that exist. By channel, each of red, green and blue has `samples` rays, in this order.
struct RayRequest {
    int width, height;
    Rect crop;
    std::int64_t samples = 1;
    bool by_channel = false;
};

/// Casts the rays and returns the picture of the crop. fill(column, row, block) sets the rays of the 4 x 4 pixels from (column,
/// row) on, for the sample number in the block; a block's samples come in their order. light_of(block) sets their light, as
/// SceneLight does. Blocks are aligned to the frame, never to the crop or to a thread's share, so that a pixel does not depend on
/// how the frame is divided. Throws InputError for a crop outside the frame or a bad number of threads.
template <class Light, class Fill>
Picture cast(const Light& light_of, const RayRequest& frame, int threads, const char* stage, Job& job, const Fill& fill) {
    const int width = frame.width, height = frame.height;
    const Rect& crop = frame.crop;
    const std::int64_t samples = frame.by_channel ? 3 * frame.samples : frame.samples;
    if (crop.x0 < 0 || crop.y0 < 0 || crop.x1 > width || crop.y1 > height || crop.x0 >= crop.x1 || crop.y0 >= crop.y1)
        throw InputError("crop", "it must lie inside the frame, which has " + std::to_string(width) + " x " +
                                     std::to_string(height) + " pixels");
    if (threads < 0 || threads > most_threads)
        throw InputError("threads", std::to_string(threads) + " given; allowed are 0 (all) to " + std::to_string(most_threads));
    constexpr int tile = 64, often = 1 << 10;  // packets between questions whether the job was cancelled: milliseconds
    const int columns = (crop.x1 + tile - 1) / tile - crop.x0 / tile, rows = (crop.y1 + tile - 1) / tile - crop.y0 / tile;
    const auto start = std::chrono::steady_clock::now();
    Picture out{Image(crop.x1 - crop.x0, crop.y1 - crop.y0), true, 0, 0};
    std::atomic<std::int64_t> cast{0}, dark{0};
    std::atomic<bool> stopped{false};
    const auto one_tile = [&](int tile_column, int tile_row) {
        const int x0 = (crop.x0 / tile + tile_column) * tile, y0 = (crop.y0 / tile + tile_row) * tile;
        std::int64_t count = 0, count_dark = 0, since_asked = 0;
        RayBlock block;
        Lanes::Mask wanted;
        double sum[3][RayBlock::lanes];                            // light of the samples that hit
        int summed[3][RayBlock::lanes], lost[3][RayBlock::lanes];  // numbers of samples that exist, and that are dark
        for (int y = y0; y < y0 + tile; y += RayBlock::side) {
            for (int x = x0; x < x0 + tile; x += RayBlock::side) {
                if (y + RayBlock::side <= crop.y0 || y >= crop.y1 || x + RayBlock::side <= crop.x0 || x >= crop.x1) continue;
                // Blocks at the crop's border have pixels outside of it, which are computed but not kept.
                const bool inside = x >= crop.x0 && y >= crop.y0 && x + RayBlock::side <= crop.x1 && y + RayBlock::side <= crop.y1;
                bool lit = false;
                std::fill_n(summed[0], 3 * RayBlock::lanes, 0);
                std::fill_n(lost[0], 3 * RayBlock::lanes, 0);
                for (block.sample = 0; block.sample < samples; ++block.sample) {
                    if (++since_asked == often) {  // a tile of many samples may take long
                        since_asked = 0;
                        if (job.cancelled()) {
                            stopped = true;
                            return;
                        }
                    }
                    fill(x, y, block);
                    // Pixels beyond the frame have no rays.
                    if (!inside) {
                        for (int k = 0; k < RayBlock::lanes; ++k) {
                            const int i = x + k % RayBlock::side, j = y + k / RayBlock::side;
                            block.exists.of[k] &= -(int(i < width) & int(j < height));
                            block.may_hit.of[k] &= block.exists.of[k];
                            block.dark.of[k] &= -(int(i < width) & int(j < height));
                            wanted.of[k] = -(int(i >= crop.x0) & int(i < crop.x1) & int(j >= crop.y0) & int(j < crop.y1));
                        }
                    }
                    const int first = frame.by_channel ? int(block.sample / frame.samples) : 0,
                              last = frame.by_channel ? first + 1 : 3;  // channels that this ray is for: first to last - 1
                    int number = 0;
                    for (int k = 0; k < RayBlock::lanes; ++k) {
                        number -= block.exists.of[k] & (inside ? -1 : wanted.of[k]);
                        for (int c = first; c < last; ++c) summed[c][k] -= block.exists.of[k], lost[c][k] -= block.dark.of[k];
                    }
                    count += number;
                    if (!light_of(block)) continue;
                    if (!lit) std::fill_n(sum[0], 3 * RayBlock::lanes, 0.);
                    lit = true;
                    for (int k = 0; k < RayBlock::lanes; ++k)
                        for (int c = first; c < last && block.hit.of[k]; ++c) sum[c][k] += double(block.light[c].of[k]);
                }
                // A pixel, or a channel of it, is dark if it has dark samples and no others.
                for (int k = 0; k < RayBlock::lanes; ++k)
                    for (int c = 0; c < (frame.by_channel ? 3 : 1); ++c)
                        count_dark += (lost[c][k] > 0) & (summed[c][k] == 0) & (inside || wanted.of[k] != 0);
                if (!lit) continue;
                for (int k = 0; k < RayBlock::lanes; ++k) {
                    if (!inside && !wanted.of[k]) continue;
                    float* to = out.image.at(x + k % RayBlock::side - crop.x0, y + k / RayBlock::side - crop.y0);
                    for (int c = 0; c < 3; ++c) to[c] = float(sum[c][k] / std::max(summed[c][k], 1));
                }
            }
        }
        cast += count;
        dark += count_dark;
    };
    job.stage(stage, std::int64_t(columns) * rows);
    on_threads(threads, [&] {
        tbb::parallel_for(tbb::blocked_range2d<int>(0, rows, 0, columns), [&](const tbb::blocked_range2d<int>& range) {
            for (int r = range.rows().begin(); r < range.rows().end(); ++r) {
                for (int c = range.cols().begin(); c < range.cols().end(); ++c) {
                    if (stopped || job.cancelled()) {
                        stopped = true;
                        return;
                    }
                    one_tile(c, r);
                    job.advance(1);
                }
            }
        });
    });
    out.seconds = seconds_since(start);
    out.rays = cast;
    out.dark = dark;
    out.complete = !stopped;
    return out;
}

}  // namespace lfdsim
