// Compares a view in a wide machine's memory with a photograph there, with the same bits as on the CPU. Floor 2.
#pragma once
#include "engine/wide/queue.h"
#include "image/image.h"
#include "image/likeness.h"

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

/// Bytes that likeness() needs.
std::size_t likeness_bytes(int width, int height);

/// As image/likeness.h. `view`: light in the machine's memory, 3 floats a pixel, of the photograph's size. Throws DeviceError.
Likeness likeness(Queue&, const float* view, float gain, const Photograph&, const Region& screen, const Region& content);

}  // namespace lfdsim::wide
