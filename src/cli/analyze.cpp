#include "analysis/folder.h"
#include "analysis/measure.h"
#include "analysis/memory.h"
#include "analysis/report.h"
#include "analysis/views.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/display_options.h"
#include "cli/interrupt.h"
#include "cli/output.h"
#include "cli/panel_source.h"
#include "cli/work_options.h"
#include "files/display_file.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <chrono>

// lfdsim analyze: measures a display. What is finished stays, whatever happens to the rest.
namespace lfdsim::cli {
namespace {

struct Arguments {
    explicit Arguments(Command command)
        : measures_option(
              command.add_option("MEASURE", measures, "One or more with commas between, or all").type_name("").required()),
          display(command, {content_options, camera_options, sample_options}),
          model(command),
          device(command),
          work(command) {
        command.add_option("-o,--output", output, "Folder for the results and report.html; made if missing")
            .type_name("DIR")
            .required();
        command.add_flag("--resume", resume, "Leave out what an earlier run with the same settings has finished there");
        command.add_option("--angles-deg", angles, "Views of the field of view; default -30,30,1 or wider, as theory expects")
            .type_name("FROM,TO,STEP");
        command.add_option("--depths-mm", depths, "Depths of the model for the depth of field; default 31, a centimetre apart")
            .type_name("FROM,TO,STEP");
        command.add_option("--viewing-distance-mm", viewing_distance, "Of eyes from the panel; default the camera's")
            .type_name("D");
        command.add_option("--eye-distance-mm", eye_distance, "Between two eyes; default 65").type_name("E");
        command.add_option("--wavelength-nm", wavelength, "Of diffraction; default 550").type_name("W");
    }
    std::string measures;
    Option measures_option;
    DisplayOptions display;
    ModelOption model;
    DeviceOption device;
    WorkOptions work;
    std::string output, angles, depths, viewing_distance, eye_distance, wavelength;
    bool resume = false;
};

/// "-30,30,1": rising, both ends within low .. high, at most 10000 steps.
std::vector<double> steps(const char* option, const std::string& text, double low, double high) {
    if (text.empty()) return {};
    const std::vector<double> v = numbers(option, text, 3);
    if (!(v[0] < v[1] && v[2] > 0 && (v[1] - v[0]) / v[2] <= 10000 && v[0] >= low && v[1] <= high))
        throw InputError(option,
                         fmt::format("is {}; give FROM,TO,STEP with {} <= FROM < TO <= {} and a STEP above 0 that makes at most "
                                     "10000 of them",
                                     text, low, high));
    std::vector<double> all;
    for (int k = 0; v[0] + k * v[2] <= v[1] + 1e-9 * v[2]; ++k) all.push_back(v[0] + k * v[2]);
    return all;
}

double positive(const char* option, const std::string& text, double most) {
    const double x = number(option, text);
    if (!(x > 0 && x <= most)) throw InputError(option, fmt::format("is {}; allowed is more than 0, up to {}", text, most));
    return x;
}

std::vector<const Measure*> chosen(const std::string& names) {
    std::vector<const Measure*> result;
    if (names == "all") {
        for (const Measure& m : measures()) result.push_back(&m);
        return result;
    }
    for (std::size_t start = 0; start <= names.size();) {
        const std::size_t end = std::min(names.find(',', start), names.size());
        const Measure& m = measure_named(names.substr(start, end - start));
        if (std::find(result.begin(), result.end(), &m) == result.end()) result.push_back(&m);
        start = end + 1;
    }
    return result;
}

std::string value_text(const Json& values, const std::string& unit) {
    if (values.empty()) return "";
    if (std::all_of(values.begin(), values.end(), [](const Json& x) { return x.is_null(); })) return "not found";
    std::string text;
    for (const Json& x : values)
        text += (text.empty() ? "" : " .. ") + (x.is_null()     ? "not found"
                                                : x.is_number() ? fmt::format("{:.4g}", x.get<double>())
                                                                : x.get<std::string>());
    return text + (unit.empty() ? "" : " " + unit);
}

/// The largest of a finding's errors.
std::string error_text(const Json& errors) {
    double most = 0;
    for (const Json& x : errors)
        if (x.is_number()) most = std::max(most, x.get<double>());
    return most > 0 ? fmt::format(" \u00b1 {:.2g}", most) : "";
}

std::string table_of(const Json& measured) {
    const Json& report = measured.at("report");
    std::string text = fmt::format("\n{}\n", report.at("title").get<std::string>());
    for (const Json& f : report.at("findings")) {
        const std::string unit = f.at("unit"), theory = value_text(f.at("theory"), unit);
        const Json& values = f.at("measured");
        text += fmt::format("  {:<58} {:<26}{}\n", f.at("what").get<std::string>(),
                            value_text(values, unit) + error_text(f.at("error")), theory.empty() ? "" : "  theory " + theory);
        if (std::any_of(values.begin(), values.end(), [](const Json& x) { return x.is_null(); }))
            text += fmt::format("      {}\n", f.at("remark").get<std::string>());
    }
    return text;
}

/// What tells evenly spaced values from others.
Json ends(const std::vector<double>& values) {
    if (values.empty()) return Json();
    return {{"from", values.front()}, {"to", values.back()}, {"count", values.size()}};
}

constexpr const char* report_name = "report.html";

/// What is finished is kept and reported, whatever becomes of the rest.
struct Run {
    Subject& subject;
    const ResultFolder& folder;
    ReportAbout about;
    std::vector<Problem> problems = {};

