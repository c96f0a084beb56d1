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
    std::string table, key;
    Json value;          // null: absent
    bool is_default;     // the value is the one that holds without the key
    std::string absent;  // what applies without it, in words, where the value does not express it
};
std::vector<Setting> settings(const Display&);

/// A number that follows from the description; its name ends in its unit.
struct Figure {
    const char* name;
    std::vector<double> values;  // infinite where there is no finite one; NaN where it is undefined; two: along the array's x and y
    const char* meaning;
    const char* formula = "";    // how it is computed; symbols as in docs/model.md
    const char* undefined = "";  // why there is none, where the value is NaN
    enum class Presentation {
        numbers,
        interval,
        for_scripts
    } kind = Presentation::numbers;  // interval: of two ends; for_scripts: in JSON alone
};
std::vector<Figure> figures(const Display&, const Geometry&);
std::vector<Figure> figures(const Display&, const Geometry&, const Theory&);
/// The largest errors of single lenses, those of the table and those drawn together; none where there are no such errors.
std::vector<Figure> largest_errors(const Display&, const Geometry&);

Json to_json(const std::vector<Setting>&);  // {"panel": {"pixels": ...}, ...}
Json to_json(const std::vector<Figure>&);   // {"fov_deg": ...}, along y "fov_y_deg"; intervals as [low, high]; "infinite" and
                                            // "-infinite" as words, null where undefined
/// Adds to `notes`, an object, why figures are undefined: {"PART.NAME": "..."}.
void add_notes(const std::vector<Figure>&, const std::string& part, Json& notes);

/// The unit that a name ends in: "mm", "degrees", "1/mm" or nothing.
std::string unit_of(const std::string& name);

}  // namespace lfdsim
