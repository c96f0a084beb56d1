#include "engine/render.h"

#include "base/on_threads.h"
#include "base/seconds.h"
#include "display/colour.h"
#include "engine/devices/devices.h"
#include "engine/devices/gpu.h"
#include "engine/devices/threads.h"
#include "engine/estimator/choice.h"
#include "engine/estimator/gaussian_parts.h"
#include "engine/estimator/panel_planes.h"
#include "engine/estimator/refine.h"
#include "engine/scene/traced_display.h"
#include "engine/scene/tracer.h"
#include "engine/scene/work.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
namespace lfdsim {

namespace {

constexpr int tile_width = 64, tile_height = 16;  // neighbouring pixels see nearby panel pixels: a tile's texels stay in the cache

/// Calls paint(tile) for each tile of the crop, on all threads of the arena; it returns the samples that it took, or nothing where
/// it was stopped. Returns the sum of the samples.
template <class Paint>
Done for_tiles(const Tile& whole, Job& job, const Paint& paint) {
    std::atomic<std::int64_t> taken{0};
    std::atomic<bool> complete{true};
    // Tiles lie on a grid of the whole frame, so that none cuts through a packet's block except at the crop's border.
    const tbb::blocked_range2d<int> tiles(whole.y0 / tile_height, (whole.y1 - 1) / tile_height + 1, 1, whole.x0 / tile_width,
                                          (whole.x1 - 1) / tile_width + 1, 1);
    tbb::parallel_for(
        tiles,
        [&](const tbb::blocked_range2d<int>& r) {
            Tile tile = whole;
            tile.x0 = std::max(r.cols().begin() * tile_width, whole.x0);
            tile.x1 = std::min(r.cols().end() * tile_width, whole.x1);
            tile.y0 = std::max(r.rows().begin() * tile_height, whole.y0);
            tile.y1 = std::min(r.rows().end() * tile_height, whole.y1);
            const std::optional<std::int64_t> samples = job.cancelled() ? std::nullopt : paint(tile);
            if (!samples) {
                complete = false;
                return;
            }
            taken += *samples;
            job.advance(std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0));
        },
        tbb::simple_partitioner());
    return {taken, complete};
}

/// Renders by the estimator of the work's tile, or until the target error is reached.
Done render_on_cpu(Kernel kernel, int threads, Work& work, Job& job) {
    return on_threads(threads, [&] {
        return for_tiles(work.tile, job, [&](const Tile& tile) -> std::optional<std::int64_t> {
            if (work.target_error) return refine_tile(kernel, tile, *work.target_error, work.result.error.rgb.data(), job);
            if (!kernel(tile)) return {};
            return std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0) *
                   (tile.strata > 0 ? tile.strata * tile.strata : std::int64_t(tile.samples));
        });
    });
}

