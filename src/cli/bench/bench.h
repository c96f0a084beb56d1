// lfdsim bench: runs that are timed turn by turn, and the groups they come in. Floor 5.
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

struct BenchSettings {
    int runs = 5;
    bool quick = false;  // less work a run
    bool json = false;
    int threads = 1;
    std::string kernel;  // a name of kernels()
    std::string model;
    bool model_given = false;           // else a description's own goes before it
    std::vector<std::string> displays;  // of the group "estimators"; empty: the display of bench_cases.h
    std::string crop;                   // of it
    double angle_deg = 0;               // its camera, turned about the vertical through its target
};

/// The time of one run and the quantity that it handled, in the group's unit.
struct Run {
    double seconds = 0, count = 0;
};

struct Case {
    std::string name;
    std::function<Run(Job&)> run;  // a job that is cancelled makes its result void
};

/// A case that renders the display with a panel, a Texels or SummedPanel that outlives it.
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
    std::vector<double> seconds;            // of each run, in ascending order; empty: interrupted before
    std::vector<double> processor_seconds;  // the same of all threads and child processes: other programs' share is not in them
    double count = 0;

    double median() const;
    double processor_median() const;
    double rate() const { return count / median(); }
};

class Bench {
  public:
    Bench(const BenchSettings&, Progress&);

    const BenchSettings settings;

    /// Times all cases once, then again, settings.runs times: what else the machine does then meets all alike. After a signal
    /// what is done is returned.
    std::vector<Timing> measure(std::string_view stage, const std::vector<Case>&);
    bool cancelled() const { return progress_.cancelled(); }
    /// The job for work that is not timed, with its own progress bar.
    Job& job() { return progress_; }

    void heading(const std::string& text);
    /// Cases with millions of `unit` ("samples", "rays", "pixels") a second, relative to the first.
    void rates(const std::string& group, const char* unit, const std::vector<Timing>&);
    /// Cases with their seconds and, where they have a count, the rate.
    void seconds(const std::string& group, const char* unit, const std::vector<Timing>&);
    /// A result in the group's own form.
    void row(const std::string& group, Json values, const std::string& text);
    /// A case or group that this machine cannot run.
    void not_measured(const std::string& group, const std::string& name, const std::string& why);
    const Json& groups() const { return groups_; }

  private:
    Progress& progress_;
    Json groups_ = Json::object();
};

/// Seconds as JSON: median, least, most, how many runs, and the median of processor seconds.
Json spread(const Timing&);

/// A case over the same without what it shows: seconds of both and their ratio, as JSON and as text.
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

/// The displays of the group "estimators". Throws InputError with all that is wrong with their files, sizes and crop.
std::vector<Display> bench_displays(const BenchSettings&);

}  // namespace lfdsim::cli
