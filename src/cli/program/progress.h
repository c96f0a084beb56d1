// Progress of long work, on standard error. Floor 5.
#pragma once
#include "base/job.h"
#include "cli/program/interrupt.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace lfdsim::cli {

/// Shows stages as a bar that is redrawn (on a terminal), as lines of text at least three seconds apart, or as lines of JSON; stops
/// the work after a signal. There may be one at a time.
class Progress : public Job {
  public:
    /// `style` is auto, bar, lines, json or none; auto is a bar on a terminal, else lines.
    explicit Progress(const std::string& style);
    ~Progress() override;

    void stage(std::string_view name, std::int64_t units) override;
    void advance(std::int64_t units) override;
    bool cancelled() const override { return interrupted(); }
    /// Shows what the last stage reached, and ends its line.
    void end();

  private:
    using Clock = std::chrono::steady_clock;
    void show(std::int64_t done, bool last);

    HeedSignals heed_;
    std::string style_, name_;
    std::atomic<std::int64_t> done_{0};
    std::int64_t units_ = 0;
    std::mutex showing_;
    Clock::time_point begun_, shown_;
    std::int64_t shown_tenths_ = 0;  // tenths of the work that were done when it was last shown
};

}  // namespace lfdsim::cli
