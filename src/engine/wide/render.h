// A picture by a wide machine: the same bits as by the CPU's kernels. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/wide/queue.h"
#include "model/job.h"

#include <optional>
#include <vector>

namespace lfdsim::wide {

/// The panel's levels in a machine's memory.
class DevicePanel {
  public:
    /// Throws DeviceError.
    DevicePanel(Queue&, const std::vector<optics::PanelLevel>&);

    const optics::PanelLevel* levels() const { return levels_.get(); }
    const float* texels() const { return texels_; }
    static std::size_t bytes(const std::vector<optics::PanelLevel>&);

  private:
    std::vector<Buffer<float>> each_;
    Buffer<optics::PanelLevel> levels_;
    const float* texels_;
};

/// Bytes that a picture takes beside the panel, at least.
std::size_t picture_bytes(const Queue&, const Tile&);

/// Renders the tile to `out`, light of 3 floats a pixel in the machine's memory, black where it was cancelled before. Throws
/// DeviceError.
Done render_there(Queue&, const DevicePanel&, const Tile&, float* out, Job&);

/// Renders the tile, whose memory is the caller's but for the panel. `target_error` with `error`: as refine_tile. Throws
/// DeviceError.
Done render(Queue&, const DevicePanel&, const Tile&, std::optional<double> target_error, float* error, Job&);

}  // namespace lfdsim::wide
