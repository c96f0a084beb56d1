#include "engine/gpu.h"

#include "model/error.h"

#include <fmt/format.h>
#include <mutex>

namespace lfdsim {

namespace {

struct GpuInUse {
    std::mutex mutex;
    std::unique_ptr<wide::Queue> queue;
    bool failed = false;
};

// Never destroyed: panels may outlive what main() leaves behind, and the driver frees all.
GpuInUse& gpu_in_use(int number) {
    static std::mutex mutex;
    static auto& all = *new std::map<int, GpuInUse>;
    const std::lock_guard lock(mutex);
    return all[number];
}

constexpr const char* kRemedy = "; take --device cpu, another GPU, a smaller camera.resolution or --crop";

GpuRun run(wide::Queue& queue, const Pyramid* pyramid, int number, const std::vector<optics::PanelLevel>& levels, Work& work,
           Job& job) {
    const wide::Panel* panel = nullptr;
    if (pyramid) {
        const auto& kept = pyramid->on_gpus().panels;
        if (const auto it = kept.find(number); it != kept.end()) panel = &it->second;
    }
    const std::size_t needed = (panel ? 0 : wide::Panel::bytes(levels)) + wide::picture_bytes(queue, work.tile),
                      free = queue.free_bytes();
    if (needed > free)
        throw InputError("--device", fmt::format("{}: panel and picture need {} MB, of which {} MB are free{}", queue.name(),
                                                 needed >> 20, free >> 20, kRemedy));
    std::optional<wide::Panel> own;
    if (!panel && pyramid)
        panel = &pyramid->on_gpus().panels.emplace(number, wide::Panel(queue, levels)).first->second;
    else if (!panel)
        panel = &own.emplace(queue, levels);
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
    const std::lock_guard lock(gpu.mutex);
    if (gpu.failed && !device.insists) return {};
    try {
        if (!gpu.queue) gpu.queue = cuda::open(*device.gpu);
        return run(*gpu.queue, pyramid, *device.gpu, levels, work, job);
    } catch (const InputError&) {
        if (device.insists) throw;
    } catch (const wide::DeviceError&) {
        gpu.failed = true;
        if (device.insists) throw;
    }
    return {};
}

}  // namespace lfdsim
