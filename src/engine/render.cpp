#include "engine/render.h"

#include "engine/devices.h"
#include "engine/refine.h"
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

namespace {

Rendering render(const Display& display, const Geometry& geometry, const std::vector<optics::PanelLevel>& levels,
                 const RenderOptions& options, Job& job) {
    if (levels[0].columns != display.panel.pixels[0] || levels[0].rows != display.panel.pixels[1]) {
        throw InputError("panel image", fmt::format("{} x {} pixels; the panel has {} x {}", levels[0].columns, levels[0].rows,
                                                    display.panel.pixels[0], display.panel.pixels[1]));
    }
    if (options.target_error && !(*options.target_error > 0 && std::isfinite(*options.target_error)))
        throw InputError("--target-error", fmt::format("{}; allowed: more than 0", *options.target_error));
    const Rect crop = checked_crop(options.crop, display.camera);
    const KernelEntry& kernel = choose_kernel(options.kernel);
    const optics::Scene<float> scene = make_scene<float>(display, geometry);
    const optics::View view = make_view(display, geometry);
    const int dimensions = sample_dimensions(display);
    const std::int64_t samples = samples_of(display);

    Rendering result;
    result.kernel = kernel.name;
    result.estimator = estimator_of(display);
    const bool filtered = result.estimator == Estimator::filtered;
    const int strata = filtered ? int(std::lround(std::sqrt(double(samples)))) : 0;
    constexpr std::int64_t most = (kMostStrata - 2) * (kMostStrata - 2);
    if (filtered && samples > most)
        throw InputError("render.samples",
                         fmt::format("{}; at most {} filtered samples, or use the estimator \"point\"", samples, most));
    result.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
    result.image = Image(crop.x1 - crop.x0, crop.y1 - crop.y0);
    const bool refined = options.target_error && dimensions > 0;
    if (options.target_error) result.error = Image(result.image.width, result.image.height);
    const std::int64_t pixels = std::int64_t(result.image.width) * result.image.height;
    job.stage("rendering", pixels);

    const Tile whole{&scene,
                     &view,
                     &sobol_directions(),
                     levels[0].texels,
                     levels.data(),
                     int(levels.size()),
                     result.image.rgb.data(),
                     crop.x0,
                     crop.y0,
                     result.image.width,
                     crop.x0,
                     crop.y0,
                     crop.x1,
                     crop.y1,
                     std::uint32_t(samples),
                     strata,
                     block_side(scene, view, refined ? 2 * kFewStrata : strata, options.rough),
                     display.render.sampling,
                     dimensions};
    const auto start = std::chrono::steady_clock::now();
    std::atomic<std::int64_t> done{0}, taken{0};
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
                Tile tile = whole;
                tile.x0 = std::max(r.cols().begin() * kTileWidth, crop.x0);
                tile.x1 = std::min(r.cols().end() * kTileWidth, crop.x1);
                tile.y0 = std::max(r.rows().begin() * kTileHeight, crop.y0);
                tile.y1 = std::min(r.rows().end() * kTileHeight, crop.y1);
                const std::int64_t part = std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0);
                if (refined) {
                    const auto samples_taken = refine_tile(kernel.run, tile, *options.target_error, result.error.rgb.data(), job);
                    if (!samples_taken) return;
                    taken += *samples_taken;
                } else {
                    kernel.run(tile);
                    taken += part * samples;
                }
                done += part;
                job.advance(part);
            },
            tbb::simple_partitioner());
    });
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.complete = done == pixels;
    result.samples = taken;
    return result;
}

void check_threads(const RenderOptions& options) {
    if (options.threads < 0 || options.threads > kMostThreads)
        throw InputError("--threads", fmt::format("{}; allowed: 1 to {}, or 0 for all", options.threads, kMostThreads));
}

}  // namespace

Rendering render(const Display& display, const Geometry& geometry, const Pyramid& panel, const RenderOptions& options, Job& job) {
    check_threads(options);
    return render(display, geometry, panel.levels(), options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const Texels& panel, const RenderOptions& options, Job& job) {
    check_threads(options);
    const optics::PanelLevel level{panel.data(), std::uint32_t(panel.columns()), std::uint32_t(panel.rows())};
    if (estimator_of(display) == Estimator::point) return render(display, geometry, std::vector{level}, options, job);
    const auto start = std::chrono::steady_clock::now();
    const Pyramid pyramid(panel, options.threads);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Rendering result = render(display, geometry, pyramid.levels(), options, job);
    result.prepare_seconds = seconds;
    return result;
}

}  // namespace lfdsim
