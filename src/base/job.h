// Progress and cancellation of long work. Floor 0, public.
#pragma once
#include <cstdint>
#include <string_view>

namespace lfdsim {

/// The caller of long work: it shows progress and may stop the work. This base class does neither.
class Job {
  public:
    virtual ~Job() = default;
    /// A new stage of `units` units of work begins (called from the caller's thread).
    virtual void stage(std::string_view /*name*/, std::int64_t /*units*/) {}
    /// `units` more are done. Called from any thread.
    virtual void advance(std::int64_t /*units*/) {}
    /// True when the work should end soon, keeping what is complete. Called from any thread, often.
    virtual bool cancelled() const { return false; }
};

/// A job that passes on cancellation alone. Stages of single pictures are then not shown: progress is that of the whole run.
class Quiet : public Job {
  public:
    explicit Quiet(const Job& whole) : whole_(whole) {}
    bool cancelled() const override { return whole_.cancelled(); }

  private:
    const Job& whole_;
};

}  // namespace lfdsim
