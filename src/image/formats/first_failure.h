// Exceptions in a pipeline of threads. Internal to src/image. Floor 0.
#pragma once
#include <atomic>
#include <exception>

namespace lfdsim::detail {

/// Keeps the first exception until the pipeline is empty: one that leaves tbb::parallel_pipeline() leaks the items in it.
class FirstFailure {
  public:
    /// Does the work, unless other work has failed before. May be called from any thread.
    template <class Work>
    void guard(const Work& work) {
        if (failed_) return;
        try {
            work();
        } catch (...) {
            if (!failed_.exchange(true)) error_ = std::current_exception();
        }
    }
    bool failed() const { return failed_; }
    /// Throws the exception that was kept, if any. It must be called when all threads have ended.
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

  private:
    std::atomic<bool> failed_{false};
    std::exception_ptr error_;
};

}  // namespace lfdsim::detail
