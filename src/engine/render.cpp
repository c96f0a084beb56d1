#include "engine/render.h"

#include "engine/devices.h"
#include "engine/gpu.h"
#include "engine/refine.h"
#include "engine/scene.h"
#include "engine/tracer.h"
#include "engine/work.h"
#include "model/colour.h"

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
namespace lfdsim {

namespace {

constexpr int tile_width = 64, tile_height = 16;  // neighbouring pixels see nearby panel pixels: a tile's texels stay in the cache
constexpr int most_threads = 1024;

/// Tile by tile, on all threads.
Done render_on_cpu(Kernel kernel, int threads, Work& work, Job& job) {
    const Tile& whole = work.tile;
    std::atomic<std::int64_t> taken{0};
    std::atomic<bool> complete{true};
    // TBB uses at most as many threads as there are processors unless set otherwise; the user may ask for more.
    const tbb::global_control workers(tbb::global_control::max_allowed_parallelism,
                                      std::size_t(std::max(threads, tbb::info::default_concurrency())));
    tbb::task_arena arena(threads);
    arena.execute([&] {
        // Tiles lie on a grid of the whole frame, so that none cuts through a packet's block except at the crop's border.
        const tbb::blocked_range2d<int> tiles(whole.y0 / tile_height, (whole.y1 - 1) / tile_height + 1, 1, whole.x0 / tile_width,
                                              (whole.x1 - 1) / tile_width + 1, 1);
        tbb::parallel_for(
            tiles,
            [&](const tbb::blocked_range2d<int>& r) {
                if (job.cancelled()) {
                    complete = false;
                    return;
                }
                Tile tile = whole;
                tile.x0 = std::max(r.cols().begin() * tile_width, whole.x0);
                tile.x1 = std::min(r.cols().end() * tile_width, whole.x1);
                tile.y0 = std::max(r.rows().begin() * tile_height, whole.y0);
                tile.y1 = std::min(r.rows().end() * tile_height, whole.y1);
                const std::int64_t part = std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0);
                if (work.target_error) {
                    const auto samples_taken = refine_tile(kernel, tile, *work.target_error, work.result.error.rgb.data(), job);
                    if (!samples_taken) {
                        complete = false;
                        return;
                    }
                    taken += *samples_taken;
                } else {
                    kernel(tile);
                    taken += part * (tile.strata > 0 ? tile.strata * tile.strata : std::int64_t(tile.samples));
                }
                job.advance(part);
            },
            tbb::simple_partitioner());
    });
    return {taken, complete};
}

void check_threads(const RenderOptions& options) {
    if (options.threads < 0 || options.threads > most_threads)
        throw InputError("--threads", fmt::format("{}; allowed: 1 to {}, or 0 for all", options.threads, most_threads));
}

/// On the GPU if one is chosen, else with the kernel.
Rendering render(Work& work, const char* kernel_name, Kernel kernel, const ChosenDevice& device, const Pyramid* pyramid,
                 const std::vector<optics::PanelLevel>& levels, const RenderOptions& options, Job& job) {
    work.make_pictures(options.target_error.has_value());
    Rendering& result = work.result;
    job.stage("rendering", std::int64_t(result.image.width) * result.image.height);
    const auto start = std::chrono::steady_clock::now();
    std::optional<GpuRun> run;
    if (device.gpu) run = render_on_gpu(device, pyramid, levels, work, job);
    Done done;
    if (run) {
        result.device = result.kernel = run->name;
        result.gpu_seconds = run->seconds;
        done = run->done;
    } else {
        result.kernel = kernel_name;
        result.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
        done = render_on_cpu(kernel, result.threads, work, job);
    }
    result.samples = done.samples;
    result.complete = done.complete;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result);
}

/// Adds weight x one channel of a picture at one wavelength.
void add_channel(const Rendering& of, std::size_t channel, float weight, Rendering& to) {
    for (std::size_t k = channel; k < to.image.rgb.size(); k += 3) to.image.rgb[k] += weight * of.image.rgb[k];
    for (std::size_t k = channel; k < to.error.rgb.size(); k += 3)
        to.error.rgb[k] = std::hypot(to.error.rgb[k], weight * of.error.rgb[k]);
    to.complete = to.complete && of.complete;
    to.samples += of.samples;
    to.seconds += of.seconds;
    to.gpu_seconds += of.gpu_seconds;
}

Rendering render(const Display& display, const Geometry& geometry, const std::vector<optics::PanelLevel>& levels,
                 const Pyramid* pyramid, const RenderOptions& options, Job& job) {
    const KernelEntry& kernel = choose_kernel(options.kernel);
    const ChosenDevice device = choose_device(options.device, options.kernel);
    const auto at_once = [&](const Geometry& at_wavelength) {
        Work work(display, at_wavelength, levels, options);
        return render(work, kernel.name, kernel.run, device, pyramid, levels, options, job);
    };
    if (!disperses(display)) return at_once(geometry);
    // Each channel is a picture of the display as it is at its wavelengths.
    Rendering result;
    for (int channel = 0; channel < 3; ++channel) {
        for (const Node& node : wavelengths_of(display, channel)) {
            Rendering one = at_once(resolve(display, node.wavelength_nm));
            if (result.image.rgb.empty()) {
                result = one;
                result.samples = 0;
                result.seconds = result.gpu_seconds = 0;
                std::fill(result.image.rgb.begin(), result.image.rgb.end(), 0.f);
                std::fill(result.error.rgb.begin(), result.error.rgb.end(), 0.f);
            }
            add_channel(one, std::size_t(channel), float(node.weight), result);
            if (!result.complete) return result;
        }
    }
    return result;
}

}  // namespace

Rendering render_with(const Tracer& tracer, const Display& display, const Geometry& geometry,
                      const std::vector<optics::PanelLevel>& levels, const RenderOptions& options, Job& job) {
    check_threads(options);
    Work work(display, geometry, levels, options);
    work.tile.scene = &tracer.scene;
    return render(work, tracer.name, tracer.run, {}, nullptr, levels, options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const Pyramid& panel, const RenderOptions& options, Job& job) {
    check_threads(options);
    return render(display, geometry, panel.levels(panel_reading(display, geometry)), &panel, options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const Texels& panel, const RenderOptions& options, Job& job) {
    check_threads(options);
    const auto start = std::chrono::steady_clock::now();
    const Pyramid pyramid(panel, options.threads);
    const std::vector<optics::PanelLevel>& levels = pyramid.levels(panel_reading(display, geometry));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Rendering result = render(display, geometry, levels, nullptr, options, job);
    if (levels.size() > 1) result.prepare_seconds = seconds;
    return result;
}

}  // namespace lfdsim