/// Renders each region of the frame by what is chosen for it (docs/model.md, "What a default picture is made of").
Done render_chosen(Kernel kernel, int threads, EstimatorChoice& choice, Job& job) {
    return on_threads(threads, [&]() -> Done {
        // The regions that the crop meets. A tile lies in one of them, as a region's side is a multiple of a tile's.
        Work& work = choice.work();
        const Tile& whole = work.tile;
        constexpr int side = EstimatorChoice::region_side;
        const int left = whole.x0 / side, top = whole.y0 / side, columns = (whole.x1 - 1) / side + 1 - left,
                  rows = (whole.y1 - 1) / side + 1 - top;
        std::vector<RegionChoice> chosen(std::size_t(columns) * std::size_t(rows));
        const auto region_of = [&](const Tile& tile) {
            return std::size_t((tile.y0 / side - top) * columns + tile.x0 / side - left);
        };
        // Each region's choice, then its tiles
        choice.look(kernel);
        tbb::parallel_for(0, columns * rows, [&](int k) {
            if (!job.cancelled()) chosen[std::size_t(k)] = choice.choose(kernel, left + k % columns, top + k / columns);
        });
        std::vector<std::atomic<std::int64_t>> pixels(chosen.size());
        Done done = for_tiles(whole, job, [&](const Tile& tile) -> std::optional<std::int64_t> {
            const RegionChoice& of = chosen[region_of(tile)];
            pixels[region_of(tile)] += std::int64_t(tile.x1 - tile.x0) * (tile.y1 - tile.y0);
            float* const error = work.result.error.rgb.data();
            if (of.filtered < 0 && of.points == 0) return refine_tile(kernel, tile, *work.target_error, error, job);
            if (work.target_error)
                for (std::int32_t y = tile.y0; y < tile.y1; ++y)
                    std::fill_n(error + (std::int64_t(y - tile.crop_y) * tile.crop_width + tile.x0 - tile.crop_x) * 3,
                                (tile.x1 - tile.x0) * 3, float(of.error));
            return choice.render(kernel, of, tile);
        });
        // The share by points, and the root mean square of the errors measured, of the crop's pixels
        double by_points = 0, squares = 0;
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            done.samples += chosen[k].samples;
            by_points += chosen[k].filtered < 0 ? double(pixels[k]) : 0;
            squares += double(pixels[k]) * chosen[k].error * chosen[k].error;
        }
        const double all = double(whole.x1 - whole.x0) * (whole.y1 - whole.y0);
        work.result.points_share = by_points / all;
        if (!work.target_error) work.result.measured_error = std::sqrt(squares / all);
        return done;
    });
}

void check_threads(const RenderOptions& options) {
    if (options.threads < 0 || options.threads > most_threads)
        throw InputError("--threads", fmt::format("{}; allowed: 1 to {}, or 0 for all", options.threads, most_threads));
}

/// Runs `run` and stores its samples and its time in the work's result; false: `run` returned nothing.
template <class Run>
bool timed(Work& work, const RenderOptions& options, const Run& run) {
    work.make_pictures(options.target_error.has_value());
    Rendering& result = work.result;
    const auto start = std::chrono::steady_clock::now();
    const std::optional<Done> done = run(result);
    if (!done) return false;
    result.samples = done->samples;
    result.complete = done->complete;
    result.seconds = seconds_since(start);
    return true;
}

/// Renders with the kernel. The job's stage is the caller's.
Rendering render(Work& work, const char* kernel_name, Kernel kernel, const RenderOptions& options, Job& job) {
    timed(work, options, [&](Rendering& result) -> std::optional<Done> {
        result.kernel = kernel_name;
        result.threads = threads_used(options.threads);
        return render_on_cpu(kernel, result.threads, work, job);
    });
    return std::move(work.result);
}

/// Renders by points on the GPU; returns nothing where the CPU is to render it. The job's stage is the caller's.
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

/// Renders each region by the estimator that a measurement chooses. The job's stage is the caller's.
Rendering render_chosen(EstimatorChoice& choice, const char* kernel_name, Kernel kernel, const RenderOptions& options, Job& job) {
    timed(choice.work(), options, [&](Rendering& result) -> std::optional<Done> {
        result.kernel = kernel_name;
        result.threads = threads_used(options.threads);
        return render_chosen(kernel, result.threads, choice, job);
    });
    return std::move(choice.work().result);
}

void begin_stage(const Work& work, std::size_t pictures, Job& job) {
    job.stage("rendering", std::int64_t(work.tile.x1 - work.tile.x0) * (work.tile.y1 - work.tile.y0) * std::int64_t(pictures));
}

