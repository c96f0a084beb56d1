// Work in many equal parts, on all threads, that reports progress and can be stopped. Floor 3.
#pragma once
#include "analysis/core/subject.h"

#include <atomic>
#include <cstdint>
#include <functional>

namespace lfdsim {

/// Parts of a measure. What part k computes must not depend on the others: results are then the same on any number of threads.
class Parts {
  public:
    /// `count` parts in all, over one or several calls of run(), are worth `steps` of the job's; threads 0: all.
    Parts(Job& job, int threads, std::int64_t count, std::int64_t steps)
        : job_(job), threads_(threads), count_(count), steps_(steps) {}

    /// part(0) .. part(n - 1), from any thread. Throws Stopped soon after the job is cancelled.
    void run(int n, const std::function<void(int)>& part);

  private:
    Job& job_;
    int threads_;
    std::int64_t count_, steps_;
    std::atomic<std::int64_t> done_{0};
};

/// The cost of tracing so many single rays, in pictures of the camera's size (Measure::steps).
std::int64_t pictures_worth(const Subject&, std::int64_t rays);

}  // namespace lfdsim
