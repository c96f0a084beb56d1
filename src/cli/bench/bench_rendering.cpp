#include "base/counted.h"
#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "engine/render.h"

#include <fmt/format.h>

// Groups "rendering", "lenses", "kernels", "threads": samples a second, one change at a time. Samples are counted as traced, so "no
// diffuser", which traces one ray a pixel, shows what a pixel costs besides its samples.
namespace lfdsim::cli {
namespace {

// The cases of a group, all with the same panel image: changes must keep the panel's pixels.
class Renders {
  public:
    explicit Renders(Bench& bench) : bench_(bench), panel_(noise_panel(bench_display())) {}

    void add(const std::string& name, const Display& d, RenderOptions options) {
        cases_.push_back(rendering(name, d, panel_, options));
    }
    void add(std::span<const Duty> changes, int rows) {
        for (const Duty& duty : changes) {
            Display d = bench_display();
            duty.change(d);
            add(duty.name, d, {bench_.settings.threads, bench_.settings.kernel, band(d, rows)});
        }
    }
    void report(const std::string& group) { bench_.rates(group, "samples", bench_.measure(group, cases_)); }

  private:
    Bench& bench_;
    Texels panel_;
    std::vector<Case> cases_;
};

}  // namespace

void bench_rendering(Bench& bench) {
    bench.heading("Rendering: plano-convex lenses, opaque, Schlick, diffuser, 3840 x 2160 x 100; relative to its middle rows");
    Renders renders(bench);
    renders.add(duties, bench.settings.quick ? 32 : 216);
    if (!bench.settings.quick)
        renders.add("plain, whole picture", bench_display(), {bench.settings.threads, bench.settings.kernel, {}});
    renders.report("rendering");
}

void bench_lenses(Bench& bench) {
    bench.heading("Lenses and what is between them: the middle rows; relative to the first");
    Renders renders(bench);
    renders.add(glasses, bench.settings.quick ? 16 : 64);
    renders.report("lenses");
}

void bench_kernels(Bench& bench) {
    bench.heading("Kernels: the plain case on one thread; relative to the first");
    Renders renders(bench);
    const Display d = bench_display();
    for (const KernelInfo& kernel : kernels())
        if (kernel.available)
            renders.add(fmt::format("{}, {}", kernel.name, counted(kernel.lanes, "lane")), d,
                        {1, kernel.name, band(d, bench.settings.quick ? 16 : 48)});
    renders.report("kernels");
}

void bench_threads(Bench& bench) {
    bench.heading("Threads: the plain case, 1, 2, 4 ... all; relative to one");
    Renders renders(bench);
    const Display d = bench_display();
    const auto add = [&](int n) {
        renders.add(counted(n, "thread"), d, {n, bench.settings.kernel, band(d, bench.settings.quick ? 64 : 432)});
    };
    for (int n = 1; n < bench.settings.threads; n *= 2) add(n);
    add(bench.settings.threads);
    renders.report("threads");
}

}  // namespace lfdsim::cli
