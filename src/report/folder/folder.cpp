#include "report/folder/folder.h"

#include "analysis/core/figure_json.h"
#include "base/json_utf8.h"
#include "base/output_file.h"
#include "image/formats/apng.h"
#include "image/formats/image_file.h"
#include "image/scaled.h"
#include "report/folder/run_settings.h"
#include "report/plots/svg.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace lfdsim {
namespace fs = std::filesystem;
namespace {

/// Returns a table as CSV with nine digits; cells without a finite value are empty.
std::string csv(const DataTable& table) {
    std::string text;
    for (const Column& c : table.columns) text += (text.empty() ? "" : ",") + c.name;
    text += "\n";
    const std::size_t rows = table.columns.empty() ? 0 : table.columns.front().values.size();
    for (std::size_t r = 0; r < rows; ++r) {
        for (std::size_t c = 0; c < table.columns.size(); ++c) {
            const double value = table.columns[c].values[r];
            text += (c > 0 ? "," : "") + (std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string());
        }
        text += "\n";
    }
    return text;
}

/// Writes an animation, reduced to 960 columns and 8 million pixels over all frames, which take some megabytes: a report contains
/// animations unchanged.
void write_small(const fs::path& path, const Animation& animation) {
    constexpr double most_pixels = 8e6, most_columns = 960;
    if (animation.frames.empty()) throw std::invalid_argument("an animation without frames");
    const Image& first = animation.frames.front();
    const double pixels = double(animation.frames.size()) * first.width * first.height;
    const double share = std::min({1., most_columns / first.width, std::sqrt(most_pixels / pixels)});
    std::vector<Image> frames;
    for (const Image& frame : animation.frames) frames.push_back(reduced(frame, std::max(1, int(share * first.width))));
    write_animation(path, frames, animation.seconds_per_frame);
}

/// Whether a measure may write a file of that name: NAME.json, NAME_curve.csv, NAME-white.png.
bool named_as_of(const Measure& measure, const fs::path& file) {
    const std::string name = file.filename(), kind = file.extension();
    const std::size_t end = measure.name.size();
    return name.starts_with(measure.name) && name.size() > end &&
           std::string_view("._-").find(name[end]) != std::string_view::npos &&
           (kind == ".json" || kind == ".csv" || kind == ".svg" || kind == ".png");
}

/// Returns the error for a file that lfdsim has not written.
InputError foreign(const fs::path& path) {
    return {path.string(), "is not a result of lfdsim and would be overwritten; give another folder, or --replace"};
}

}  // namespace

Json to_json(const std::vector<Finding>& findings) {
    Json all = Json::array();
    for (const Finding& f : findings)
        all.push_back({{"what", f.what},
                       {"unit", f.unit},
                       {"measured", numbers_json(f.measured)},
                       {"error", numbers_json(f.error)},
                       {"theory", numbers_json(f.theory)},
                       {"remark", f.remark}});
    return all;
}

ResultFolder::ResultFolder(fs::path path, Json settings) : path_(std::move(path)), settings_(std::move(settings)) {
    std::error_code error;
    fs::create_directories(path_, error);
    if (!fs::is_directory(path_)) throw InputError(path_.string(), "is not a folder and cannot be made one");
    check_replaceable(path_ / report_name);
}

Json ResultFolder::read(const Measure& measure) const {
    const fs::path path = path_ / (std::string(measure.name) + ".json");
    std::ifstream file(path, std::ios::binary);
    try {
        return Json::parse(file);
    } catch (const Json::exception& e) {
        throw InputError(path.string(), fmt::format("is not the result of a measure: {}", e.what()));
    }
}

bool ResultFolder::has(const Measure& measure) const {
    if (const Json theirs = settings_of(measure); !theirs.is_object() || !different_settings(theirs).empty()) return false;
    try {
        const Json json = read(measure);
        for (const Json& file : json.at("report").at("files")) {
            const fs::path name = file.get<std::string>();
            if (name != name.filename() || !fs::is_regular_file(path_ / name)) return false;
        }
        return true;
    } catch (const std::exception&) {
        return false;  // cut off or changed by hand: it is measured again
    }
}

// The files of a result may be fewer than those of this run, since a measure without content reads no model: they must be as they
// were.
std::vector<std::string> ResultFolder::different_settings(const Json& theirs) const {
    std::vector<std::string> keys;
    for (const auto& [key, value] : settings_.items())
        if (key == "files" ? !files_unchanged(theirs.value(key, Json::array())) : theirs.value(key, Json()) != value)
            keys.push_back(key);
    return keys;
}

/// Returns the settings of a measure's result; null if there is no result.
Json ResultFolder::settings_of(const Measure& measure) const {
    if (!fs::is_regular_file(path_ / (std::string(measure.name) + ".json"))) return {};
    try {
        const Json json = read(measure);
        return json.is_object() ? json.value("settings", Json()) : Json();
    } catch (const std::exception&) {
        return {};
    }
}

