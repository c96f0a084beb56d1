#include "report/folder/run_settings.h"

#include "analysis/core/figure_json.h"
#include "display/keys.h"
#include "files/description/display_file.h"

#include <fmt/chrono.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

namespace lfdsim {

namespace {

/// Returns a file's time by ISO 8601, to the nanosecond. The clock of files has another epoch than the system's.
std::string time_text(std::filesystem::file_time_type file_time) {
    const auto time = std::chrono::file_clock::to_sys(file_time);
    const auto second = std::chrono::floor<std::chrono::seconds>(time);
    const auto rest = std::chrono::duration_cast<std::chrono::nanoseconds>(time - second).count();
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:09}Z", fmt::gmtime(std::chrono::system_clock::to_time_t(second)), rest);
}

}  // namespace

Json stamp(const std::string& file) {
    std::error_code error;
    const auto changed = std::filesystem::last_write_time(file, error);
    if (error) return {{"file", file}};
    return {{"file", file}, {"bytes", std::filesystem::file_size(file, error)}, {"changed", time_text(changed)}};
}

Json content_stamp(const Display& display) {
    if (display.content.objects.empty()) return stamp(model_of(display));
    Json all = Json::array();
    for (const ContentFile& file : content_files(display)) all.push_back(stamp(file.path));
    return all;
}

std::vector<std::string> named_files(Display display, bool content) {
    std::vector<std::string> files;
    visit_files(display, [&](const std::string& key, const std::string& file) {
        if (!file.empty() && (content || !key.starts_with("content."))) files.push_back(file);
    });
    return files;
}

Json stamps(const std::vector<std::string>& files) {
    Json all = Json::array();
    for (const std::string& file : files)
        if (Json one = stamp(file); std::find(all.begin(), all.end(), one) == all.end()) all.push_back(std::move(one));
    return all;
}

bool files_unchanged(const Json& stamps) {
    return stamps.is_array() && std::all_of(stamps.begin(), stamps.end(), [](const Json& one) {
               return one.is_object() && one.contains("file") && one["file"].is_string() &&
                      one == stamp(one["file"].get<std::string>());
           });
}

namespace {

/// Returns evenly spaced values as first, last and count; others as a list; null where there are none.
Json series_json(const std::vector<double>& values) {
    if (values.empty()) return Json();
    const double step = (values.back() - values.front()) / double(std::max<std::size_t>(values.size() - 1, 1));
    for (std::size_t k = 0; k < values.size(); ++k)
        if (!(std::abs(values[k] - (values.front() + double(k) * step)) <= 1e-6 * std::abs(step))) return numbers_json(values);
    return {{"from", values.front()}, {"to", values.back()}, {"count", values.size()}};
}

}  // namespace

Json run_settings(const Subject& subject, const std::string& version) {
    const AnalysisOptions& options = subject.options();
    std::vector<std::string> files = named_files(subject.display(), true);
    if (subject.has_scene()) files.insert(files.end(), subject.scene().files().begin(), subject.scene().files().end());
    return {{"lfdsim", version},
            {"display", write_display(subject.display())},
            {"model", content_stamp(subject.display())},
            {"files", stamps(files)},
            {"angles_deg", series_json(options.angles_deg)},
            {"depths_mm", series_json(options.depths_mm)},
            {"viewing_distance_mm", subject.viewing_distance_mm()},
            {"eye_distance_mm", options.eye_distance_mm},
            {"wavelength_nm", options.wavelength_nm}};
}

}  // namespace lfdsim