    void measure(bool resume, const std::string& progress_style) {
        std::vector<const Measure*> left;
        std::int64_t steps = 0;
        for (const Measure* m : about.wanted) {
            if (resume && folder.has(*m)) continue;
            left.push_back(m);
            steps += m->steps(subject);
        }
        Progress progress(progress_style);
        if (!left.empty()) progress.stage("analyzing", steps);
        try {
            for (const Measure* m : left) one(*m, progress);
        } catch (const Stopped&) {
            about.interrupted = true;
        } catch (...) {
            report();
            throw;
        }
        progress.end();
        report();
    }

  private:
    void one(const Measure& m, Progress& progress) {
        try {
            const auto start = std::chrono::steady_clock::now();
            const Result result = m.run(subject, progress);
            folder.write(m, result, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        } catch (const InputError& e) {  // it does not suit this display or these options: others may
            about.failed.emplace_back(&m, e.what());
            problems.insert(problems.end(), e.problems.begin(), e.problems.end());
        }
    }
    void report() {
        if (about.interrupted || has_results(folder)) folder.write_text(report_name, report_html(subject, folder, about));
    }
};

void run(const Arguments& args) {
    Faults faults;
    Display display;
    AnalysisOptions options;
    std::vector<const Measure*> wanted;
    faults.of([&] { wanted = chosen(args.measures); });
    faults.of([&] {
        display = args.display.read();
        require_panel_memory(display);
    });
    faults.of([&] { args.work.check(); });
    faults.of([&] { args.device.apply(); });
    faults.of([&] { options.angles_deg = steps("--angles-deg", args.angles, -80, 80); });
    faults.of([&] { options.depths_mm = steps("--depths-mm", args.depths, -1e6, 1e6); });
    faults.of([&] {
        if (!args.viewing_distance.empty())
            options.viewing_distance_mm = positive("--viewing-distance-mm", args.viewing_distance, 1e6);
        if (!args.eye_distance.empty()) options.eye_distance_mm = positive("--eye-distance-mm", args.eye_distance, 1000);
        if (!args.wavelength.empty()) options.wavelength_nm = positive("--wavelength-nm", args.wavelength, 1e5);
    });
    if (args.output.empty()) faults.of([] { throw InputError("--output", "the name is empty; give a folder"); });
    faults.report();
    args.model.apply(display);
    if (display.content.model.empty()) display.content.model = built_in_spheres;
    options.threads = args.work.threads();

    std::optional<Scene> scene;
    if (std::any_of(wanted.begin(), wanted.end(), [](const Measure* m) { return m->needs_scene; })) {
        const Geometry geometry = resolve(display);
        if (display.content.depth_mm) refuse_depth_in_lenses(geometry, *display.content.depth_mm, "content.depth_mm");
        scene = load_scene(display, geometry);
    }
    Subject subject(display, std::move(scene), options);
    const std::string description = write_display(display);
    const ResultFolder folder(args.output, Json{{"lfdsim", LFDSIM_VERSION},
                                                {"display", description},
                                                {"model", stamp(display.content.model)},
                                                {"angles_deg", ends(options.angles_deg)},
                                                {"depths_mm", ends(options.depths_mm)},
                                                {"viewing_distance_mm", subject.viewing_distance_mm()},
                                                {"eye_distance_mm", options.eye_distance_mm},
                                                {"wavelength_nm", options.wavelength_nm}});
    Run run{subject, folder, {command_line(), description, wanted}};
    run.measure(args.resume, args.work.progress());

    Json found = Json::object();
    for (const Measure* m : wanted)
        if (folder.has(*m)) found[std::string(m->name)] = folder.read(*m);
    if (run.about.interrupted) {
        spdlog::warn("interrupted; {} holds {} of {} measures; the same command with --resume goes on", args.output, found.size(),
                     wanted.size());
        throw Interrupted{};
    }
    if (!run.problems.empty()) throw InputError(run.problems);
    if (args.work.json()) return print_json(wanted.size() == 1 ? found.front() : found);
    std::string text;
    for (const Json& measured : found) text += table_of(measured);
    print(fmt::format("{}\n{}: the report; the figures lie beside it\n", text, (folder.path() / report_name).string()));
}

}  // namespace

void add_analyze(Command program) {
    Command command = program.add_subcommand("analyze", "Measures a display: field of view, depth of field and more");
    const auto args = std::make_shared<Arguments>(command);
    std::string list = "Measures:\n";
    for (const Measure& m : measures()) list += fmt::format("  {:<12} {}\n", m.name, m.says);
    command.footer(list +
                   "Examples:\n  lfdsim analyze all display.toml --model monkey.blend -o report\n"
                   "  lfdsim analyze fov,dof display.toml --model monkey.blend --size 960x540 -o quick --json");
    command.callback([args] { run(*args); });
}

}  // namespace lfdsim::cli
