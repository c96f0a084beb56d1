#include "analysis/folder.h"

#include "image/file.h"
#include "image/image_file.h"

#include <fmt/format.h>
#include <cmath>
#include <fstream>
#include <iterator>

namespace lfdsim {
namespace fs = std::filesystem;
namespace {

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

Json to_json(const std::vector<double>& values) {
    Json json = Json::array();
    for (const double x : values) json.push_back(std::isfinite(x) ? Json(x) : Json());
    return json;
}

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

ResultFolder::ResultFolder(fs::path path, Json settings) : path_(std::move(path)), settings_(std::move(settings)) {
    std::error_code error;
    if (path_.empty()) throw InputError("--output", "the name is empty; give a folder");
    fs::create_directories(path_, error);
    if (!fs::is_directory(path_)) throw InputError(path_.string(), "is not a folder and cannot be made one");
    detail::check_replaceable(path_ / "report.html");
}

Json ResultFolder::read(const Measure& measure) const {
    const fs::path path = path_ / (std::string(measure.name) + ".json");
    std::ifstream file(path, std::ios::binary);
    try {
        return Json::parse(file);
    } catch (const Json::exception& e) {
        throw InputError(path.string(), fmt::format("is not what a measure leaves: {}", e.what()));
    }
}

bool ResultFolder::has(const Measure& measure) const {
    if (!fs::is_regular_file(path_ / (std::string(measure.name) + ".json"))) return false;
    try {
        const Json json = read(measure);
        if (!json.is_object() || json.value("settings", Json()) != settings_) return false;
        for (const Json& file : json.at("report").at("files"))
            if (!fs::is_regular_file(path_ / file.get<std::string>())) return false;
        return true;
    } catch (const std::exception&) {
        return false;  // cut off or changed by hand: it is measured again
    }
}

Json ResultFolder::write(const Measure& measure, const Result& result, double seconds) const {
    Json files = Json::array(), pictures = Json::array();
    for (const DataTable& table : result.tables) {
        write_text(table.name + ".csv", csv(table));
        files.push_back(table.name + ".csv");
    }
    for (const NamedPicture& picture : result.pictures) {
        const std::string name = picture.name + ".png";
        write_image(path_ / name, picture.image, {8, Encoding::srgb, {{"Software", "lfdsim"}, {"Description", picture.caption}}});
        files.push_back(name);
        pictures.push_back({{"file", name}, {"caption", picture.caption}});
    }
    Json findings = Json::array();
    for (const Finding& f : result.findings)
        findings.push_back({{"what", f.what},
                            {"unit", f.unit},
                            {"measured", to_json(f.measured)},
                            {"theory", to_json(f.theory)},
                            {"remark", f.remark}});
    Json json = result.figures;
    json["report"] = {{"measure", measure.name},   {"title", measure.title}, {"says", measure.says},
                      {"source", measure.source},  {"seconds", seconds},     {"findings", findings},
                      {"remarks", result.remarks}, {"pictures", pictures},   {"files", files}};
    json["settings"] = settings_;
    write_text(std::string(measure.name) + ".json", dump(json));
    return json;
}

void ResultFolder::write_text(const std::string& name, const std::string& text) const {
    detail::OutputFile file(path_ / name);
    file.write(text.data(), text.size());
    file.commit();
}

}  // namespace lfdsim
