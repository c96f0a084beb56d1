// The panel as the renderer reads it: its image and, for the filtered estimator, the same at ever coarser resolution. Floor 2.
#pragma once
#include "image/texels.h"

#include <memory>
#include <vector>

namespace lfdsim {

class GpuPanels;  // gpu.h

namespace optics {
struct PanelLevel;  // optics/scene.h
}

/// Level 0 is the panel image. Level k + 1 has half the columns and rows of level k, rounded up; a cell is the mean of 2 x 2, black
/// outside the panel. Takes a third of the panel image's memory. The panel image must outlive it, unchanged.
class Pyramid {
  public:
    /// threads 0: all. Throws std::bad_alloc.
    explicit Pyramid(const Texels& panel, int threads = 0);
    ~Pyramid();
    Pyramid(Pyramid&&) noexcept;
    Pyramid& operator=(Pyramid&&) noexcept;

    const std::vector<optics::PanelLevel>& levels() const { return levels_; }

    /// The copies of it that GPUs hold, made at first use.
    GpuPanels& on_gpus() const { return *on_gpus_; }

  private:
    std::vector<Texels> coarse_;
    std::vector<optics::PanelLevel> levels_;
    std::shared_ptr<GpuPanels> on_gpus_;
};

}  // namespace lfdsim
