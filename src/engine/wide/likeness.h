// Compares a view in a wide machine's memory with a photograph there, with the same bits as on the CPU. Floor 2.
#pragma once
#include "engine/wide/queue.h"
#include "image/compare/likeness.h"
#include "image/image.h"

namespace lfdsim::wide {

/// A photograph's lumas in a machine's memory.
struct Photograph {
    /// Waits until it is there. Throws DeviceError.
    Photograph(Queue&, const Image&);
    static std::size_t bytes(const Image&);  // while it is made

    int width, height;
    Buffer<SrgbLine> srgb;      // for its own codes, and those of the views that are compared with it
    Buffer<float> code, light;  // of sRGB codes, of light; height x width each
};

/// Compares a view with a photograph as image/compare/likeness.h does. To be made before the view is rendered: it waits for all
/// earlier work. Both functions throw DeviceError.
class ViewComparison {
  public:
    ViewComparison(Queue&, const Photograph&, const Region& screen, const Region& content);
    static std::size_t bytes(int width, int height);

    /// `view`: light in the machine's memory, 3 floats a pixel, of the photograph's size.
    Likeness with(const float* view, float gain);

  private:
    Queue& queue_;
    std::int64_t windows_[likeness_regions], on_screen_;
    Buffer<Region::Row> columns_;
    Buffer<float> view_code_;
    Buffer<double> moments_, values_, parts_, sums_;
    LikenessFrame frame_{};
};

}  // namespace lfdsim::wide
