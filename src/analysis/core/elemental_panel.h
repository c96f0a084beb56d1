// A panel image together with its summed-area tables. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "engine/estimator/summed_panel.h"

#include <memory>

namespace lfdsim {

/// A panel image and its tables, which refer to it.
class ShownPanel {
  public:
    ShownPanel(Texels, int threads);
    const SummedPanel& summed() const { return summed_; }

  private:
    Texels texels_;
    SummedPanel summed_;
};

/// Returns the elemental images of a scene as the display's panel shows them, decoded to linear light. Throws Stopped if the job
/// is cancelled.
std::unique_ptr<ShownPanel> elemental_panel(const Display&, const Geometry&, const ContentScene&, int threads, const Job&);

}  // namespace lfdsim
