// Progress of long work, on standard error. Floor 5.
#pragma once
#include "base/job.h"
#include "cli/program/interrupt.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>

namespace lfdsim::cli {

/// Shows stages as a bar that is redrawn (on a terminal), as plain lines now and then, or as lines of JSON; stops the work when the
/// user asks for it. One at a time.
class Progress : public Job {
  public:
    /// `style`: auto | bar | lines | json | none. auto: a bar on a terminal, else lines.
    explicit Progress(const std::string& style);
    ~Progress() override;

    void stage(std::string_view name, std::int64_t units) override;
    void advance(std::int64_t units) override;
    bool cancelled() const override { return interrupted(); }
    /// Shows how far the last stage came, and ends its line.
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
    std::int64_t shown_tenths_ = 0;  // of the work, when it was last shown
};

}  // namespace lfdsim::cli
