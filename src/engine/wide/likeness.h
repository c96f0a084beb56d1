// Compares a view in a wide machine's memory with a photograph there, with the same bits as on the CPU. Floor 2.
#pragma once
#include "engine/wide/queue.h"
#include "image/compare/likeness.h"
#include "image/image.h"

namespace lfdsim::wide {

/// A photograph's lumas in a machine's memory.
struct Photograph {
    /// Waits until they are there. Throws DeviceError.
    Photograph(Queue&, const Image&);
    /// Returns the bytes that it takes while it is made.
    static std::size_t bytes(const Image&);

    int width, height;
    Buffer<SrgbLine> srgb;      // for its codes, and those of the views that are compared with it
    Buffer<float> code, light;  // of sRGB codes, of light; height x width each
};

/// Compares a view with a photograph as image/compare/likeness.h does. To be made before the view is rendered: it waits for all
/// earlier work. Both functions throw DeviceError.
class ViewComparison {
  public:
    ViewComparison(Queue&, const Photograph&, const Region& screen, const Region& content);
    /// Returns the bytes that a comparison of pictures of this size takes.
    static std::size_t bytes(int width, int height);

    /// Returns the likeness of a view, whose light is multiplied by `gain`. `view`: light in the machine's memory, 3 floats a
    /// pixel, of the photograph's size.
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
