#include "cli/bench.h"
#include "cli/bench_cases.h"
#include "engine/gpu.h"
#include "engine/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <iterator>

// Group "gpu": the whole picture of the paper's size by the first GPU; its own seconds, and those with transfers. The panel is
// there before, as when a camera moves.
namespace lfdsim::cli {
namespace {

struct Wanted {
    const char* name;
    Estimator estimator;
    int samples;  // 0: no diffuser, one ray tells all
};
constexpr Wanted wanted[] = {
    {"point, 100 samples", Estimator::point, 100},
    {"filtered, 1 sample", Estimator::filtered, 1},
    {"filtered, 4 samples", Estimator::filtered, 4},
    {"filtered, 16 samples", Estimator::filtered, 16},
    {"no diffuser", Estimator::point, 0},
};

Display display_of(const Wanted& w) {
    Display d = bench_display();
    d.render.estimator = w.estimator;
    d.render.samples = std::max(w.samples, 1);
    if (w.samples == 0) d.diffuser.reset();
    return d;
}

}  // namespace

void bench_gpu(Bench& bench) {
    bench.heading("GPU: plano-convex lenses, opaque, Schlick, diffuser, 3840 x 2160; its own clock, and with transfers");
    const cuda::Found& found = found_gpus();
    if (!found.missing.empty()) return bench.not_measured("gpu", "all", found.missing);
    const Texels panel = noise_panel(bench_display());
    const Pyramid pyramid(panel, bench.settings.threads);
    std::vector<std::vector<double>> own(std::size(wanted));
    std::vector<Case> cases;
    for (std::size_t k = 0; k < std::size(wanted); ++k) {
        const Display d = display_of(wanted[k]);
        cases.push_back({wanted[k].name, [&, k, d, geometry = resolve(d)](Job& job) {
                             RenderOptions options;
                             options.device = "cuda";
                             const Rendering r = render(d, geometry, pyramid, options, job);
                             if (!job.cancelled()) own[k].push_back(r.gpu_seconds);
                             return Run{r.seconds, double(r.samples)};
                         }});
    }
    // The first picture waits for the panel and for memory.
    Job quiet;
    for (const Case& c : cases) c.run(quiet);
    for (auto& seconds : own) seconds.clear();
    const std::vector<Measured> all = bench.measure("gpu", cases);
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (all[k].seconds.empty() || own[k].empty()) continue;
        std::sort(own[k].begin(), own[k].end());
        const double median = own[k][own[k].size() / 2];
        bench.row("gpu",
                  {{"name", all[k].name},
                   {"gpu", found.gpus.front().name},
                   {"gpu_seconds", {{"median", median}, {"least", own[k].front()}, {"most", own[k].back()}}},
                   {"gsamples_per_s", all[k].count / median * 1e-9},
                   {"seconds", spread(all[k])}},
                  fmt::format("{:<32} {:8.3f} ms on the GPU, {:8.3f} ms with transfers, {:8.2f} billion samples/s", all[k].name,
                              median * 1e3, all[k].median() * 1e3, all[k].count / median * 1e-9));
    }
}

}  // namespace lfdsim::cli
