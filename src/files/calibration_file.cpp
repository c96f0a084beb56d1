#include <algorithm>
#include <cmath>
#include <set>

#include "files/calibration.h"
#include "files/lens_json.h"
#include "files/nearest.h"
#include "model/keys.h"
#include "model/printable.h"

// visual.json of Looking Glass displays: numbers by name, plain or as {"value": x}; newer ones with subpixelCells.
namespace lfdsim {
namespace {

constexpr std::string_view own_keys[] = {"pitch", "slope", "DPI", "screenW", "screenH", "viewCone"};
constexpr Range pitch_range{1, 1e4}, center_range{-1e6, 1e6}, dpi_range{1, 1e5}, screen_range{1, 1e5}, cone_range{1, 170},
    place_range{-1, 1};
constexpr double flattest = 0.1, steepest = 1e6;  // slopes: lenses are turned by 84 degrees at most
constexpr std::size_t most_cells = 16;

class CalibrationReader : JsonReader {
  public:
    explicit CalibrationReader(std::string_view file) : JsonReader(file) {}

    Calibration read(const LensJson& json) {
        all = &json;
        c.pitch_per_inch = required("pitch", pitch_range);
        const LensJson& slope = value("slope");
        c.slope = in_range(slope, "slope", {-steepest, steepest});
        if (slope.is_number() && std::abs(c.slope) < flattest)
            refuse("slope", "is {}; its size must be at least {}", c.slope, flattest);
        c.center = required("center", center_range);
        c.dpi = required("DPI", dpi_range);
        c.pixels = {whole("screenW", screen_range), whole("screenH", screen_range)};
        if (!value("viewCone").is_null()) c.view_cone_deg = required("viewCone", cone_range);
        c.flip_image_x = flag("flipImageX");
        c.flip_subpixels = flag("flipSubp");
        read_cells();
        read_names();
        report();
        return std::move(c);
    }

  private:
    /// What stands under a key, without the object around it. Null: nothing does.
    const LensJson& value(const std::string& key) {
        known.insert(key);
        const LensJson& found = member(*all, key);
        return found.is_object() ? member(found, "value") : found;
    }

    double required(const std::string& key, const Range& range) { return in_range(value(key), key, range); }

    double in_range(const LensJson& json, const std::string& place, const Range& range) {
        if (json.is_null()) {
            refuse(place, "is missing; a calibration has it, {}", range.text());
            return 0;
        }
        const double x = number(json, place);
        if (json.is_number() && !range.contains(x)) refuse(place, "is {}; allowed is {}", x, range.text());
        return x;
    }

    std::int64_t whole(const std::string& key, const Range& range) {
        const double x = required(key, range);
        if (!range.contains(x)) return std::int64_t(range.low);
        if (x != std::floor(x)) refuse(key, "is {}; a number of pixels is whole", x);
        return std::int64_t(x);
    }

    bool flag(const std::string& key, bool absent = false) {
        const LensJson& json = value(key);
        if (json.is_null()) return absent;
        if (json.is_boolean()) return json.get<bool>();
        return in_range(json, key, {0, 1}) >= 0.5;
    }

    void read_cells() {
        known.insert("subpixelCells");
        const LensJson& cells = member(*all, "subpixelCells");
        const LensJson& mode = value("CellPatternMode");
        const bool has_mode = !mode.is_null();
        const std::int64_t pattern = has_mode ? whole("CellPatternMode", {0, double(std::size(cell_patterns) - 1)}) : 0;
        if (cells.is_null() || (cells.is_array() && cells.empty())) {
            if (pattern > 0)
                refuse("CellPatternMode", "is {}, but there are no subpixelCells; give {}, or mode 0", pattern,
                       cell_patterns[pattern].cells);
            return;
        }
        if (!cells.is_array() || cells.size() > most_cells)
            return refuse("subpixelCells", "is no list of 1 to {} cells", most_cells);
        const std::size_t needed = std::size_t(cell_patterns[pattern].cells);
        if (!has_mode && cells.size() > 1)
            refuse("CellPatternMode", "is missing, and there are {} subpixelCells; give the mode, 0 to {}", cells.size(),
                   std::size(cell_patterns) - 1);
        if (cells.size() < needed)
            return refuse("subpixelCells", "has {}, but CellPatternMode {} repeats {}; give as many, or another mode", cells.size(),
                          pattern, needed);
        for (std::size_t k = 0; k < needed; ++k) c.cells.push_back(read_cell(cells[k], fmt::format("subpixelCells[{}]", k)));
        c.cell_pattern = int(pattern);
        if (cells.size() > needed)
            c.notes.push_back(fmt::format("Only the first {} of {} subpixelCells are in use, by CellPatternMode {}.", needed,
                                          cells.size(), pattern));
    }

    CellPlaces read_cell(const LensJson& json, const std::string& place) {
        CellPlaces places{};
        constexpr const char* keys[3][2] = {{"ROffsetX", "ROffsetY"}, {"GOffsetX", "GOffsetY"}, {"BOffsetX", "BOffsetY"}};
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t k = 0; k < 2; ++k) {
                const char* key = keys[channel][k];
                const LensJson& found = member(json, key);
                places[channel][k] =
                    in_range(found.is_object() ? member(found, "value") : found, fmt::format("{}.{}", place, key), place_range);
            }
        return places;
    }

    // What is said and what is not read.
    void read_names() {
        const LensJson& serial = value("serial");
        if (serial.is_string()) c.serial = shortened(serial.get<std::string>());
        const LensJson& version = value("configVersion");
        if (!version.is_null() && version != "1.0" && version != "3.0")
            c.notes.push_back(fmt::format("configVersion is {}, not 1.0 or 3.0; read like these.", word_of(version)));
        if (!flag("invView", true))
            c.notes.push_back("invView is 0: views are numbered from right to left. Where the lenses stand does not depend on it.");
        if (flag("flipImageY"))
            c.notes.push_back(
                "flipImageY is not read: where the lenses stand does not depend on it; turn the content over instead.");
        std::vector<std::string> others;
        for (const auto& [key, content] : all->items()) {
            const LensJson& of = content.is_object() ? member(content, "value") : content;
            if (!known.contains(key) && of != 0 && others.size() < 10) others.push_back(shortened(key));
        }
        if (!others.empty()) c.notes.push_back(fmt::format("Not read: {}.", fmt::join(others, ", ")));
    }

    const LensJson* all = nullptr;
    Calibration c;
    std::set<std::string, std::less<>> known;  // keys
};

}  // namespace

int cell_of(int pattern, std::int64_t column, std::int64_t row_from_bottom) {
    const std::int64_t x = column, y = row_from_bottom;
    switch (pattern) {
        case 1:
            return int((x + y) % 2);
        case 2:
            return int(x % 2);
        case 3:
            return int((y + 2 * (x % 2)) % 4);
        case 4:
            return int(y % 2);
        default:
            return 0;
    }
}

bool is_calibration(std::string_view text, std::string_view name) {
    const LensJson json = parse_lens_json(text, name);
    return std::any_of(std::begin(own_keys), std::end(own_keys),
                       [&](std::string_view key) { return !member(json, key).is_null(); });
}

Calibration parse_calibration(std::string_view text, std::string_view name) {
    const LensJson json = parse_lens_json(text, name);
    if (!json.is_object()) throw InputError(std::string(name), "is no calibration: it holds no values by name");
    return CalibrationReader(name).read(json);
}

}  // namespace lfdsim
