// A panel that shows something, kept with its tables. Floor 3.
#pragma once
#include "analysis/core/subject.h"
#include "engine/estimator/summed_panel.h"

#include <memory>

namespace lfdsim {

/// A panel image with its tables.
class ShownPanel {
  public:
    ShownPanel(Texels, int threads);
    const SummedPanel& summed() const { return summed_; }

  private:
    Texels texels_;
    SummedPanel summed_;
};

/// The elemental images of a scene as the display's panel shows them. Throws Stopped.
std::unique_ptr<ShownPanel> elemental_panel(const Display&, const Geometry&, const ContentScene&, int threads, const Job&);

}  // namespace lfdsim
