#include "analysis/core/measure.h"
#include "analysis/pictures/views.h"
#include "base/json_utf8.h"
#include "base/seconds.h"
#include "engine/devices/devices.h"
#include "engine/devices/memory.h"
#include "files/description/display_file.h"
#include "python/arrays.h"
#include "python/content.h"
#include "python/parts.h"
#include "python/work.h"
#include "report/folder/folder.h"
#include "report/folder/folder_lock.h"
#include "report/folder/run_settings.h"
#include "report/pages/report.h"
#include "report/plots/svg.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <cmath>
#include <memory>

namespace lfdsim::python {
namespace {

namespace nb = nanobind;

/// What one measure found of one display.
struct Measured {
    const Measure* measure;
    Display display;
    AnalysisOptions options;
    Result result;
    double seconds;
    std::vector<std::string> notes;  // what was dropped from the model's files or repaired

    /// The tables: {"table": {"column": values}}.
    nb::typed<nb::dict, std::string, nb::typed<nb::dict, std::string, Numbers>> tables() const {
        nb::dict all;
        for (const DataTable& table : result.tables) {
            nb::dict columns;
            for (const Column& column : table.columns) columns[column.name.c_str()] = array_of(column.values);
            all[table.name.c_str()] = columns;
        }
        return all;
    }
    /// Curves and maps as SVG: {"plot": text}.
    nb::typed<nb::dict, std::string, std::string> plots() const {
        nb::dict all;
        for (const Plot& plot : result.plots) all[plot.name.c_str()] = svg(plot);
        for (const ColourMap& map : result.maps) all[map.name.c_str()] = svg(map);
        return all;
    }
    /// The pictures: {"picture": (caption, array)}.
    nb::typed<nb::dict, std::string, nb::typed<nb::tuple, std::string, Pictured>> pictures() const {
        nb::dict all;
        for (const NamedPicture& picture : result.pictures)
            all[picture.name.c_str()] = nb::make_tuple(picture.caption, array_of(Image(picture.image)));
        return all;
    }
    /// The findings as a list in JSON; numbers that are not finite become null.
    std::string findings() const { return json_utf8(to_json(result.findings)); }

    /// Writes the files and the report that `lfdsim analyze` writes. Throws InputError for a folder of other results, unless
    /// `replace`.
    void save(const std::string& place, const std::string& command, bool replace) const {
        run(nb::none(), [&](Job&) {
            const Subject subject(display, {}, options);
            const FolderLock lock(place);
            const ResultFolder folder(place, run_settings(subject, LFDSIM_VERSION));
            folder.keep_apart(std::array{measure}, false, replace);
            folder.write(*measure, result, seconds);
            folder.write_text(ResultFolder::report_name,
                              report_html(subject, folder, {command, write_display(display), {measure}}));
        });
    }
};

/// Throws InputError for options that measures do not check themselves.
void check_options(const AnalysisOptions& options) {
    std::vector<Problem> problems;
    const auto rising = [&](const char* name, const std::vector<double>& values, double most) {
        for (std::size_t k = 0; k < values.size(); ++k)
            if (!(std::abs(values[k]) <= most && (k == 0 || values[k] > values[k - 1])))
                return problems.push_back(
                    {name, fmt::format("has {} at place {}; give rising values within {} to {}", values[k], k, -most, most)});
        if (values.size() > AnalysisLimits::values)
            problems.push_back({name, fmt::format("has {} values, allowed are {}", values.size(), AnalysisLimits::values)});
    };
    const auto positive = [&](const char* name, double value, double most) {
        if (!(value > 0 && value <= most))
            problems.push_back({name, fmt::format("is {}; allowed is more than 0, up to {}", value, most)});
    };
    rising("angles_deg", options.angles_deg, AnalysisLimits::angle_deg);
    rising("depths_mm", options.depths_mm, AnalysisLimits::depth_mm);
    if (options.viewing_distance_mm)
        positive("viewing_distance_mm", *options.viewing_distance_mm, AnalysisLimits::viewing_distance_mm);
    positive("eye_distance_mm", options.eye_distance_mm, AnalysisLimits::eye_distance_mm);
    positive("wavelength_nm", options.wavelength_nm, AnalysisLimits::wavelength_nm);
    if (!problems.empty()) throw InputError(problems);
}

/// Runs the measure of a name; options and display are checked before the model is read. Throws InputError.
std::shared_ptr<Measured> analyze(const Display& display, const std::string& name, AnalysisOptions options,
                                  const nb::object& progress) {
    const Measure& measure = measure_named(name);
    check_options(options);
    choose_device(options.device, "");
    auto made = std::make_shared<Measured>(Measured{&measure, display, std::move(options), {}, 0, {}});
    run(progress, [&](Job& job) {
        require_needs(measure, display);
        std::optional<ContentScene> scene;
        if (measure.needs.scene) {
            const Geometry geometry = resolve(display);
            if (display.content.depth_mm) refuse_depth_in_lenses(geometry, *display.content.depth_mm, "content.depth_mm");
            scene = scene_of(display, geometry, made->notes, job);
        }
        Subject subject(display, std::move(scene), made->options);
        job.stage("analyzing", measure.steps(subject));
        const auto start = std::chrono::steady_clock::now();
        made->result = measure.run(subject, job);
        made->seconds = seconds_since(start);
    });
    return made;
}

/// The measures in the order of the report: [(name, title, meaning, source)].
nb::typed<nb::list, nb::typed<nb::tuple, std::string, std::string, std::string, std::string>> all_measures() {
    nb::list all;
    for (const Measure& m : measures())
        all.append(nb::make_tuple(std::string(m.name), std::string(m.title), std::string(m.says), std::string(m.source)));
    return all;
}

}  // namespace

void add_analyze(nb::module_& m) {
    nb::class_<Measured>(m, "Measured")
        .def("figures", [](const Measured& r) { return json_utf8(r.result.figures); })
        .def("notes", [](const Measured& r) { return json_utf8(r.result.notes); })
        .def("findings", &Measured::findings)
        .def("remarks", [](const Measured& r) { return r.result.remarks; })
        .def("warnings", [](const Measured& r) { return r.notes; })
        .def("seconds", [](const Measured& r) { return r.seconds; })
        .def("tables", &Measured::tables)
        .def("plots", &Measured::plots)
        .def("pictures", &Measured::pictures)
        .def("save", &Measured::save, nb::arg("folder"), nb::arg("command"), nb::arg("replace"));
    m.def(
        "analyze",
        [](const Display& display, const std::string& measure, std::vector<double> angles_deg, std::vector<double> depths_mm,
           std::optional<double> viewing_distance_mm, double eye_distance_mm, double wavelength_nm, int threads,
           const std::string& device, const nb::object& progress) {
            return analyze(
                display, measure,
                {std::move(angles_deg), std::move(depths_mm), viewing_distance_mm, eye_distance_mm, wavelength_nm, threads, device},
                progress);
        },
        nb::arg("display"), nb::arg("measure"), nb::arg("angles_deg"), nb::arg("depths_mm"), nb::arg("viewing_distance_mm").none(),
        nb::arg("eye_distance_mm"), nb::arg("wavelength_nm"), nb::arg("threads"), nb::arg("device"), nb::arg("progress").none());
    m.def("measures", all_measures);
}

}  // namespace lfdsim::python
