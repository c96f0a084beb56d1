// Renders a picture by points on a wide machine, with the same bits as the CPU's kernels. Floor 2.
#pragma once
#include "base/job.h"
#include "engine/devices/kernel.h"
#include "engine/wide/queue.h"

#include <optional>

namespace lfdsim::wide {

/// The texels of a panel in a machine's memory.
class DevicePanel {
  public:
    /// Throws DeviceError.
    DevicePanel(Queue&, const optics::SummedImage& panel);

    const float* texels() const { return texels_.get(); }
    /// Returns the bytes that a panel takes.
    static std::size_t bytes(const optics::SummedImage& panel);

  private:
    Buffer<float> texels_;
};

/// Returns the bytes that a picture needs at least, in addition to the panel.
std::size_t picture_bytes(const Tile&);

/// Renders the tile by points to `out` in the machine's memory, 3 floats of linear light a pixel, black where it was not rendered
/// before the job was cancelled. Throws DeviceError.
Done render_there(Queue&, const DevicePanel&, const Tile&, float* out, Job&);

/// Renders the tile to tile.out, which is the caller's memory: with a target error by refine_tile(), which writes `error`, too.
/// Throws DeviceError.
Done render(Queue&, const DevicePanel&, const Tile&, std::optional<double> target_error, float* error, Job&);

}  // namespace lfdsim::wide
