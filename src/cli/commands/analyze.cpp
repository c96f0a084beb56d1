#include "analysis/core/measure.h"
#include "analysis/pictures/views.h"
#include "base/printable.h"
#include "base/seconds.h"
#include "base/text.h"
#include "cli/options/display_options.h"
#include "cli/options/panel_source.h"
#include "cli/options/variants.h"
#include "cli/options/work_options.h"
#include "cli/output/findings_text.h"
#include "cli/output/output.h"
#include "cli/program/arguments.h"
#include "cli/program/commands.h"
#include "cli/program/input_files.h"
#include "cli/program/interrupt.h"
#include "engine/devices/memory.h"
#include "files/description/display_file.h"
#include "files/description/shell.h"
#include "report/folder/folder.h"
#include "report/folder/folder_lock.h"
#include "report/folder/run_settings.h"
#include "report/pages/report.h"
#include "report/pages/side_by_side.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>

// lfdsim analyze: measures one display, or several side by side. Finished measures stay, whatever happens to the rest.
namespace lfdsim::cli {
namespace {

struct AnalyzeArguments {
    Command command;
    Option measures = command.option("MEASURE", "", "One or more, separated by commas; default, or all: all of them").required();
    DisplayOptions display{command, {content_options, camera_options, sample_options}, false};
    ModelOption model{command};
    DeviceOption device{command};
    WorkOptions work{command};
    List others =
        command.list("OTHER.toml", "", "More displays: each is measured in a separate folder and compared with the first");
    Option compare = command.option("--compare", "KEY=VALUE,VALUE",
                                    "Measures the display once for each value of a key, side by side: array.gap_mm=3.2,3.3; pickup "
                                    "is short for content.pickup=nodal,traced,inverse");
    Option output = command.option("-o,--output", "DIR REQUIRED",  // request_of() reports its absence with all other faults
                                   "Folder for the results and report.html; created if missing");
    Flag resume = command.flag("--resume", "Skip measures that an earlier run with the same settings has finished there");
    Flag replace = command.flag(
        "--replace", "Remove the results of an earlier run with other settings there, and overwrite files of other origin");
    Option angles = command.option("--angles-deg", "FROM,TO,STEP",
                                   "Views of the field of view; default: 61 or more, beyond the expected edges");
    Option depths =
        command.option("--depths-mm", "FROM,TO,STEP",
                       "Depths of the model for the depth of field; default: 31 over the depth of field by theory, including 0");
    Option viewing_distance =
        command.option("--viewing-distance-mm", "D", "Distance of the eyes from the panel; default the camera's");
    Option eye_distance = command.option("--eye-distance-mm", "E", "Distance between the two eyes; default 65");
    Option wavelength = command.option("--wavelength-nm", "W", "Wavelength for diffraction; default 550");
};

/// Returns the values of an option "FROM,TO,STEP": FROM + k STEP up to TO, which is included although FROM + k STEP is rounded;
/// none if it is not given. Throws InputError unless they rise, lie within -most .. most, and are at most AnalysisLimits::values.
std::vector<double> steps(const Option& option, double most, const char* example) {
    if (option.empty()) return {};
    const std::vector<double> v = option.numbers(example);
    if (!(v[0] < v[1] && v[2] > 0 && (v[1] - v[0]) / v[2] <= AnalysisLimits::values - 1 && v[0] >= -most && v[1] <= most))
        throw InputError(
            option.name(),
            fmt::format("is {}; give FROM,TO,STEP with {} <= FROM < TO <= {} and a STEP above 0, for at most {} values",
                        option.text(), -most, most, AnalysisLimits::values));
    std::vector<double> all;
    for (int k = 0; v[0] + k * v[2] <= v[1] + 1e-9 * v[2]; ++k) all.push_back(v[0] + k * v[2]);
    return all;
}

/// Sets a number above 0 and up to `most`, if the option is given. Throws InputError if it is out of that range.
template <class Number>
void read_positive(const Option& option, double most, Number& to) {
    if (option.empty()) return;
    const double x = option.number();
    if (!(x > 0 && x <= most))
        throw InputError(option.name(), fmt::format("is {}; allowed is more than 0, up to {}", option.text(), most));
    to = x;
}

/// The measures of "fov,dof", each once, in the order of the names; of "all" all. Throws InputError for unknown names.
std::vector<const Measure*> chosen(const std::string& names) {
    std::vector<const Measure*> result;
    if (names == "all") {
        for (const Measure& m : measures()) result.push_back(&m);
        return result;
    }
    for (const std::string_view name : split(names, ',')) {
        const Measure& m = measure_named(name);
        if (std::find(result.begin(), result.end(), &m) == result.end()) result.push_back(&m);
    }
    return result;
}

/// Throws InputError if the command reads a file of the folder whose ending is one of those that measures write.
void refuse_inputs_in(const std::filesystem::path& folder) {
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
        for (const char* ending : {".json", ".csv", ".svg", ".png", ".html"})
            if (entry.path().extension() == ending) refuse_input(entry.path());
}

/// A run of measures of one display; finished ones are kept and reported, even if others fail.
struct Analysis {
    Subject& subject;
    const ResultFolder& folder;
    ReportAbout about;
    std::vector<Problem> problems = {};  // of the measures that do not suit the display or the options

