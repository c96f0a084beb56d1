// Views that are compared with photographs where they are rendered: on a GPU they never leave it. Floor 2.
#pragma once
#include "engine/estimator/summed_panel.h"
#include "engine/render.h"
#include "image/compare/likeness.h"

#include <memory>

namespace lfdsim {

class GpuPhotographs;  // gpu.h

/// The reference of a view: a photograph of the scene, and the regions in which they are compared, counted from its corner.
class Expected {
  public:
    Expected(Image photograph, Region screen, Region content);

    const Image& photograph() const { return photograph_; }
    /// Returns the copies of the photograph that GPUs hold, made at first use.
    GpuPhotographs& on_gpus() const { return *on_gpus_; }

    const Region screen, content;

  private:
    Image photograph_;
    std::shared_ptr<GpuPhotographs> on_gpus_;
};

/// The result of compare_view().
struct ComparedView {
    Likeness likeness{};
    bool complete = true;    // false: cancelled, and no likeness
    double seconds = 0;      // of rendering and comparing
    double gpu_seconds = 0;  // of the GPU alone, by its clock
};

/// Renders a view, multiplies its light by `gain`, and measures its likeness to what is expected (image/compare/likeness.h), with
/// the same bits on every device. Throws what render() throws; InputError unless the photograph has the crop's size;
/// std::invalid_argument for a target error, which would take too long for many views.
ComparedView compare_view(const Display&, const Geometry&, const SummedPanel& panel, const Expected&, float gain,
                          const RenderOptions&, Job&);

}  // namespace lfdsim
