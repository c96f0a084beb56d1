// A panel image prepared for several views of it. Floor 2, public.
#pragma once
#include "image/texels.h"

#include <memory>

namespace lfdsim {

/// A panel image and what is made of it at first use: a summed-area table for each plane. A table takes as much memory as the image
/// it sums, 16 bytes a pixel. The panel image must outlive this object, unchanged. It may be used by several threads.
class SummedPanel {
  public:
    /// Keeps a reference to the panel; tables are made at first use. `threads`: those that make them, 0: all.
    explicit SummedPanel(const Texels& panel, int threads = 0);
    ~SummedPanel();
    SummedPanel(SummedPanel&&) noexcept;
    SummedPanel& operator=(SummedPanel&&) noexcept;

    struct Parts;  // for the library alone: panel_planes.h
    Parts& parts() const { return *parts_; }

  private:
    std::unique_ptr<Parts> parts_;
};

}  // namespace lfdsim