std::vector<std::string> ResultFolder::others() const {
    std::vector<std::string> all;
    for (const Measure& m : measures()) {
        const Json theirs = settings_of(m);
        if (!theirs.is_object()) continue;
        if (const std::vector<std::string> keys = different_settings(theirs); !keys.empty())
            all.push_back(fmt::format("{} ({})", m.name, fmt::join(keys, ", ")));
    }
    return all;
}

void ResultFolder::remove_others() const {
    bool any = false;
    for (const Measure& m : measures()) {
        const Json theirs = settings_of(m);
        if (!theirs.is_object() || different_settings(theirs).empty()) continue;
        any = true;
        std::vector<std::string> names{std::string(m.name) + ".json"};  // first: a measure without it is incomplete
        try {
            const Json json = read(m);
            for (const Json& file : json.at("report").at("files")) names.push_back(file.get<std::string>());
        } catch (const std::exception&) {  // NAME.json was changed by hand: the other files are not known
        }
        for (const fs::path name : names)
            if (std::error_code error; name == name.filename() && fs::is_regular_file(fs::symlink_status(path_ / name, error)))
                fs::remove(path_ / name, error);
    }
    if (std::error_code error; any) fs::remove(path_ / report_name, error);
}

// Whether a file of the folder, named like those of a measure, is one that the measure's result lists.
bool ResultFolder::wrote(const Measure& measure, const fs::path& name) const {
    try {
        const Json json = read(measure), files = json.at("report").at("files");
        return name == std::string(measure.name) + ".json" || std::find(files.begin(), files.end(), name.string()) != files.end();
    } catch (const std::exception&) {
        return false;
    }
}

void ResultFolder::keep_report_apart(const fs::path& folder, bool replace) {
    const fs::path path = folder / report_name;
    std::error_code none;
    if (replace || !fs::exists(fs::symlink_status(path, none))) return;
    std::ifstream file(path, std::ios::binary);
    std::string head(1024, '\0');
    file.read(head.data(), std::streamsize(head.size()));
    if (head.find(report_mark) == head.npos) throw foreign(path);
}

void ResultFolder::keep_apart(std::span<const Measure* const> wanted, bool resume, bool replace) const {
    if (replace) return remove_others();
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(path_, none)) {
        const fs::path name = entry.path().filename();
        for (const Measure* m : wanted)
            if (named_as_of(*m, name) && !wrote(*m, name) && !(resume && name.extension() != ".json")) throw foreign(entry.path());
    }
    if (const std::vector<std::string> there = others(); !there.empty())
        throw InputError(path_.string(),
                         fmt::format("contains results of other settings: {}; give another folder, or --replace to remove them",
                                     fmt::join(there, ", ")));
    keep_report_apart(path_, replace);
}

Json ResultFolder::write(const Measure& measure, const Result& result, double seconds) const {
    // Tables, plots, maps, pictures and animations, each with its file's name and title or caption.
    Json files = Json::array(), plots = Json::array(), maps = plots, pictures = plots, animations = plots;
    const auto keep = [&](Json& list, const std::string& name, const char* key, const std::string& text) {
        files.push_back(name);
        list.push_back({{"file", name}, {key, text}});
    };
    for (const DataTable& table : result.tables) {
        write_text(table.name + ".csv", csv(table));
        files.push_back(table.name + ".csv");
    }
    for (const Plot& plot : result.plots) {
        write_text(plot.name + ".svg", svg(plot));
        keep(plots, plot.name + ".svg", "title", plot.title);
    }
    for (const ColourMap& map : result.maps) {
        write_text(map.name + ".svg", svg(map));
        keep(maps, map.name + ".svg", "title", map.title);
    }
    for (const NamedPicture& picture : result.pictures) {
        const std::string name = picture.name + ".png";
        write_image(path_ / name, picture.image, {8, Encoding::srgb, {{"Software", "lfdsim"}, {"Description", picture.caption}}});
        keep(pictures, name, "caption", picture.caption);
    }
    for (const Animation& animation : result.animations) {
        write_small(path_ / (animation.name + ".png"), animation);
        keep(animations, animation.name + ".png", "caption", animation.caption);
    }
    // NAME.json, last.
    Json json = result.figures;
    json["notes"] = result.notes;
    json["report"] = {{"measure", measure.name},   {"title", measure.title},   {"says", measure.says},
                      {"source", measure.source},  {"seconds", seconds},       {"findings", to_json(result.findings)},
                      {"remarks", result.remarks}, {"plots", plots},           {"maps", maps},
                      {"pictures", pictures},      {"animations", animations}, {"files", files}};
    json["settings"] = settings_;
    write_text(std::string(measure.name) + ".json", json_file(json));
    return json;
}

void ResultFolder::write_text(const std::string& name, const std::string& text) const { write_file(path_ / name, text); }

}  // namespace lfdsim
