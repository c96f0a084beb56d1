#include "engine/render.h"

#include "engine/devices.h"
#include "engine/even_parts.h"
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

/// What `run` does and how long it takes are added to the work's result.
template <class Run>
bool timed(Work& work, const RenderOptions& options, const Run& run) {
    work.make_pictures(options.target_error.has_value());
    Rendering& result = work.result;
    const auto start = std::chrono::steady_clock::now();
    const std::optional<Done> done = run(result);
    if (!done) return false;
    result.samples = done->samples;
    result.complete = done->complete;
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return true;
}

/// With the kernel. The job's stage is the caller's.
Rendering render(Work& work, const char* kernel_name, Kernel kernel, const RenderOptions& options, Job& job) {
    timed(work, options, [&](Rendering& result) -> std::optional<Done> {
        result.kernel = kernel_name;
        result.threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
        return render_on_cpu(kernel, result.threads, work, job);
    });
    return std::move(work.result);
}

/// By points on the GPU; nothing where the CPU is to render it. The job's stage is the caller's.
std::optional<Rendering> render_points_on_gpu(Work& work, const ChosenDevice& device, const SummedPanel* summed,
                                              const std::vector<optics::SummedImage>& planes, const RenderOptions& options,
                                              Job& job) {
    const bool rendered = timed(work, options, [&](Rendering& result) -> std::optional<Done> {
        const std::optional<GpuRun> run = render_on_gpu(device, summed, planes, work, job);
        if (!run) return {};
        result.device = result.kernel = run->name;
        result.gpu_seconds = run->seconds;
        return run->done;
    });
    if (!rendered) return {};
    return std::move(work.result);
}

void begin_stage(const Work& work, std::size_t pictures, Job& job) {
    job.stage("rendering", std::int64_t(work.tile.x1 - work.tile.x0) * (work.tile.y1 - work.tile.y0) * std::int64_t(pictures));
}

/// A weighted sum of pictures.
class Sum {
  public:
    /// Adds to one channel, or to all of them.
    void add(Rendering&& one, float weight, std::optional<std::size_t> channel = {}) {
        if (sum_.image.rgb.empty()) {
            sum_.image = Image(one.image.width, one.image.height);
            if (!one.error.rgb.empty()) sum_.error = Image(one.image.width, one.image.height);
            sum_.device = one.device;
            sum_.kernel = one.kernel;
            sum_.threads = one.threads;
            sum_.estimator = one.estimator;
        }
        const std::size_t first = channel.value_or(0), step = channel ? 3 : 1;
        for (std::size_t k = first; k < sum_.image.rgb.size(); k += step) sum_.image.rgb[k] += weight * one.image.rgb[k];
        for (std::size_t k = first; k < sum_.error.rgb.size(); k += step)
            sum_.error.rgb[k] = std::hypot(sum_.error.rgb[k], weight * one.error.rgb[k]);
        sum_.complete = sum_.complete && one.complete;
        sum_.samples += one.samples;
        sum_.seconds += one.seconds;
        sum_.gpu_seconds += one.gpu_seconds;
    }
    bool complete() const { return sum_.complete; }
    Rendering take() { return std::move(sum_); }
    /// What is there so far, as bright as the whole will be.
    Rendering take_unfinished(float weight) {
        for (float& light : sum_.image.rgb) light /= weight;
        for (float& error : sum_.error.rgb) error /= weight;
        sum_.complete = false;
        return take();
    }

  private:
    Rendering sum_;
};

Rendering render(const Display& display, const Geometry& geometry, const std::vector<optics::SummedImage>& planes,
                 const SummedPanel* summed, const RenderOptions& options, Job& job) {
    const KernelEntry& kernel = choose_kernel(options.kernel);
    ChosenDevice device = choose_device(options.device, options.kernel);
    if (device.gpu && estimator_of(display) == Estimator::lens_by_lens) {
        if (device.insists) throw InputError("--device", "the estimator lens_by_lens runs on the CPU; give --device cpu");
        device.gpu.reset();
    }
    const std::vector<EvenPart> parts = even_parts(display, options.target_error.has_value());
    const auto at_wavelength = [&](const Geometry& there) {
        if (device.gpu) {
            Work work(by_points(display), there, planes, options);
            begin_stage(work, 1, job);
            if (auto one = render_points_on_gpu(work, device, summed, planes, options, job)) return *std::move(one);
            device.gpu.reset();
        }
        Sum sum;
        float weight = 0;
        for (const EvenPart& part : parts) {
            Work work(part.display, there, planes, options);
            if (&part == &parts.front()) begin_stage(work, parts.size(), job);
            Rendering one = render(work, kernel.name, kernel.run, options, job);
            if (parts.size() == 1) return one;
            if (!one.complete) return weight > 0 ? sum.take_unfinished(weight) : std::move(one);
            sum.add(std::move(one), part.weight);
            weight += part.weight;
        }
        return sum.take();
    };
    if (!disperses(display)) return at_wavelength(geometry);
    // Each channel is a picture of the display as it is at its wavelengths.
    Sum sum;
    for (std::size_t channel = 0; channel < 3 && sum.complete(); ++channel)
        for (const Node& node : wavelengths_of(display, int(channel)))
            if (sum.complete()) sum.add(at_wavelength(resolve(display, node.wavelength_nm)), float(node.weight), channel);
    return sum.take();
}

}  // namespace

Rendering render_with(const Tracer& tracer, const Display& display, const Geometry& geometry,
                      const std::vector<optics::SummedImage>& planes, const RenderOptions& options, Job& job) {
    check_threads(options);
    Work work(display, geometry, planes, options);
    work.tile.scene = &tracer.scene;
    begin_stage(work, 1, job);
    return render(work, tracer.name, tracer.run, options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const SummedPanel& panel, const RenderOptions& options,
                 Job& job) {
    check_threads(options);
    return render(display, geometry, panel.planes(panel_reading(display)), &panel, options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const Texels& panel, const RenderOptions& options, Job& job) {
    check_threads(options);
    const auto start = std::chrono::steady_clock::now();
    const SummedPanel summed(panel, options.threads);
    const std::vector<optics::SummedImage>& planes = summed.planes(panel_reading(display));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Rendering result = render(display, geometry, planes, nullptr, options, job);
    if (planes[0].sums) result.prepare_seconds = seconds;
    return result;
}

}  // namespace lfdsim
