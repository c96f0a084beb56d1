#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <span>

#include "base/printable.h"
#include "display/keys.h"
#include "files/calibration/calibration.h"
#include "files/description/json_text.h"
#include "files/description/nearest.h"
#include "files/lenses/lens_json.h"

// Reads visual.json of Looking Glass displays: numbers by name, plain or as {"value": x}; newer files also have subpixelCells. The
// first letter of a key may be small or capital.
namespace lfdsim {
namespace {

constexpr std::string_view own_keys[] = {"pitch", "slope", "DPI", "screenW", "screenH", "viewCone"};
constexpr Range pitch_range{1, 1e4}, center_range{-1e6, 1e6}, dpi_range{1, 1e5}, screen_range{1, 1e5}, cone_range{1, 170},
    place_range{-1, 1};
constexpr double flattest = 0.1, steepest = 1e6;  // slopes: lenses are rotated by 84 degrees at most, atan(1/0.1)
constexpr std::size_t most_cells = 16;
constexpr std::size_t enough_keys = 3;  // of own_keys, by which a calibration is recognised within other data
constexpr int deepest_nesting = 8;      // levels of objects, lists and texts that are searched
constexpr std::size_t most_found = 10;  // calibrations; further ones are not searched

/// Returns the key with its first letter in the other case.
std::string with_other_case(std::string key) {
    char& c = key[0];
    c = c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
    return key;
}

/// Returns a member by its key, or else by the key whose first letter is in the other case: "cellPatternMode" for
/// "CellPatternMode". `found_as` becomes the key that the file has.
const LensJson& named(const LensJson& json, const std::string& key, std::string& found_as) {
    found_as = key;
    if (const LensJson& exact = member(json, key); !exact.is_null()) return exact;
    const std::string turned = with_other_case(key);
    const LensJson& found = member(json, turned);
    if (!found.is_null()) found_as = turned;
    return found;
}
const LensJson& named(const LensJson& json, const std::string& key) {
    std::string found_as;
    return named(json, key, found_as);
}

/// Returns how many of own_keys a value has.
std::size_t own_keys_of(const LensJson& json) {
    return std::size_t(std::count_if(std::begin(own_keys), std::end(own_keys),
                                     [&](std::string_view key) { return !named(json, std::string(key)).is_null(); }));
}

/// Returns the value under a key, without the object {"value": x} around it; null if there is none.
const LensJson& value_of(const LensJson& json, const std::string& key) {
    const LensJson& found = named(json, key);
    return found.is_object() ? member(found, "value") : found;
}

/// Returns the number, word or flag under a key; null where there is a list or an object without "value".
const LensJson& plain(const LensJson& json, const std::string& key) {
    static const LensJson nothing;
    const LensJson& value = value_of(json, key);
    return value.is_structured() ? nothing : value;
}

/// The keys of a cell's places: x and y of red, green and blue.
constexpr const char* offset_keys[] = {"ROffsetX", "ROffsetY", "GOffsetX", "GOffsetY", "BOffsetX", "BOffsetY"};

/// Whether two objects mean the same by their plain values under these keys: a flag that is missing is false, or 0.
bool same(std::span<const char* const> keys, const LensJson& a, const LensJson& b) {
    const auto meant = [](const LensJson& x) {
        return x.is_null() ? LensJson(0) : x.is_boolean() ? LensJson(int(x.get<bool>())) : x;
    };
    return std::all_of(keys.begin(), keys.end(), [&](const char* key) { return meant(plain(a, key)) == meant(plain(b, key)); });
}

/// A calibration within a text. The text may nest deeply, so no value is copied or compared as a whole.
struct CalibrationValues {
    std::string place;                     // "devices[0].calibration"; empty: the whole text
    std::shared_ptr<const LensJson> text;  // that contains it
    const LensJson* json;                  // the calibration, in `text`

