#include "cli/bench/bench.h"
#include "cli/bench/bench_cases.h"
#include "engine/render.h"
#include "geometry/lens_misalignment.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>

// Group "errors": the time of point samples of arrays whose lenses have errors relative to the same arrays without, and whether a
// given table of errors that is empty, which selects the renderer of single lenses, leaves the picture unchanged.
namespace lfdsim::cli {
namespace {

constexpr Duty arrays[] = {
    {"plano-convex", [](Display&) {}},
    {"asphere", make_asphere},
    {"hexagons",
     [](Display& d) {
         d.array.lattice = LatticeKind::hexagon;
         d.array.count.reset();
     }},
    {"strips", make_strips},
    {"plano-convex, plate", [](Display& d) { d.array.surround = Surround::plate; }},
};

constexpr Duty errors[] = {
    {"decentres", [](Display& d) { d.errors.decenter_sd_mm = 0.01; }},
    {"decentres, heights, curvatures",
     [](Display& d) {
         d.errors.decenter_sd_mm = d.errors.height_sd_mm = 0.01;
         d.errors.curvature_sd = 0.003;
     }},
    {"decentres, heights, curvatures, tilts",
     [](Display& d) {
         d.errors.decenter_sd_mm = d.errors.height_sd_mm = 0.01;
         d.errors.curvature_sd = 0.003;
         d.errors.tilt_sd_deg = 0.2;
     }},
};

void compare(const Duty& array, const Texels& panel, Bench& bench) {
    Display plain = bench_display();
    array.change(plain);
    const RenderOptions options{bench.settings.threads, bench.settings.kernel, band(plain, bench.settings.quick ? 16 : 108)};
    std::vector<Case> cases;
    const auto add = [&](const char* name, const Display& d) { cases.push_back(rendering(name, d, panel, options)); };
    add("none", plain);
    for (const Duty& kind : errors) {
        Display wrong = plain;
        kind.change(wrong);
        if (plain.array.surround == Surround::opaque || wrong.errors.tilt_sd_deg == 0)
            add(kind.name, wrong);  // only lenses in an opaque surround can tilt
    }
    Display nothing = plain;
    nothing.errors.given = std::make_shared<const std::vector<GivenLensError>>();
    const auto picture = [&](const Display& d) { return render(d, resolve(d), panel, options, bench.job()).image.rgb; };
    const std::vector<float> wanted = picture(plain), got = picture(nothing);
    float difference = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) difference = std::max(difference, std::abs(got[i] - wanted[i]));

    const std::vector<Timing> times = bench.measure("errors", cases);
    for (std::size_t k = 1; k < times.size(); ++k) {
        const auto [values, text] = over(times[k], times[0]);
        Json row{{"name", array.name}, {"errors", times[k].name}};
        row.update(values);
        row["greatest_difference_of_none"] = difference;
        bench.row("errors", std::move(row),
                  fmt::format("{:<20} {:<38} {}; none: differs by {:.1g}", array.name, times[k].name, text, difference));
    }
}

}  // namespace

void bench_errors(Bench& bench) {
    bench.heading(
        "Errors of single lenses: time of point samples relative to that of the same array without errors, the middle rows of 3840 "
        "x 2160");
    const Texels panel = noise_panel(bench_display());
    for (const Duty& array : arrays)
        if (!bench.cancelled()) compare(array, panel, bench);
}

}  // namespace lfdsim::cli
