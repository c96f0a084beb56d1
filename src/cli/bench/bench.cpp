#include "cli/bench/bench.h"

#include "base/counted.h"
#include "cli/bench/bench_cases.h"
#include "cli/options/work_options.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/machine.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"
#include "engine/devices/threads.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <tbb/info.h>
#include <algorithm>
#include <filesystem>
#include <iterator>

// lfdsim bench: measures the program on this machine, group by group, and reports the machine and the build with the figures.
namespace lfdsim::cli {
namespace {

/// A group of benchmarks and the function that runs it.
struct BenchGroup {
    const char* name;
    void (*run)(Bench&);
};
constexpr BenchGroup groups[] = {
    {"paper", bench_paper},   {"rendering", bench_rendering}, {"lenses", bench_lenses},     {"colour", bench_colour},
    {"errors", bench_errors}, {"kernels", bench_kernels},     {"threads", bench_threads},   {"gpu", bench_gpu},
    {"sweep", bench_sweep},   {"content", bench_content},     {"pictures", bench_pictures}, {"estimators", bench_estimators},
};

std::vector<std::string> group_names() {
    std::vector<std::string> names;
    for (const BenchGroup& g : groups) names.emplace_back(g.name);
    return names;
}

struct BenchArguments {
    Command command;
    WorkOptions work{command};
    List chosen =
        command.list("GROUP", "", fmt::format("What to measure; default: all. Groups: {}", fmt::join(group_names(), ", ")));
    Option runs = command.option("--runs", "N", "Runs of each case, of which the median is printed; default 5");
    Flag quick = command.flag("--quick", "One run of each case, with less work");
    Option kernel = command.option("--kernel", "scalar|baseline|avx2|avx512",
                                   "Instruction set; default: environment variable LFDSIM_KERNEL, else the best available");
    Option model = command.option("--model", "FILE", "Mesh file for content and estimators")
                       .initially("/usr/share/assimp/models/BLEND/Suzanne_248.blend")
                       .shown();
    List displays =
        command.list("--display", "FILE", "Estimators: descriptions to render; default: the display of the other groups");
    Option crop = command.option("--crop", "X0,Y0,X1,Y1", "Estimators: this part of the frame; default: its middle");
    Option angle =
        command.option("--angle-deg", "A", "Estimators: move the camera by A degrees to the right around its target; default 0");
};

BenchSettings settings_of(const BenchArguments& args) {
    BenchSettings s;
    s.quick = args.quick;
    s.runs = args.quick ? 1 : s.runs;
    s.json = args.work.json();
    s.model = args.model.text();
    s.model_given = args.model.given();
    s.displays = args.displays.texts();
    s.crop = args.crop.text();
    Faults faults;
    for (const std::string& name : args.chosen.texts()) faults.of([&] { word("GROUP", name, group_names()); });
    faults.of(args.angle, [&] { s.angle_deg = args.angle.number(); });
    faults.of(args.runs, [&] { s.runs = int(args.runs.whole_number(1, 1000)); });
    faults.of([&] { args.work.check(); });
    faults.of([&] { s.kernel = choose_kernel(args.kernel.text()).name; });
    if (std::error_code error; s.model_given && !std::filesystem::exists(s.model, error))
        faults.of([&] { throw InputError("--model", s.model + " does not exist"); });
    faults.of([&] { bench_displays(s); });
    faults.of([&] {
        const Display d = bench_display();  // the display of the other groups, which hold two panel images at once
        require_picture_memory(d.camera.resolution[0], d.camera.resolution[1], 2 * texel_bytes(d));
    });
    faults.report();
    s.threads = threads_used(args.work.threads());
    return s;
}

/// The machine, the build and the settings that the figures depend on.
Json about(const BenchSettings& s) {
    return {
        {"version", LFDSIM_VERSION},
        {"machine",
         {{"processor", processor()},
          {"processors", tbb::info::default_concurrency()},
          {"memory_gb", std::round(installed_bytes() / 1e8) / 10}}},
        {"build", {{"compiler", compiler()}, {"type", build_type()}, {"flags", flags()}, {"kernel_flags", kernel_flags(s.kernel)}}},
        {"kernel", s.kernel},
        {"threads", s.threads},
        {"runs", s.runs},
        {"quick", s.quick}};
}

void run(const BenchArguments& args) {
    const BenchSettings settings = settings_of(args);
    Json all = about(settings);
    if (!settings.json)
        print(fmt::format("lfdsim {}, {}, {}\n{}, {}; kernel {}, {}; medians of {} (least .. most)\n", LFDSIM_VERSION, compiler(),
                          build_type(), processor(), counted(tbb::info::default_concurrency(), "processor"), settings.kernel,
                          counted(settings.threads, "thread"), settings.runs));
    Progress progress(args.work.progress());
    Bench bench(settings, progress);
    try {
        for (const BenchGroup& group : groups) {
            const std::vector<std::string>& chosen = args.chosen.texts();
            if ((chosen.empty() || std::ranges::count(chosen, group.name) > 0) && !bench.cancelled()) group.run(bench);
        }
    } catch (const InputError&) {
        if (!bench.cancelled()) throw;  // after a signal, the error says only that reading a model was stopped
    }
    progress.end();
    all["complete"] = !bench.cancelled();
    all.update(bench.groups());
    if (settings.json) print_json(all);
    if (bench.cancelled()) {
        spdlog::warn("interrupted; what was not measured is missing");
        throw Interrupted{};
    }
}

}  // namespace

CommandSpec bench_command() {
    return {.name = "bench",
            .summary = "Measures this machine's rendering speed, the cost of each feature, and error against time",
            .examples =
                "Examples:\n  lfdsim bench --quick\n  lfdsim bench rendering kernels --threads 1\n"
                "  lfdsim bench estimators --display displays/desktop-asphere.toml displays/desktop-ideal.toml --json",
            .run = with_options<BenchArguments>(run)};
}

}  // namespace lfdsim::cli