    /// Whether another calibration has the same values, of all that the result depends on: that of the same device.
    bool same_unit(const LensJson& other) const {
        constexpr const char* keys[] = {"serial",   "pitch",      "slope",    "center",         "DPI", "screenW", "screenH",
                                        "viewCone", "flipImageX", "flipSubp", "CellPatternMode"};
        const LensJson &cells = value_of(*json, "subpixelCells"), &others = value_of(other, "subpixelCells");
        if (!same(keys, *json, other) || cells.size() != others.size()) return false;
        for (std::size_t k = 0; cells.is_array() && others.is_array() && k < cells.size(); ++k)
            if (!same(offset_keys, cells[k], others[k])) return false;
        return true;
    }
};

/// Finds all calibrations within a value: in objects, lists, and texts that are JSON themselves.
void find_within(const std::shared_ptr<const LensJson>& text, const LensJson& json, std::string_view name, const std::string& place,
                 int depth, std::vector<CalibrationValues>& found) {
    if (depth > deepest_nesting || found.size() >= most_found) return;
    if (own_keys_of(json) >= enough_keys) {
        const auto same = [&](const CalibrationValues& other) { return other.same_unit(json); };
        if (std::none_of(found.begin(), found.end(), same)) found.push_back({place, text, &json});
        return;
    }
    if (json.is_string()) {
        const auto& word = json.get_ref<const std::string&>();
        if (word.find('{') == word.npos) return;
        const UniqueKeys<LensJson> unique(fmt::format("{}: {}: ", name, place));
        const auto inside = std::make_shared<const LensJson>(LensJson::parse(word, unique, false));  // nothing, where it is no JSON
        if (!inside->is_discarded()) find_within(inside, *inside, name, place, depth + 1, found);
    }
    if (json.is_object())
        for (const auto& [key, content] : json.items())
            find_within(text, content, name, place.empty() ? shortened(key) : place + "." + shortened(key), depth + 1, found);
    if (json.is_array())
        for (std::size_t i = 0; i < json.size(); ++i)
            find_within(text, json[i], name, fmt::format("{}[{}]", place, i), depth + 1, found);
}

/// Returns the different calibrations in a text. A text whose top level has at least one of own_keys counts as one, so that the
/// keys that are missing are named.
std::vector<CalibrationValues> calibrations_in(std::string_view text, std::string_view name) {
    const auto json = std::make_shared<const LensJson>(parse_lens_json(text, name));
    std::vector<CalibrationValues> found;
    find_within(json, *json, name, "", 0, found);
    if (found.empty() && (own_keys_of(*json) > 0)) found.push_back({"", json, json.get()});
    return found;
}

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
    /// Returns the value of a key, without the object {"value": x} around it; null if there is none. The key then counts as read.
    const LensJson& value(const std::string& key) {
        std::string found_as;
        const LensJson& found = named(*all, key, found_as);
        if (known.insert(found_as).second) refuse_twice(*all, key, key);
        return found.is_object() ? member(found, "value") : found;
    }

