#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "engine/devices/gpu.h"
#include "engine/render.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <iterator>

// Group "gpu": the whole picture of the paper's size by the first GPU; time by the GPU's clock, and with transfers. The panel is in
// the GPU's memory before, as when a camera moves.
namespace lfdsim::cli {
namespace {

/// A number of samples a pixel and its name in the table.
struct GpuCase {
    const char* name;
    int samples;  // 0: no diffuser, one ray a pixel
};
constexpr GpuCase gpu_cases[] = {
    {"points, 100 samples", 100}, {"points, 16 samples", 16}, {"points, 4 samples", 4}, {"points, 1 sample", 1}, {"no diffuser", 0},
};

Display display_of(const GpuCase& w) {
    Display d = bench_display();
    d.render.estimator = Estimator::point;
    d.render.samples = std::max(w.samples, 1);
    if (w.samples == 0) d.diffuser.reset();
    return d;
}

RenderOptions on_gpu(std::optional<Rect> crop = {}) {
    RenderOptions options;
    options.device = "cuda";
    options.crop = crop;
    return options;
}

// Root mean square difference of two pictures, in linear light.
double rmse(const Image& a, const Image& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) sum += (double(a.rgb[i]) - b.rgb[i]) * (double(a.rgb[i]) - b.rgb[i]);
    return std::sqrt(sum / double(a.rgb.size()));
}

}  // namespace

void bench_gpu(Bench& bench) {
    bench.heading("GPU: plano-convex lenses, opaque, Schlick, diffuser, 3840 x 2160; time on the GPU, and with transfers");
    const cuda::GpuSearch& found = found_gpus();
    if (!found.missing.empty()) return bench.not_measured("gpu", "all", found.missing);
    const Texels panel = noise_panel(bench_display());
    const SummedPanel summed(panel, bench.settings.threads);
    std::vector<std::vector<double>> own(std::size(gpu_cases));  // seconds by the GPU's clock, of each run of each case
    std::vector<Case> cases;
    for (std::size_t k = 0; k < std::size(gpu_cases); ++k) {
        const Display d = display_of(gpu_cases[k]);
        cases.push_back({gpu_cases[k].name, [&, k, d, geometry = resolve(d)](Job& job) {
                             const Rendering r = render(d, geometry, summed, on_gpu(), job);
                             if (!job.cancelled()) own[k].push_back(r.gpu_seconds);
                             return Run{r.seconds, double(r.samples)};
                         }});
    }
    // The first pictures wait for the panel's transfer and for memory: they are not timed.
    Job quiet;
    for (const Case& c : cases) c.run(quiet);
    for (auto& seconds : own) seconds.clear();
    const std::vector<Timing> all = bench.measure("gpu", cases);
    if (bench.cancelled()) return;
    // Errors are measured in the middle rows. They are those of the CPU's picture, too, which is the same to the bit.
    const auto rows = [&](const GpuCase& w) {
        const Display d = display_of(w);
        return render(d, resolve(d), summed, on_gpu(band(d, 64)), bench.job()).image;
    };
    const Image truth = rows({"", 16384});
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (all[k].seconds.empty() || own[k].empty()) continue;
        std::sort(own[k].begin(), own[k].end());
        const double median = own[k][own[k].size() / 2];
        const bool sampled = gpu_cases[k].samples > 0;
        const double error = sampled ? rmse(rows(gpu_cases[k]), truth) : 0;
        bench.row("gpu",
                  {{"name", all[k].name},
                   {"gpu", found.gpus.front().name},
                   {"gpu_seconds", {{"median", median}, {"least", own[k].front()}, {"most", own[k].back()}}},
                   {"gsamples_per_s", all[k].count / median * 1e-9},
                   {"seconds", spread(all[k])},
                   {"rmse", sampled ? Json(error) : Json()}},
                  fmt::format("{:<24} {:8.3f} ms on the GPU, {:8.3f} ms with transfers, {:8.2f} billion samples/s{}", all[k].name,
                              median * 1e3, all[k].median() * 1e3, all[k].count / median * 1e-9,
                              sampled ? fmt::format(", RMSE {:.5f}", error) : ""));
    }
}

}  // namespace lfdsim::cli
