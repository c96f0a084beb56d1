#include "analysis/pictures/views.h"
#include "base/seconds.h"
#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "engine/devices/devices.h"
#include "engine/devices/gpu.h"

#include <fmt/format.h>
#include <atomic>
#include <chrono>
#include <future>

// Group "sweep": the views of a field of view, rendered and compared with photographs that exist before. On a GPU the views stay in
// its memory, and so do the photographs after their first comparison; it works on two views at a time, so that it does not wait for
// the CPU between them.
namespace lfdsim::cli {
namespace {

constexpr int sweep_views = 122;  // 61 angles along each axis

Display sweep_display(bool quick) {
    Display d = bench_display();
    d.render.estimator = Estimator::point;
    d.render.samples = 16;
    if (quick) d.camera.resolution = {960, 540};
    return d;
}

/// View k of the sweep: a degree apart, from 30 degrees left to 30 right, then from below to above.
Display view(const Display& d, int k) { return seen_from(d, k < 61 ? k - 30 : 0, k < 61 ? 0 : k - 91); }

}  // namespace

void bench_sweep(Bench& bench) {
    const bool quick = bench.settings.quick;
    const Display d = sweep_display(quick);
    bench.heading(fmt::format("A field of view: {} views of {} x {}, 16 points a pixel, each with SSIM to an existing photograph",
                              sweep_views, d.camera.resolution[0], d.camera.resolution[1]));
    const Texels texels = noise_panel(d);
    const SummedPanel panel(texels, bench.settings.threads);
    // The comparison takes as long with any photograph: two views of the sweep, in turn, compared in the whole frame.
    const Region whole = Region::of({0, 0, int(d.camera.resolution[0]), int(d.camera.resolution[1])});
    std::vector<Expected> photographs;
    for (const int k : {30, 36}) {
        Image image = render(view(d, k), resolve(view(d, k)), panel, {bench.settings.threads, "", {}}, bench.job()).image;
        if (bench.cancelled()) return;
        photographs.emplace_back(std::move(image), whole, whole);
    }
    struct Swept {
        const char *name, *device;
        int each;                       // views 0, each, 2 each ... are rendered
        int at_once;                    // views at a time
        std::vector<double> ssim = {};  // of each view; 0 where it was not rendered
    };
    std::vector<Swept> sweeps = {{"CPU", "cpu", quick ? 61 : 12, 1}};
    if (found_gpus().missing.empty()) sweeps.push_back({"GPU", "cuda", 1, 2});
    std::vector<Case> cases;
    for (Swept& s : sweeps)
        cases.push_back({s.name, [&](Job& job) {
                             const RenderOptions options{bench.settings.threads, "", {}, {}, s.device};
                             s.ssim.assign(sweep_views, 0);
                             std::atomic<int> next = 0, done = 0;
                             const auto compare_some = [&] {
                                 for (int k; (k = next.fetch_add(s.each)) < sweep_views && !job.cancelled(); ++done) {
                                     const Display seen = view(d, k);
                                     const Expected& photograph = photographs[std::size_t(k % 2)];
                                     s.ssim[std::size_t(k)] =
                                         compare_view(seen, resolve(seen), panel, photograph, 1, options, job).likeness.screen;
                                 }
                             };
                             const auto start = std::chrono::steady_clock::now();
                             std::vector<std::future<void>> others;
                             for (int n = 1; n < s.at_once; ++n) others.push_back(std::async(std::launch::async, compare_some));
                             compare_some();
                             for (auto& other : others) other.get();
                             return Run{seconds_since(start), double(done)};
                         }});
    if (sweeps.size() > 1) {  // the first views wait for panel, photographs and memory
        Job quiet;
        cases[1].run(quiet);
    }
    const std::vector<Timing> all = bench.measure("sweep", cases);
    if (bench.cancelled()) return;
    for (std::size_t n = 0; n < all.size(); ++n) {
        if (all[n].seconds.empty()) continue;
        const Swept& s = sweeps[n];
        int differ = 0;  // from the CPU's SSIM, of the views that it rendered
        for (std::size_t k = 0; k < s.ssim.size(); k += std::size_t(sweeps[0].each)) differ += s.ssim[k] != sweeps[0].ssim[k];
        const double whole_sweep = all[n].median() / all[n].count * sweep_views;
        Json values = {{"name", s.name}, {"views", int(all[n].count)}, {"seconds", spread(all[n])}, {"sweep_seconds", whole_sweep}};
        std::string text = fmt::format("{:<24} {:9.3f} s a sweep, from {} views", s.name, whole_sweep, all[n].count);
        if (n > 0) {
            values["ssim_differs"] = differ;
            text += fmt::format("; SSIM differs from the CPU's in {} views", differ);
        }
        bench.row("sweep", std::move(values), text);
    }
    if (sweeps.size() == 1) bench.not_measured("sweep", "GPU", found_gpus().missing);
}

}  // namespace lfdsim::cli
