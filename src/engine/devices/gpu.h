// Rendering on the GPUs that this process uses. Floor 2.
#pragma once
#include "base/job.h"
#include "engine/cuda/cuda.h"
#include "engine/devices/devices.h"
#include "engine/devices/kernel.h"
#include "engine/estimator/summed_panel.h"
#include "engine/scene/work.h"
#include "engine/views/compare_view.h"
#include "engine/wide/likeness.h"
#include "engine/wide/render.h"

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// Returns the result of the first cuda::find(), which takes a while.
const cuda::GpuSearch& found_gpus();

/// Returns why the CPU has done GPUs' work in this process so far: the first reason for each GPU, with its name; empty: it has not.
std::vector<std::string> gpus_given_up();

/// What a GPU has done for a picture.
struct GpuRun {
    std::string name;  // of the GPU, as in "cuda:0, NVIDIA H100"
    double seconds;    // by the GPU's clock
    Done done;
};

/// Renders a display whose estimator is `point` on the chosen GPU; the panel stays there as long as the `SummedPanel` exists,
/// where one is given. Returns nothing if the GPU failed or the picture does not fit, and the CPU is to render it. If the user
/// insists on the GPU: throws InputError where it does not fit, DeviceError where the GPU failed. May be called by several
/// threads.
std::optional<GpuRun> render_on_gpu(const ChosenDevice&, const SummedPanel* summed, const std::vector<optics::SummedImage>&, Work&,
                                    Job&);

/// A picture that was rendered and compared with a photograph on a GPU.
struct GpuComparison {
    GpuRun run;
    Likeness likeness;  // where the run is complete
};
/// Renders on the GPU and compares the picture there, times `gain`, with what is expected; the picture is not transferred. The work
/// has no target error. Returns nothing, and throws, as render_on_gpu().
std::optional<GpuComparison> compare_on_gpu(const ChosenDevice&, const SummedPanel&, const std::vector<optics::SummedImage>&,
                                            const Expected&, float gain, const Work&, Job&);

/// The copies of a panel or a photograph that GPUs hold, by the GPU's number. The mutex is held while `copies` is used.
template <class Copy>
struct GpuCopies {
    std::mutex mutex;
    std::map<int, Copy> copies;
};
class GpuPanels : public GpuCopies<wide::DevicePanel> {};
class GpuPhotographs : public GpuCopies<wide::Photograph> {};

}  // namespace lfdsim
