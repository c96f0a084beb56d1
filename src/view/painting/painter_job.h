// The Job of a painter's long work: sends progress to the page, and stops the work when something newer is wanted. Floor 5.
#pragma once
#include "analysis/core/subject.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <string>

namespace lfdsim::view {

class PainterJob : public Job {
  public:
    /// tell(stage, share from 0 to 1) is called from any thread, one at a time, for stages that take longer than a quarter of a
    /// second, and at most every quarter of a second.
    using Tell = std::function<void(const std::string&, double)>;
    PainterJob(std::function<bool()> cancelled, Tell tell) : cancelled_(std::move(cancelled)), tell_(std::move(tell)) {}

    void stage(std::string_view name, std::int64_t units) override {
        name_ = name;
        units_ = units;
        done_ = 0;
        next_ = now() + quiet;
    }
    void advance(std::int64_t units) override {
        const std::int64_t done = done_ += units;
        std::int64_t next = next_;
        if (done >= units_ || now() < next || calls_ >= most_calls || !next_.compare_exchange_strong(next, now() + quiet)) return;
        ++calls_;
        tell_(name_, double(done) / double(units_));
    }
    bool cancelled() const override { return cancelled_(); }

  private:
    static constexpr std::int64_t quiet = 250;  // ms between two calls of tell
    static constexpr int most_calls = 100;      // calls in all: an outbox takes 256 texts
    static std::int64_t now() {
        return std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now().time_since_epoch()).count();
    }

    std::function<bool()> cancelled_;
    Tell tell_;
    std::string name_;
    std::int64_t units_ = 1;
    std::atomic<std::int64_t> done_{0}, next_{0};
    std::atomic<int> calls_{0};
};

/// A job for writers, which do not check cancelled(): throws Stopped from advance() when the work is to end.
class Writing : public Job {
  public:
    explicit Writing(const Job& whole) : whole_(whole) {}
    void advance(std::int64_t) override {
        if (whole_.cancelled()) throw Stopped{};
    }

  private:
    const Job& whole_;
};

}  // namespace lfdsim::view
