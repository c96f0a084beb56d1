#include "cli/bench/bench.h"

#include "base/counted.h"
#include "cli/bench/bench_cases.h"
#include "cli/options/work_options.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/machine.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"

#include <fmt/format.h>
#include <tbb/info.h>
#include <algorithm>
#include <filesystem>
#include <iterator>

// lfdsim bench: what this machine makes of the program, group by group; and what a reader of the figures has to know of both.
namespace lfdsim::cli {
namespace {

struct Group {
    const char* name;
    void (*run)(Bench&);
};
constexpr Group groups[] = {
    {"paper", bench_paper},   {"rendering", bench_rendering}, {"lenses", bench_lenses},     {"colour", bench_colour},
    {"errors", bench_errors}, {"kernels", bench_kernels},     {"threads", bench_threads},   {"gpu", bench_gpu},
    {"sweep", bench_sweep},   {"content", bench_content},     {"pictures", bench_pictures}, {"estimators", bench_estimators},
};

std::vector<std::string> group_names() {
    std::vector<std::string> names;
    for (const Group& g : groups) names.emplace_back(g.name);
    return names;
}

struct BenchArguments {
    explicit BenchArguments(Command command) : work(command) {
        command
            .add_option("GROUP", chosen, fmt::format("What to measure; default: all. Groups: {}", fmt::join(group_names(), ", ")))
            .type_name("");
        command.add_option("--runs", runs, "Runs of each case, whose median is printed; default 5").type_name("N");
        command.add_flag("--quick", quick, "One run of each case, with less work");
        command
            .add_option("--kernel", kernel, "Instruction set; default: environment variable LFDSIM_KERNEL, else the best available")
            .type_name("scalar|baseline|avx2|avx512");
        model_option =
            command.add_option("--model", model, "Mesh file for content and estimators").type_name("FILE").capture_default_str();
        command.add_option("--display", displays, "Estimators: descriptions to render; default: the display of the other groups")
            .type_name("FILE");
        command.add_option("--crop", crop, "Estimators: this part of the frame; default: its middle").type_name("X0,Y0,X1,Y1");
        command
            .add_option("--angle-deg", angle, "Estimators: move the camera by A degrees to the right around its target; default 0")
            .type_name("A");
    }
    std::vector<std::string> chosen, displays;
    std::string runs, kernel, crop, angle, model = "/usr/share/assimp/models/BLEND/Suzanne_248.blend";
    bool quick = false;
    Option model_option;
    WorkOptions work;
};

BenchSettings settings_of(const BenchArguments& args) {
    BenchSettings s;
    s.quick = args.quick;
    s.runs = args.quick ? 1 : s.runs;
    s.json = args.work.json();
    s.model = args.model;
    s.model_given = args.model_option.count() > 0;
    s.displays = args.displays;
    s.crop = args.crop;
    Faults faults;
    for (const std::string& name : args.chosen) faults.of([&] { word("GROUP", name, group_names()); });
    if (!args.angle.empty()) faults.of([&] { s.angle_deg = number("--angle-deg", args.angle); });
    if (!args.runs.empty()) faults.of([&] { s.runs = int(whole_number("--runs", args.runs, 1, 1000)); });
    faults.of([&] { args.work.check(); });
    faults.of([&] { s.kernel = choose_kernel(args.kernel).name; });
    if (std::error_code error; s.model_given && !std::filesystem::exists(args.model, error))
        faults.of([&] { throw InputError("--model", args.model + " does not exist"); });
    faults.of([&] { bench_displays(s); });
    faults.of([&] {
        const Display d = bench_display();  // of the other groups, which hold two panel images at once
        require_picture_memory(d.camera.resolution[0], d.camera.resolution[1], 2 * texel_bytes(d));
    });
    faults.report();
    s.threads = args.work.threads() > 0 ? args.work.threads() : tbb::info::default_concurrency();
    return s;
}

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
        for (const Group& group : groups) {
            const bool chosen =
                args.chosen.empty() || std::find(args.chosen.begin(), args.chosen.end(), group.name) != args.chosen.end();
            if (chosen && !bench.cancelled()) group.run(bench);
        }
    } catch (const InputError&) {
        if (!bench.cancelled()) throw;  // else the signal stopped the reader of models, too
    }
    progress.end();
    all["complete"] = !bench.cancelled();
    all.update(bench.groups());
    if (settings.json) print_json(all);
    if (bench.cancelled()) throw Interrupted{};
}

}  // namespace

void add_bench(Command program) {
    Command command =
        program.add_subcommand("bench", "Measures how fast this machine renders, what each feature costs, and error against time");
    const auto args = std::make_shared<BenchArguments>(command);
    command.footer(
        "Examples:\n  lfdsim bench --quick\n  lfdsim bench rendering kernels --threads 1\n"
        "  lfdsim bench estimators --display displays/desktop-asphere.toml displays/desktop-ideal.toml --json");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
