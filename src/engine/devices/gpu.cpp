#include "engine/devices/gpu.h"

#include "base/input_error.h"
#include "engine/estimator/panel_planes.h"

#include <fmt/format.h>
#include <atomic>
#include <condition_variable>
#include <mutex>

namespace lfdsim {

namespace {

// Pictures that a GPU works on at a time: while one is fetched the other is computed.
constexpr int pictures_at_once = 2;

/// A GPU's queues: at most pictures_at_once, opened as they are needed and lent to one thread at a time.
struct GpuInUse {
    std::mutex mutex;  // of all members but `failed`
    std::condition_variable given_back;
    std::vector<std::unique_ptr<wide::Queue>> idle;
    int open = 0;                      // number of queues, idle and lent
    std::atomic<bool> failed = false;  // from then on the CPU does its work, unless the user insists
    std::string given_up;              // why the CPU first did its work; empty: it did not
};

/// The GPUs in use, by number. The object is never destroyed: panels may outlive static objects, and the driver frees everything.
struct GpusInUse {
    std::mutex mutex;
    std::map<int, GpuInUse> all;
};
GpusInUse& gpus_in_use() {
    static auto& gpus = *new GpusInUse;
    return gpus;
}

GpuInUse& gpu_in_use(int number) {
    GpusInUse& gpus = gpus_in_use();
    const std::lock_guard lock(gpus.mutex);
    return gpus.all[number];
}

/// A queue of the GPU, given back at the end. The constructor waits while all are lent.
class Loan {
  public:
    Loan(GpuInUse& gpu, int number) : gpu_(gpu) {
        std::unique_lock lock(gpu.mutex);
        gpu.given_back.wait(lock, [&] { return !gpu.idle.empty() || gpu.open < pictures_at_once; });
        if (gpu.idle.empty()) {
            queue_ = cuda::open(number);
            ++gpu.open;
        } else {
            queue_ = std::move(gpu.idle.back());
            gpu.idle.pop_back();
        }
    }
    ~Loan() {
        const std::lock_guard lock(gpu_.mutex);
        gpu_.idle.push_back(std::move(queue_));
        gpu_.given_back.notify_one();
    }
    wide::Queue& queue() { return *queue_; }

  private:
    GpuInUse& gpu_;
    std::unique_ptr<wide::Queue> queue_;
};

struct DoesNotFit : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Returns the copy on GPU `number`, which make() makes at the first call. The caller holds the copies' mutex.
template <class Copies, class Make>
auto& copy_on(Copies& copies, int number, Make make) {
    auto kept = copies.copies.find(number);
    if (kept == copies.copies.end()) kept = copies.copies.emplace(number, make()).first;
    return kept->second;
}

/// Returns the panel on GPU `number`. Throws DoesNotFit where it does not fit there together with `more` bytes.
const wide::DevicePanel& panel_on(wide::Queue& queue, int number, GpuPanels& panels, const std::vector<optics::SummedImage>& planes,
                                  std::size_t more) {
    const std::lock_guard lock(panels.mutex);
    const std::size_t needed = (panels.copies.contains(number) ? 0 : wide::DevicePanel::bytes(planes[0])) + more,
                      free = queue.free_bytes();
    if (needed > free)
        throw DoesNotFit(fmt::format("panel and picture need {} MB, but only {} MB are free", needed >> 20, free >> 20));
    return copy_on(panels, number, [&] { return wide::DevicePanel(queue, planes[0]); });
}

/// Returns do_it(queue), with a queue of the GPU; nothing where the GPU fails and the CPU is to do the work. Where the user insists
/// on the GPU, it throws instead.
template <class Do>
auto on_gpu(const ChosenDevice& device, Do do_it) -> std::optional<decltype(do_it(std::declval<wide::Queue&>()))> {
    GpuInUse& gpu = gpu_in_use(*device.gpu);
    if (gpu.failed && !device.insists) return {};
    const std::string name = fmt::format("cuda:{}, {}", *device.gpu, found_gpus().gpus[std::size_t(*device.gpu)].name);
    const auto give_up = [&](const std::exception& error) {
        const std::lock_guard lock(gpu.mutex);
        if (gpu.given_up.empty()) gpu.given_up = name + ": " + error.what();
    };
    try {
        Loan loan(gpu, *device.gpu);
        return do_it(loan.queue());
    } catch (const DoesNotFit& error) {
        if (device.insists)
            throw InputError("--device", fmt::format("{}: {}; use --device cpu, another GPU, a smaller camera.resolution or --crop",
                                                     name, error.what()));
        give_up(error);
    } catch (const wide::DeviceError& error) {
        gpu.failed = true;
        if (device.insists) throw;
        give_up(error);
    }
    return {};
}

}  // namespace

const cuda::GpuSearch& found_gpus() {
    static const cuda::GpuSearch found = cuda::find();
    return found;
}

std::vector<std::string> gpus_given_up() {
    std::vector<std::string> reasons;
    GpusInUse& gpus = gpus_in_use();
    const std::lock_guard lock(gpus.mutex);
    for (auto& [number, gpu] : gpus.all) {
        const std::lock_guard lock_gpu(gpu.mutex);
        if (!gpu.given_up.empty()) reasons.push_back(gpu.given_up);
    }
    return reasons;
}

std::optional<GpuRun> render_on_gpu(const ChosenDevice& device, const SummedPanel* summed,
                                    const std::vector<optics::SummedImage>& planes, Work& work, Job& job) {
    return on_gpu(device, [&](wide::Queue& queue) {
        GpuPanels own, &panels = summed ? gpu_panels_of(*summed, planes) : own;
        const wide::DevicePanel& panel = panel_on(queue, *device.gpu, panels, planes, wide::picture_bytes(work.tile));
        const double before = queue.seconds();
        const Done done = wide::render(queue, panel, work.tile, work.target_error, work.result.error.rgb.data(), job);
        return GpuRun{queue.name(), queue.seconds() - before, done};
    });
}

std::optional<GpuComparison> compare_on_gpu(const ChosenDevice& device, const SummedPanel& summed,
                                            const std::vector<optics::SummedImage>& planes, const Expected& expected, float gain,
                                            const Work& work, Job& job) {
    return on_gpu(device, [&](wide::Queue& queue) {
        const Image& image = expected.photograph();
        const double before = queue.seconds();
        const wide::Photograph* photograph = nullptr;
        const wide::DevicePanel* panel = nullptr;
        {
            GpuPhotographs& photographs = expected.on_gpus();
            const std::lock_guard lock(photographs.mutex);
            const std::size_t sent = photographs.copies.contains(*device.gpu) ? 0 : wide::Photograph::bytes(image);
            panel = &panel_on(queue, *device.gpu, gpu_panels_of(summed, planes), planes,
                              wide::picture_bytes(work.tile) + wide::ViewComparison::bytes(image.width, image.height) + sent);
            photograph = &copy_on(photographs, *device.gpu, [&] { return wide::Photograph(queue, image); });
        }
        wide::ViewComparison comparison(queue, *photograph, expected.screen, expected.content);
        const wide::Buffer<float> view(queue, image.rgb.size());
        const Done done = wide::render_there(queue, *panel, work.tile, view.get(), job);
        // The view is rendered where it is compared; only sums come back.
        GpuComparison result{{}, {}};
        if (done.complete) result.likeness = comparison.with(view.get(), gain);
        result.run = {queue.name(), queue.seconds() - before, done};
        return result;
    });
}

}  // namespace lfdsim