    /// Runs the measures and writes the report. With `resume`, results in the folder are kept. A signal only marks the report as
    /// interrupted; an unexpected error is rethrown after the report.
    void measure(bool resume, const std::string& progress_style) {
        std::vector<const Measure*> left;
        std::int64_t steps = 0;
        for (const Measure* m : about.wanted) {
            if (resume && folder.has(*m)) continue;
            left.push_back(m);
            steps += m->steps(subject);
            if (subject.display().content.pickup == PickupKind::inverse && m->name == "dof")
                spdlog::warn("dof: the inverse pick-up is fitted once for each depth; each fit takes as long as lfdsim eia does");
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
            require_needs(m, subject.display());
            const Result result = m.run(subject, progress);
            folder.write(m, result, seconds_since(start));
        } catch (const InputError& e) {  // this measure does not suit the display or the options; others may
            about.failed.emplace_back(&m, e.what());
            problems.insert(problems.end(), e.problems.begin(), e.problems.end());
        }
    }
    void report() {
        if (about.interrupted || has_results(folder))
            folder.write_text(ResultFolder::report_name, report_html(subject, folder, about));
    }
};

/// Whether a word is "all", or a list that starts with the name of a measure.
bool names_measures(const std::string& word) {
    if (word == "all") return true;
    try {
        measure_named(word.substr(0, word.find(',')));
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::string file_name(const std::string& path) { return std::filesystem::path(path).stem(); }

/// The measures and displays of a command line.
struct AnalysisRequest {
    std::vector<const Measure*> wanted;
    std::vector<std::string> paths;  // the description file of each display; the same for all variants of --compare
    std::vector<Display> displays;
    AnalysisOptions options;
};

/// Reads the command line and the descriptions. Throws InputError with everything that is wrong.
AnalysisRequest request_of(const AnalyzeArguments& args) {
    AnalysisRequest request;
    Faults faults;
    std::string names = args.measures.text();
    request.paths = args.others.texts();
    request.paths.insert(request.paths.begin(), args.display.path());
    std::error_code none;
    // Where the first word is a description, MEASURE was left out: the words move up by one place.
    if (!names_measures(names) && (names.ends_with(".toml") || std::filesystem::is_regular_file(names, none))) {
        if (names_measures(args.display.path()) && !std::filesystem::exists(args.display.path(), none))
            throw InputError(args.display.path(),
                             fmt::format("is a measure; measures come before the display: lfdsim analyze {} {} ...",
                                         args.display.path(), shell_file(names)));
        if (args.display.path().empty()) request.paths.clear();
        request.paths.insert(request.paths.begin(), names);
        names = "all";
    }
    faults.of([&] { request.wanted = chosen(names); });
    // With --compare each variant of the one description is a display; else each description is one.
    std::vector<Variant> variants{{}};
    faults.of([&] {
        if (!args.compare.empty()) variants = variants_of(args.compare.text());
        if (!args.compare.empty() && request.paths.size() > 1)
            throw InputError("--compare", "compares one display with itself; name one description");
    });
    if (variants.size() > 1 && request.paths.size() == 1) request.paths.resize(variants.size(), request.paths.front());
    for (std::size_t n = 0; n < request.paths.size(); ++n)
        faults.of([&] {
            if (request.paths[n].empty()) throw InputError("DISPLAY.toml", "is required: give the description of a display");
            const Variant& variant = variants[n % variants.size()];
            Display& display = request.displays.emplace_back(args.display.read(request.paths[n], variant.setting));
            if (!variant.name.empty())
                display.name =
                    fmt::format("{}-{}", display.name.empty() ? file_name(request.paths[n]) : display.name, variant.name);
            args.model.apply(display);
        });
    faults.of([&] { args.work.check(); });
    AnalysisOptions& options = request.options;
    faults.of([&] { options.device = args.device.read(); });
    faults.of([&] { options.angles_deg = steps(args.angles, AnalysisLimits::angle_deg, "-30,30,1"); });
    faults.of([&] { options.depths_mm = steps(args.depths, AnalysisLimits::depth_mm, "10,300,10"); });
    faults.of([&] {
        read_positive(args.viewing_distance, AnalysisLimits::viewing_distance_mm, options.viewing_distance_mm);
        read_positive(args.eye_distance, AnalysisLimits::eye_distance_mm, options.eye_distance_mm);
        read_positive(args.wavelength, AnalysisLimits::wavelength_nm, options.wavelength_nm);
    });
    if (args.output.empty()) faults.of([] { throw InputError("--output", "is required: give a folder for the results"); });
    faults.report();
    options.threads = args.work.threads();
    return request;
}

/// The outcome of one display.
struct Outcome {
    ResultFolder folder;
    Json found = Json::object();  // {"measure": what its NAME.json holds}, of this run and of earlier ones
    bool interrupted;
    std::vector<Problem> problems;  // as Analysis::problems
};

/// Measures one display in the folder `place`.
Outcome measure(const AnalyzeArguments& args, const AnalysisRequest& request, const Display& display,
                const std::filesystem::path& place) {
    const std::vector<const Measure*>& wanted = request.wanted;
    const AnalysisOptions& options = request.options;
    std::optional<ContentScene> scene;
    if (std::any_of(wanted.begin(), wanted.end(), [](const Measure* m) { return m->needs.scene; })) {
        const Geometry geometry = resolve(display);
        if (display.content.depth_mm) refuse_depth_in_lenses(geometry, *display.content.depth_mm, "content.depth_mm");
        scene = load_scene(display, geometry);
    }
    Subject subject(display, std::move(scene), options);
    const std::string description = write_display(display);
    refuse_inputs_in(place);
    const FolderLock lock(place);
    const ResultFolder folder(place, run_settings(subject, LFDSIM_VERSION));
    folder.keep_apart(wanted, args.resume, args.replace);
    Analysis run{subject, folder, {command_line(), description, wanted}};
    run.measure(args.resume, args.work.progress());
    Outcome outcome{folder, Json::object(), run.about.interrupted, run.problems};
    for (const Measure* m : wanted)
        if (folder.has(*m)) outcome.found[std::string(m->name)] = folder.read(*m);
    return outcome;
}

/// Distinct names of folders, one for each display: the display's name, or that of its file, in characters that every file system
/// accepts.
std::vector<std::string> folder_names(const AnalysisRequest& request) {
    std::vector<std::string> all;
    for (std::size_t n = 0; n < request.displays.size(); ++n) {
        std::string name = request.displays[n].name;
        if (name.empty()) name = file_name(request.paths[n]);
        for (char& c : name)
            if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_' && c != '.') c = '_';
        name = name.substr(0, 100);
        if (name.starts_with('.')) name[0] = '_';
        std::string unique = name;
        for (int k = 2; std::find(all.begin(), all.end(), unique) != all.end(); ++k) unique = fmt::format("{}-{}", name, k);
        all.push_back(unique);
    }
    return all;
}

/// Measures each display in a separate folder, then writes one report of all. Finished measures are kept and reported here, too.
void side_by_side(const AnalyzeArguments& args, const AnalysisRequest& request) {
    const std::filesystem::path place = args.output.text();
    refuse_inputs_in(place);
    const FolderLock lock(place);
    ResultFolder::keep_report_apart(place, args.replace);
    for (const Measure& m : measures())
        if (std::filesystem::exists(place / (std::string(m.name) + ".json")))
            throw InputError("--output",
                             fmt::format("{} holds the results of one display; give another folder", args.output.text()));
    // The displays, one after the other. A signal, or a measure that refuses its input, does not prevent the report.
    const std::vector<std::string> names = folder_names(request);
    std::vector<MeasuredDisplay> measured;
    std::vector<Problem> problems;
    Json found = Json::object();
    const HeedSignals heed;  // a signal between two displays, too, does not end the program before the report
    bool interrupted = false;
    for (std::size_t n = 0; n < names.size() && !interrupted; ++n) {
        Outcome outcome = measure(args, request, request.displays[n], place / names[n]);
        interrupted = outcome.interrupted;
        for (const Problem& p : outcome.problems) problems.push_back({names[n] + ": " + p.where, p.what});
        found[names[n]] = std::move(outcome.found);
        measured.push_back({names[n], request.displays[n], std::move(outcome.folder)});
    }
    // The report, with what is missing.
    Json all = differences(measured);
    std::string missing = interrupted ? "The run was interrupted; the same command with --resume continues it." : "";
    for (const Problem& p : problems) missing += fmt::format("{}{}: {}.", missing.empty() ? "" : " ", p.where, p.what);
    write_text(place / ResultFolder::report_name, side_by_side_html(measured, all, command_line(), missing));
    if (interrupted) end_interrupted(args.output.text(), "what is finished");
    if (!problems.empty()) throw InputError(problems);
    if (args.work.json()) {
        all["results"] = found;
        return print_json(all);
    }
    print(fmt::format("{}\n{}: the report; of each display separately: {}\n", table_of_differences(all),
                      printable((place / ResultFolder::report_name).string()), fmt::join(names, ", ")));
}

void run(const AnalyzeArguments& args) {
    const AnalysisRequest request = request_of(args);
    if (request.displays.size() > 1) return side_by_side(args, request);
    const Outcome outcome = measure(args, request, request.displays.front(), args.output.text());
    if (outcome.interrupted)
        end_interrupted(args.output.text(), fmt::format("{} of {} measures", outcome.found.size(), request.wanted.size()));
    if (!outcome.problems.empty()) throw InputError(outcome.problems);
    if (args.work.json()) return print_json(request.wanted.size() == 1 ? outcome.found.front() : outcome.found);
    std::string text;
    for (const Json& measured : outcome.found) text += table_of(measured);
    print(fmt::format("{}\n{}: the report; the figures are in the same folder\n", text,
                      printable((outcome.folder.path() / ResultFolder::report_name).string())));
}

}  // namespace

CommandSpec analyze_command() {
    std::string list = "Measures:\n";
    for (const Measure& m : measures()) list += fmt::format("  {:<12} {}\n", m.name, m.says);
    return {.name = "analyze",
            .summary = "Measures a display: field of view, depth of field and more",
            .examples = list +
                        "Examples:\n  lfdsim analyze all display.toml --model monkey.blend -o report\n"
                        "  lfdsim analyze fov,dof display.toml --model monkey.blend --size 960x540 -o quick --json\n"
                        "  lfdsim analyze fov,mtf flat.toml curved.toml -o both\n"
                        "  lfdsim analyze fov display.toml --compare pickup -o pickups",
            .run = with_options<AnalyzeArguments>(run)};
}

}  // namespace lfdsim::cli
