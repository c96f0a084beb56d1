// Rendering on the GPUs that this process uses. Floor 2.
#pragma once
#include "engine/compare_view.h"
#include "engine/cuda/cuda.h"
#include "engine/devices.h"
#include "engine/kernel.h"
#include "engine/pyramid.h"
#include "engine/wide/likeness.h"
#include "engine/wide/render.h"
#include "engine/work.h"
#include "model/job.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// What cuda::find() said when first asked: looking takes a while.
const cuda::Found& found_gpus();

/// Why the CPU did what was a GPU's so far, in this process: the first reason of each GPU, with its name. Empty: it did not.
std::vector<std::string> gpus_given_up();

struct GpuRun {
    std::string name;
    double seconds;  // by the GPU's clock
    Done done;
};

/// Renders on the chosen GPU; the panel stays there as long as `pyramid`, where one is given. Nothing: it failed or does not fit,
/// and the CPU shall do it. Throws InputError where it does not fit, DeviceError where it failed, if the user insists on the GPU.
/// May be called by several threads.
std::optional<GpuRun> render_on_gpu(const ChosenDevice&, const Pyramid* pyramid, const std::vector<optics::PanelLevel>&, Work&,
                                    Job&);

/// The same, but the picture is compared where it is made and goes no farther. The work's picture is not touched; it has no target
/// error.
struct GpuComparison {
    GpuRun run;
    Likeness likeness;  // where the run is complete
};
std::optional<GpuComparison> compare_on_gpu(const ChosenDevice&, const Pyramid&, const Expected&, float gain, const Work&, Job&);

/// Copies of something on GPUs, by number.
template <class Copy>
struct GpuCopies {
    std::mutex mutex;
    std::map<int, Copy> copies;
};
class GpuPanels : public GpuCopies<wide::DevicePanel> {};
class GpuPhotographs : public GpuCopies<wide::Photograph> {};

}  // namespace lfdsim
