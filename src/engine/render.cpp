#include "engine/render.h"

#include "engine/devices.h"
#include "engine/scene.h"

#include <tbb/blocked_range2d.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <fmt/format.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

namespace lfdsim {

namespace {

constexpr int kTileWidth = 64, kTileHeight = 16;  // near pixels look at near panel pixels: a tile's texels stay in the cache
constexpr int kMostThreads = 1024;

Rect checked_crop(const std::optional<Rect>& crop, const Camera& camera) {
    const int width = int(camera.resolution[0]), height = int(camera.resolution[1]);
    const Rect r = crop.value_or(Rect{0, 0, width, height});
    if (r.x0 < 0 || r.y0 < 0 || r.x1 > width || r.y1 > height || r.x0 >= r.x1 || r.y0 >= r.y1) {
        throw InputError(
            "--crop", fmt::format("{},{},{},{} is no part of the frame of {} x {} pixels; give X0,Y0,X1,Y1 with 0 <= X0 < X1 <= {} "
                                  "and 0 <= Y0 < Y1 <= {}",
                                  r.x0, r.y0, r.x1, r.y1, width, height, width, height));
    }
    return r;
}

}  // namespace

Rendering render(const Display& display, const Geometry& geometry, const Texels& panel, const RenderOptions& options, Job& job) {
    if (panel.columns() != display.panel.pixels[0] || panel.rows() != display.panel.pixels[1]) {
        throw InputError("panel image", fmt::format("{} x {} pixels; the panel has {} x {}", panel.columns(), panel.rows(),
                                                    display.panel.pixels[0], display.panel.pixels[1]));
    }
    if (options.threads < 0 || options.threads > kMostThreads) {
        throw InputError("--threads", fmt::format("{}; allowed: 1 to {}, or 0 for all", options.threads, kMostThreads));
    }
    const Rect crop = checked_crop(options.crop, display.camera);
    const KernelEntry& kernel = choose_kernel(options.kernel);
    const optics::Scene<float> scene = make_scene<float>(display, geometry);
    const optics::View view = make_view(display, geometry);
    const int dimensions = sample_dimensions(display);

    Rendering result;
    result.kernel = kernel.name;
    result.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    result.image = Image(crop.x1 - crop.x0, crop.y1 - crop.y0);
    const std::uint32_t samples = dimensions > 0 ? std::uint32_t(display.render.samples) : 1;
    const std::int64_t pixels = std::int64_t(result.image.width) * result.image.height;
    job.stage("rendering", pixels);

    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::int64_t> done{0};
    // TBB keeps to the number of processors unless told otherwise; a request for more is the user's to make.
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                      std::size_t(std::max(result.threads, tbb::info::default_concurrency())));
    tbb::task_arena arena(result.threads);
    arena.execute([&] {
        // Tiles lie in a grid of the whole frame, so that none cuts through a packet's block except at the crop's border.
        const tbb::blocked_range2d<int> tiles(crop.y0 / kTileHeight, (crop.y1 - 1) / kTileHeight + 1, 1, crop.x0 / kTileWidth,
                                              (crop.x1 - 1) / kTileWidth + 1, 1);
        tbb::parallel_for(
            tiles,
            [&](const tbb::blocked_range2d<int>& r) {
                if (job.cancelled()) return;
                const int x0 = std::max(r.cols().begin() * kTileWidth, crop.x0),
                          x1 = std::min(r.cols().end() * kTileWidth, crop.x1);
                const int y0 = std::max(r.rows().begin() * kTileHeight, crop.y0),
                          y1 = std::min(r.rows().end() * kTileHeight, crop.y1);
                kernel.run({&scene, &view, &sobol_directions(), panel.data(), result.image.rgb.data(), crop.x0, crop.y0,
                            result.image.width, x0, y0, x1, y1, samples, display.render.sampling, dimensions});
                const std::int64_t part = std::int64_t(x1 - x0) * (y1 - y0);
                done += part;
                job.advance(part);
            },
            tbb::simple_partitioner());
    });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.complete = done == pixels;
    result.samples = done * samples;
    return result;
}

}  // namespace lfdsim
