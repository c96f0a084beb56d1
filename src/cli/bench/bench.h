// lfdsim bench: cases that are timed in turn, and the groups that they belong to (docs/performance.md). Floor 5.
#pragma once
#include "cli/output/output.h"
#include "cli/program/progress.h"
#include "display/display.h"
#include "engine/render.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim::cli {

/// The command's options, as the groups read them.
struct BenchSettings {
    int runs = 5;        // of each case
    bool quick = false;  // makes each run's work smaller
    bool json = false;
    int threads = 1;                    // 1 or more; "all processors" is resolved
    std::string kernel;                 // a name of kernels()
    std::string model;                  // mesh file of the groups "content" and "estimators"
    bool model_given = false;           // whether the model replaces the one that a description names
    std::vector<std::string> displays;  // description files of the group "estimators"; empty: the display of bench_cases.h
    std::string crop;                   // X0,Y0,X1,Y1 of "estimators"; empty: the middle of the frame
    double angle_deg = 0;               // of "estimators": moves the camera about the vertical through its target, to the right
};

/// The time of one run and the quantity that it handled, in the group's unit.
struct Run {
    double seconds = 0, count = 0;
};

/// Work that is timed.
struct Case {
    std::string name;              // its row in the tables
    std::function<Run(Job&)> run;  // the result does not count if the job is cancelled meanwhile
};

/// A case that renders the display with a panel, a Texels or SummedPanel that outlives it; it counts samples.
template <class Panel>
Case rendering(const std::string& name, const Display& display, const Panel& panel, const RenderOptions& options) {
    return {name, [&panel, options, display, geometry = resolve(display)](Job& job) {
                const Rendering r = render(display, geometry, panel, options, job);
                return Run{r.seconds, double(r.samples)};
            }};
}

/// The repeated runs of a case.
struct Timing {
    std::string name;
    std::vector<double> seconds;            // wall-clock time of each run, in ascending order
    std::vector<double> processor_seconds;  // user and system time of all threads and ended child processes, ascending
    double count = 0;                       // quantity that a run handles, in the group's unit

    double median() const;            // of `seconds`; NaN without runs
    double processor_median() const;  // of `processor_seconds`; NaN without runs
    double rate() const { return count / median(); }
};

/// Times cases and collects the rows of all groups: prints them, or keeps them for --json.
class Bench {
  public:
    Bench(const BenchSettings&, Progress&);

    const BenchSettings settings;

    /// Times all cases once, then all again, settings.runs times: other load on the machine then affects all cases alike. Returns a
    /// Timing for each case, in order; after a signal those that were run at least once.
    std::vector<Timing> measure(std::string_view stage, const std::vector<Case>&);
    bool cancelled() const { return progress_.cancelled(); }
    /// The job for work that is not timed; such work shows its progress.
    Job& job() { return progress_; }

    void heading(const std::string& text);
    /// Adds a row for each case: millions of `unit` ("samples", "rays", "pixels") a second, and that rate relative to the first's.
    void rates(const std::string& group, const char* unit, const std::vector<Timing>&);
    /// Adds a row for each case: its seconds and, if it has a count, millions of `unit` a second.
    void seconds(const std::string& group, const char* unit, const std::vector<Timing>&);
    /// Adds a row of any form: `values` for --json, `text` for the table.
    void row(const std::string& group, Json values, const std::string& text);
    /// Adds a row for a case or group that this machine cannot run.
    void not_measured(const std::string& group, const std::string& name, const std::string& why);
    /// The rows so far: {"group": [row, ...]}.
    const Json& groups() const { return groups_; }

  private:
    Progress& progress_;
    Json groups_ = Json::object();
};

/// Seconds as JSON: median, least, most, number of runs, and the median of processor seconds. Needs at least one run.
Json spread(const Timing&);

/// A case with a feature relative to the same case without: seconds of both and the ratio of their medians, as JSON and as text.
struct Over {
    Json json;
    std::string text;
};
Over over(const Timing& with, const Timing& plain);

void bench_rendering(Bench&);
void bench_lenses(Bench&);
void bench_colour(Bench&);
void bench_errors(Bench&);
void bench_kernels(Bench&);
void bench_threads(Bench&);
void bench_gpu(Bench&);
void bench_sweep(Bench&);
void bench_content(Bench&);
void bench_pictures(Bench&);
void bench_paper(Bench&);
void bench_estimators(Bench&);

/// The displays of the group "estimators", their cameras moved by angle_deg. Throws InputError with everything that is wrong with
/// their files, camera positions and crop, or if the memory does not suffice.
std::vector<Display> bench_displays(const BenchSettings&);

}  // namespace lfdsim::cli
