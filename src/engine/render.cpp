#include "engine/render.h"

#include "engine/devices.h"
#include "engine/scene.h"

#include <tbb/blocked_range2d.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
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
    tbb::task_arena arena(result.threads);
    arena.execute([&] {
        const tbb::blocked_range2d<int> tiles(crop.y0, crop.y1, kTileHeight, crop.x0, crop.x1, kTileWidth);
        tbb::parallel_for(tiles, [&](const tbb::blocked_range2d<int>& r) {
            if (job.cancelled()) return;
            kernel.run({&scene, &view, &sobol_directions(), panel.data(), result.image.rgb.data(), crop.x0, crop.y0,
                        result.image.width, r.cols().begin(), r.rows().begin(), r.cols().end(), r.rows().end(), samples,
                        display.render.sampling, dimensions});
            const std::int64_t part = std::int64_t(r.rows().size()) * std::int64_t(r.cols().size());
            done += part;
            job.advance(part);
        });
    });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.complete = done == pixels;
    result.samples = done * samples;
    return result;
}

}  // namespace lfdsim
