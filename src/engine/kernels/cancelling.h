// Asks, within a tile of many samples, whether the job was cancelled.
// Part of tile.h's source, compiled for each instruction set. Floor 2.
#pragma once
#include "engine/devices/kernel.h"

namespace lfdsim {

namespace {

/// Asks a tile's job about once a millisecond whether it was cancelled.
class Cancelling {
  public:
    explicit Cancelling(const Tile& tile) : job_(tile.job) {}

    /// Takes the number of points that are about to be traced; returns whether to end without them.
    bool ends_before(std::int64_t points) {
        points_ += points;
        if (points_ < often) return ended_;
        points_ = 0;
        return ended_ = ended_ || (job_ && is_cancelled(*job_));
    }
    bool ended() const { return ended_; }

  private:
    static constexpr std::int64_t often = 1 << 14;
    const Job* job_;
    std::int64_t points_ = 0;
    bool ended_ = false;
};

}  // namespace

}  // namespace lfdsim
