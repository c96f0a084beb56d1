#include "engine/gpu.h"

#include "model/error.h"

#include <fmt/format.h>
#include <atomic>
#include <condition_variable>
#include <mutex>

namespace lfdsim {

namespace {

// A GPU works for so many pictures at a time: while one is fetched the other is computed.
constexpr int kAtOnce = 2;

struct GpuInUse {
    std::mutex mutex;
    std::condition_variable given_back;
    std::vector<std::unique_ptr<wide::Queue>> idle;
    int open = 0;
    std::atomic<bool> failed = false;
};

// Never destroyed: panels may outlive what main() leaves behind, and the driver frees all.
GpuInUse& gpu_in_use(int number) {
    static std::mutex mutex;
    static auto& all = *new std::map<int, GpuInUse>;
    const std::lock_guard lock(mutex);
    return all[number];
}

// A queue of the GPU, given back at the end.
class Loan {
  public:
    Loan(GpuInUse& gpu, int number) : gpu_(gpu) {
        std::unique_lock lock(gpu.mutex);
        gpu.given_back.wait(lock, [&] { return !gpu.idle.empty() || gpu.open < kAtOnce; });
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

constexpr const char* kRemedy = "; take --device cpu, another GPU, a smaller camera.resolution or --crop";

GpuRun run(wide::Queue& queue, const Pyramid* pyramid, int number, const std::vector<optics::PanelLevel>& levels, Work& work,
           Job& job) {
    GpuPanels own, &panels = pyramid ? pyramid->on_gpus() : own;
    const wide::Panel* panel = nullptr;
    {
        const std::lock_guard lock(panels.mutex);
        auto kept = panels.panels.find(number);
        const std::size_t needed = (kept == panels.panels.end() ? wide::Panel::bytes(levels) : 0) +
                                   wide::picture_bytes(queue, work.tile),
                          free = queue.free_bytes();
        if (needed > free)
            throw InputError("--device", fmt::format("{}: panel and picture need {} MB, of which {} MB are free{}", queue.name(),
                                                     needed >> 20, free >> 20, kRemedy));
        if (kept == panels.panels.end()) kept = panels.panels.emplace(number, wide::Panel(queue, levels)).first;
        panel = &kept->second;
    }
    const double before = queue.seconds();
    const Done done = wide::render(queue, *panel, work.tile, work.target_error, work.result.error.rgb.data(), job);
    return {queue.name(), queue.seconds() - before, done};
}

}  // namespace

const cuda::Found& found_gpus() {
    static const cuda::Found found = cuda::find();
    return found;
}

std::optional<GpuRun> render_on_gpu(const ChosenDevice& device, const Pyramid* pyramid,
                                    const std::vector<optics::PanelLevel>& levels, Work& work, Job& job) {
    GpuInUse& gpu = gpu_in_use(*device.gpu);
    if (gpu.failed && !device.insists) return {};
    try {
        Loan loan(gpu, *device.gpu);
        return run(loan.queue(), pyramid, *device.gpu, levels, work, job);
    } catch (const InputError&) {
        if (device.insists) throw;
    } catch (const wide::DeviceError&) {
        gpu.failed = true;
        if (device.insists) throw;
    }
    return {};
}

}  // namespace lfdsim
