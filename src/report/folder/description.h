// A resolved display as JSON and as rows of a table: every key, every length, the theory. Floor 4.
#pragma once
#include "analysis/core/result.h"
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>
#include <vector>

namespace lfdsim {

/// A key of the description with its value.
struct Setting {
    std::string table, key;  // "lens.surface.0", "conic"; the table is empty at the top level
    Json value;              // null: absent
    bool is_default;         // the value is the one that holds without the key
    std::string absent;      // what holds without the key, in words, where its default does not say it
};
/// Returns all keys of a display, in the order of a description.
std::vector<Setting> settings(const Display&);

/// A number that follows from the description; its name ends in its unit.
struct Figure {
    const char* name;
    std::vector<double> values;  // infinite where there is no finite one; NaN where it is undefined; two: along the array's x and y
    const char* meaning;
    const char* formula = "";    // how it is computed, in the symbols of docs/model.md
    const char* undefined = "";  // why there is none, where the value is NaN
    enum class Presentation {
        numbers,
        interval,
        for_scripts
    } kind = Presentation::numbers;  // interval: of two ends; for_scripts: in JSON alone
};
/// Returns the lengths and angles of the geometry.
std::vector<Figure> figures(const Display&, const Geometry&);
/// Returns the figures of the theory (docs/model.md, "Theory").
std::vector<Figure> figures(const Display&, const Geometry&, const Theory&);
/// Returns the largest errors of single lenses, random and given ones added up; none where there are no such errors.
std::vector<Figure> largest_errors(const Display&, const Geometry&);

/// Returns {"panel": {"pixels": ...}, ...}.
Json to_json(const std::vector<Setting>&);
/// Returns {"fov_deg": ...}, with "fov_y_deg" along y, intervals as [low, high], three channels as a list; "infinite" and
/// "-infinite" are words, and a figure that is undefined is null.
Json to_json(const std::vector<Figure>&);
/// Adds to `notes`, an object, why figures are undefined: {"PART.NAME": "..."}.
void add_notes(const std::vector<Figure>&, const std::string& part, Json& notes);

/// Returns the unit that a name ends in: "mm", "degrees", "1/mm", "cycles/degree", "1/m" or nothing.
std::string unit_of(const std::string& name);

}  // namespace lfdsim
