#include "python/work.h"

#include <nanobind/stl/string.h>

#include <atomic>
#include <chrono>
#include <future>
#include <mutex>
#include <string>

namespace lfdsim::python {
namespace {

namespace nb = nanobind;

constexpr std::chrono::milliseconds between_looks{50};

/// A job whose progress, which the working thread reports, the waiting thread reads.
class Watched : public Job {
  public:
    struct ReportedProgress {
        std::string stage;
        std::int64_t done, units;
        bool operator==(const ReportedProgress&) const = default;
    };

    void stage(std::string_view name, std::int64_t units) override {
        const std::lock_guard lock(naming_);
        name_ = name;
        units_ = units;
        done_ = 0;
    }
    void advance(std::int64_t units) override { done_ += units; }
    bool cancelled() const override { return cancelled_; }

    void cancel() { cancelled_ = true; }
    ReportedProgress seen() const {
        const std::lock_guard lock(naming_);
        return {name_, done_, units_};
    }

  private:
    mutable std::mutex naming_;
    std::string name_;
    std::int64_t units_ = 0;
    std::atomic<std::int64_t> done_{0};
    std::atomic<bool> cancelled_{false};
};

/// Lets Python handle signals and, if the job has got further than `last`, calls progress(). Needs Python's lock. Throws
/// nb::python_error if either raises.
void look(const nb::object& progress, const Watched& job, Watched::ReportedProgress& last) {
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    if (progress.is_none()) return;
    Watched::ReportedProgress now = job.seen();
    if (now.stage.empty() || now == last) return;
    last = std::move(now);
    progress(last.stage, last.done, last.units);
}

}  // namespace

void run(const nb::object& progress, const std::function<void(Job&)>& work) {
    Watched job;
    Watched::ReportedProgress last{"", 0, 0};
    const nb::gil_scoped_release unlocked;
    std::future<void> finished = std::async(std::launch::async, [&] { work(job); });
    try {
        while (finished.wait_for(between_looks) != std::future_status::ready) {
            const nb::gil_scoped_acquire locked;
            look(progress, job, last);
        }
    } catch (...) {
        job.cancel();
        finished.wait();
        throw;
    }
    try {
        finished.get();
    } catch (...) {  // the cause may be a signal that a child process got, too: then KeyboardInterrupt goes first
        const nb::gil_scoped_acquire locked;
        if (PyErr_CheckSignals() != 0) throw nb::python_error();
        throw;
    }
}

}  // namespace lfdsim::python
