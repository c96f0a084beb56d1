// Rays through a picture, in packets, on all threads. Floor 2, internal to content.
#pragma once
#include "content/scene.h"

#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace lfdsim {

/// Sixteen rays of a 4 x 4 block of pixels, starting in a plane before the scene; origins about the scene's centre. A ray ends
/// being of interest after `span` (in units of its direction), where the scene is over.
struct RayBlock {
    static constexpr int side = 4, lanes = side * side;
    alignas(64) float x[lanes], y[lanes], z[lanes], dx[lanes], dy[lanes], dz[lanes];
    bool exists[lanes];
};

/// What all rays of a picture share.
struct Beam {
    float span;         // rays leave the scene's box before t = span
    float width_per_t;  // width of a ray's footprint in mm: width_per_t |t - waist_t|
    float waist_t;
};

/// Marks the lanes whose segment from t = 0 to span could meet the box: only those are traced.
inline bool may_hit(const RayBlock& rays, const Vec3d& half_mm, float span, int* valid) {
    // The slack covers the rounding of positions (about 1e-7 of the box) and of the arithmetic here.
    const float hx = float(half_mm[0] * 1.0001 + 1e-6), hy = float(half_mm[1] * 1.0001 + 1e-6),
                hz = float(half_mm[2] * 1.0001 + 1e-6);
    const auto beyond = [](float a, float b, float h) { return int(std::min(a, b) > h) | int(std::max(a, b) < -h); };
    int any = 0;
    for (int k = 0; k < RayBlock::lanes; ++k) {
        const int misses = beyond(rays.x[k], rays.x[k] + span * rays.dx[k], hx) |
                           beyond(rays.y[k], rays.y[k] + span * rays.dy[k], hy) |
                           beyond(rays.z[k], rays.z[k] + span * rays.dz[k], hz);
        valid[k] = (misses | int(!rays.exists[k])) - 1;
        any |= valid[k];
    }
    return any != 0;
}

/// Traces and shades one block; `paint(lane, colour)` for each ray that meets the scene.
template <class Paint>
void trace(const Scene::Impl& scene, const Beam& beam, const RayBlock& rays, const Paint& paint) {
    alignas(64) int valid[RayBlock::lanes];
    if (!may_hit(rays, scene.half_mm, beam.span, valid)) return;
    RTCRayHit16 hit;
    for (int k = 0; k < RayBlock::lanes; ++k) {
        hit.ray.org_x[k] = rays.x[k];
        hit.ray.org_y[k] = rays.y[k];
        hit.ray.org_z[k] = rays.z[k];
        hit.ray.dir_x[k] = rays.dx[k];
        hit.ray.dir_y[k] = rays.dy[k];
        hit.ray.dir_z[k] = rays.dz[k];
        hit.ray.tnear[k] = 0;
        hit.ray.tfar[k] = INFINITY;
        hit.ray.time[k] = 0;
        hit.ray.mask[k] = ~0u;
        hit.ray.flags[k] = 0;
        hit.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        hit.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
    }
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect16(valid, scene.tree.get(), &context, &hit);
    for (int k = 0; k < RayBlock::lanes; ++k) {
        if (!valid[k] || hit.hit.geomID[k] == RTC_INVALID_GEOMETRY_ID) continue;
        const float width = beam.width_per_t * std::abs(hit.ray.tfar[k] - beam.waist_t);
        paint(k, scene.shade(hit.hit.primID[k], hit.hit.u[k], hit.hit.v[k], width));
    }
}

/// Casts one ray for every pixel of `crop` in a frame of width x height pixels. fill(column, row, block) sets the rays of the
/// 4 x 4 pixels from there on. Blocks are aligned to the frame, never to the crop or to a thread's share, so that every pixel
/// comes out the same whichever way the frame is divided. Throws InputError for a crop outside the frame or a bad thread count.
template <class Fill>
Picture cast(const Scene::Impl& scene, const Beam& beam, int width, int height, const Rect& crop, int threads, const char* stage,
             Job& job, const Fill& fill) {
    if (crop.x0 < 0 || crop.y0 < 0 || crop.x1 > width || crop.y1 > height || crop.x0 >= crop.x1 || crop.y0 >= crop.y1)
        throw InputError("crop", "it must lie inside the frame, which has " + std::to_string(width) + " x " +
                                     std::to_string(height) + " pixels");
    if (threads < 0 || threads > 4096) throw InputError("threads", std::to_string(threads) + " given; allowed are 0 (all) to 4096");
    constexpr int tile = 64;
    const int columns = (crop.x1 + tile - 1) / tile - crop.x0 / tile, rows = (crop.y1 + tile - 1) / tile - crop.y0 / tile;
    const auto start = std::chrono::steady_clock::now();
    Picture out{Image(crop.x1 - crop.x0, crop.y1 - crop.y0), true, 0, 0};
    std::atomic<std::int64_t> cast{0};
    std::atomic<bool> stopped{false};
    const auto one_tile = [&](int tile_column, int tile_row) {
        const int x0 = (crop.x0 / tile + tile_column) * tile, y0 = (crop.y0 / tile + tile_row) * tile;
        std::int64_t count = 0;
        RayBlock rays;
        for (int y = y0; y < y0 + tile; y += RayBlock::side) {
            for (int x = x0; x < x0 + tile; x += RayBlock::side) {
                if (y + RayBlock::side <= crop.y0 || y >= crop.y1 || x + RayBlock::side <= crop.x0 || x >= crop.x1) continue;
                fill(x, y, rays);
                const auto wanted = [&](int k) {
                    const int i = x + k % RayBlock::side, j = y + k / RayBlock::side;
                    return i >= crop.x0 && i < crop.x1 && j >= crop.y0 && j < crop.y1;
                };
                for (int k = 0; k < RayBlock::lanes; ++k) {
                    rays.exists[k] = rays.exists[k] && x + k % RayBlock::side < width && y + k / RayBlock::side < height;
                    count += rays.exists[k] && wanted(k);
                }
                trace(scene, beam, rays, [&](int k, const Rgb& colour) {
                    if (!wanted(k)) return;
                    float* to = out.image.at(x + k % RayBlock::side - crop.x0, y + k / RayBlock::side - crop.y0);
                    to[0] = colour.r;
                    to[1] = colour.g;
                    to[2] = colour.b;
                });
            }
        }
        cast += count;
    };
    job.stage(stage, std::int64_t(columns) * rows);
    // More threads than processors are granted too, when asked for.
    const int workers = threads > 0 ? threads : tbb::info::default_concurrency();
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, std::size_t(workers));
    tbb::task_arena arena(workers);
    arena.execute([&] {
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
    out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    out.rays = cast;
    out.complete = !stopped;
    return out;
}

}  // namespace lfdsim
