// Work in many equal parts, on all threads, that reports progress and can be cancelled. Floor 3.
#pragma once
#include "analysis/core/subject.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace lfdsim {

/// The parts of a measure. What part k computes must not depend on the others: results are then the same with any number of
/// threads.
class Parts {
  public:
    /// `count` parts in all, over one or several calls of run(), advance the job by `steps`. 0 threads: one for each processor.
    Parts(Job& job, int threads, std::int64_t count, std::int64_t steps)
        : job_(job), threads_(threads), count_(count), steps_(steps) {}

    /// Runs part(0) ... part(n - 1), from any thread. Throws Stopped soon after the job is cancelled.
    void run(int n, const std::function<void(int)>& part);

  private:
    Job& job_;
    int threads_;
    std::int64_t count_, steps_;
    std::atomic<std::int64_t> done_{0};
};

/// Returns the cost of tracing `rays` single rays, in pictures of the camera's size (Measure::steps); at least 1.
std::int64_t pictures_worth(const Subject&, std::int64_t rays);

}  // namespace lfdsim