    /// Refuses a key that an object has in both cases.
    void refuse_twice(const LensJson& json, const std::string& key, const std::string& place) {
        const std::string other = with_other_case(key);
        if (!member(json, key).is_null() && !member(json, other).is_null())
            refuse(place, "is given twice, as {} and {}; leave one of them out", key, other);
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

    /// Returns a whole number in a range; refuses others, and returns the least or the integral part.
    std::int64_t whole(const std::string& key, const Range& range) {
        const double x = required(key, range);
        if (!range.contains(x)) return std::int64_t(range.low);
        if (x != std::floor(x)) refuse(key, "is {}; give a whole number of pixels", x);
        return std::int64_t(x);
    }

    bool flag(const std::string& key, bool absent = false) {
        const LensJson& json = value(key);
        if (json.is_null()) return absent;
        if (json.is_boolean()) return json.get<bool>();
        return in_range(json, key, {0, 1}) >= 0.5;
    }

    /// Reads the cells that the pattern needs; without cells the panel has stripes.
    void read_cells() {
        const LensJson& cells = value("subpixelCells");
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
            return refuse("subpixelCells", "is not a list of 1 to {} cells", most_cells);
        const std::size_t needed = std::size_t(cell_patterns[pattern].cells);
        if (!has_mode && cells.size() > 1)
            refuse("CellPatternMode", "is missing, and there are {} subpixelCells; give the mode, 0 to {}", cells.size(),
                   std::size(cell_patterns) - 1);
        if (cells.size() < needed)
            return refuse("subpixelCells", "has {}, but CellPatternMode {} repeats {}; give that number, or another mode",
                          cells.size(), pattern, needed);
        for (std::size_t k = 0; k < needed; ++k) c.cells.push_back(read_cell(cells[k], fmt::format("subpixelCells[{}]", k)));
        c.cell_pattern = int(pattern);
        if (cells.size() > needed)
            c.notes.push_back(fmt::format("Only the first {} of {} subpixelCells are used, as CellPatternMode {} says.", needed,
                                          cells.size(), pattern));
    }

    CellPlaces read_cell(const LensJson& json, const std::string& place) {
        CellPlaces places{};
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t k = 0; k < 2; ++k) {
                const char* key = offset_keys[2 * channel + k];
                refuse_twice(json, key, fmt::format("{}.{}", place, key));
                places[channel][k] = in_range(value_of(json, key), fmt::format("{}.{}", place, key), place_range);
            }
        return places;
    }

    // Reads the serial, and notes what has no effect here or is not read.
    void read_names() {
        const LensJson& serial = value("serial");
        if (serial.is_string()) c.serial = shortened(serial.get<std::string>());
        const LensJson& version = value("configVersion");
        if (!version.is_null() && version != "1.0" && version != "3.0")
            c.notes.push_back(fmt::format("configVersion is {}, not 1.0 or 3.0; read like these.", word_of(version)));
        if (!flag("invView", true))
            c.notes.push_back(
                "invView is 0: views are numbered from right to left. The positions of the lenses do not depend on it.");
        if (flag("flipImageY"))
            c.notes.push_back(
                "flipImageY is not read: the positions of the lenses do not depend on it; turn the content over instead.");
        std::vector<std::string> others;
        for (const auto& [key, content] : all->items()) {
            const LensJson& of = content.is_object() ? member(content, "value") : content;
            if (!known.contains(key) && of != 0 && others.size() < 10) others.push_back(shortened(key));
        }
        if (!others.empty()) c.notes.push_back(fmt::format("Not read: {}.", fmt::join(others, ", ")));
    }

    const LensJson* all = nullptr;
    Calibration c;
    std::set<std::string, std::less<>> known;  // keys that have been read
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

bool is_calibration(std::string_view text, std::string_view name) { return !calibrations_in(text, name).empty(); }

Calibration parse_calibration(std::string_view text, std::string_view name) {
    const std::vector<CalibrationValues> found = calibrations_in(text, name);
    if (found.empty())
        throw InputError(std::string(name),
                         "is not a calibration: it has no values such as pitch, slope, center, DPI, screenW and screenH");
    if (found.size() > 1) {
        std::vector<std::string> places;
        for (const CalibrationValues& each : found) {
            const LensJson& serial = plain(*each.json, "serial");
            places.push_back(serial.is_string() ? fmt::format("{} ({})", each.place, word_of(serial)) : each.place);
        }
        throw InputError(std::string(name), fmt::format("contains {} calibrations: {}; save that of the display in a separate file",
                                                        found.size(), fmt::join(places, ", ")));
    }
    const auto& [place, owner, json] = found.front();
    Calibration made = CalibrationReader(place.empty() ? std::string(name) : fmt::format("{}: {}", name, place)).read(*json);
    made.place = place;
    if (!place.empty()) made.notes.insert(made.notes.begin(), fmt::format("The calibration is under {} in the file.", place));
    return made;
}

}  // namespace lfdsim