/// A weighted sum of pictures. Errors are added by their squares, as those of independent pictures.
class Sum {
  public:
    /// Adds a picture to one channel, 0 .. 2, or to all of them.
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
        sum_.points_share = std::max(sum_.points_share, one.points_share);
        for (std::size_t k = first; k < sum_.image.rgb.size(); k += step) sum_.image.rgb[k] += weight * one.image.rgb[k];
        for (std::size_t k = first; k < sum_.error.rgb.size(); k += step)
            sum_.error.rgb[k] = sum_of_errors(sum_.error.rgb[k], weight * one.error.rgb[k], channel);
        if (one.measured_error) {
            for (std::size_t c = first; c < 3; c += step)
                measured_[c] = sum_of_errors(measured_[c], weight * *one.measured_error, channel);
            sum_.measured_error =
                std::sqrt((measured_[0] * measured_[0] + measured_[1] * measured_[1] + measured_[2] * measured_[2]) / 3);
        }
        sum_.complete = sum_.complete && one.complete;
        sum_.samples += one.samples;
        sum_.seconds += one.seconds;
        sum_.gpu_seconds += one.gpu_seconds;
    }
    bool complete() const { return sum_.complete; }
    Rendering take() { return std::move(sum_); }
    /// Returns the unfinished picture, scaled to the brightness of the whole; `weight` is the sum of the weights so far.
    Rendering take_unfinished(float weight) {
        for (float& light : sum_.image.rgb) light /= weight;
        for (float& error : sum_.error.rgb) error /= weight;
        sum_.complete = false;
        return take();
    }

  private:
    /// The wavelengths of a channel have the same random numbers, so that their errors add up. Other pictures have numbers of
    /// their own: their errors' squares do.
    template <class Number>
    static Number sum_of_errors(Number a, Number b, std::optional<std::size_t> channel) {
        return channel ? a + b : std::hypot(a, b);
    }

    Rendering sum_;
    std::array<double, 3> measured_{};  // error of each channel
};

/// Renders a display on the device that the options choose: a picture for each wavelength of each channel where it disperses, and
/// of each of these one for each box that a gaussian diffuser consists of. `summed`: the panel of the planes, if it outlives the
/// call, so that a GPU may keep it.
Rendering render(const Display& display, const Geometry& geometry, const std::vector<optics::SummedImage>& planes,
                 const SummedPanel* summed, const RenderOptions& options, Job& job) {
    const KernelEntry& kernel = choose_kernel(options.kernel);
    ChosenDevice device = choose_device(options.device, options.kernel);
    if (device.gpu && estimator_of(display) == Estimator::lens_by_lens) {
        if (device.insists) throw InputError("--device", "the estimator lens_by_lens runs on the CPU; give --device cpu");
        device.gpu.reset();
    }
    const std::vector<EvenPart> parts = even_parts(display);
    const auto at_wavelength = [&](const Geometry& there) {
        if (device.gpu) {
            Work work(by_points(display), there, planes, options, job);
            begin_stage(work, 1, job);
            if (auto one = render_points_on_gpu(work, device, summed, planes, options, job)) return *std::move(one);
            return render(work, kernel.name, kernel.run, options, job);  // by points, too: the same bits as on the GPU
        }
        if (estimator_of(display) == Estimator::filtered && !options.rough) {
            EstimatorChoice choice(display, there, planes, options, job);
            begin_stage(choice.work(), 1, job);
            return render_chosen(choice, kernel.name, kernel.run, options, job);
        }
        Sum sum;
        float weight = 0;
        for (const EvenPart& part : parts) {
            Work work(part.display, there, planes, options, job);
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
    // Each channel is the sum of pictures at its wavelengths (docs/model.md, "Colour").
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
    Work work(display, geometry, planes, options, job);
    work.tile.display = &tracer.scene;
    begin_stage(work, 1, job);
    return render(work, tracer.name, tracer.run, options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const SummedPanel& panel, const RenderOptions& options,
                 Job& job) {
    check_threads(options);
    return render(display, geometry, planes_of(panel, panel_reading(display)), &panel, options, job);
}

Rendering render(const Display& display, const Geometry& geometry, const Texels& panel, const RenderOptions& options, Job& job) {
    check_threads(options);
    const auto start = std::chrono::steady_clock::now();
    const SummedPanel summed(panel, options.threads);
    const std::vector<optics::SummedImage>& planes = planes_of(summed, panel_reading(display));
    const double seconds = seconds_since(start);
    Rendering result = render(display, geometry, planes, nullptr, options, job);
    if (planes[0].sums) result.prepare_seconds = seconds;
    return result;
}

}  // namespace lfdsim
