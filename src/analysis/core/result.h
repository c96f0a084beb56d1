// What a measure finds: figures, curves, pictures. Floor 3: plain data.
#pragma once
#include "geometry/lattice.h"
#include "image/image.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

using Json = nlohmann::ordered_json;

/// A figure for scripts: null where it is undefined (NaN), "infinite" or "-infinite" where it has no finite value.
inline Json number_json(double x) {
    if (std::isinf(x)) return x > 0 ? "infinite" : "-infinite";
    return std::isnan(x) ? Json() : Json(x);
}
inline Json numbers_json(const std::vector<double>& all) {
    Json json = Json::array();
    for (const double x : all) json.push_back(number_json(x));
    return json;
}

/// A figure along the array's own x and y; one number where they do not differ by the lattice.
inline Json axes_json(const LensArray& array, double along_x, double along_y) {
    return differs_by_axis(array) ? numbers_json({along_x, along_y}) : number_json(along_x);
}

/// A line of the report's table: a figure as measured, and what theory says. Each is one number or an interval of two; empty: there
/// is none. NaN: it is undefined or was not found, and the remark says why.
struct Finding {
    std::string what, unit;
    std::vector<double> measured, theory;
    std::string remark = {};         // where they differ: why; or what the figure means
    std::vector<double> error = {};  // of each measured one; empty: none is stated
};

/// Columns of equal length for a CSV file. Names end in their unit: "angle_deg". NaN: an empty field.
struct Column {
    std::string name;
    std::vector<double> values;
};
struct DataTable {
    std::string name;  // of the file: NAME.csv
    std::vector<Column> columns;
};

/// Curves over one axis. NaN breaks a curve.
struct Series {
    std::string label;
    std::vector<double> x, y;
    bool dots = false;                        // points alone, no line
    std::optional<std::size_t> channel = {};  // 0, 1, 2: drawn in red, green, blue
};
/// A line across the plot: at a threshold (horizontal), or at theory's value (vertical).
struct PlotMark {
    std::string label;
    double at;
    bool vertical = true;
};
/// A row above the plot in which intervals of its axis are drawn as bars, cut at its ends.
struct PlotBar {
    std::string label;
    std::vector<std::array<double, 2>> spans;  // none: the row says so
};
struct Plot {
    std::string name;  // of the file: NAME.svg
    std::string title, x_label, y_label;
    std::vector<Series> series;
    std::vector<PlotMark> marks = {};
    bool equal_axes = false;  // a spot diagram: the same scale along both
    std::vector<PlotBar> bars = {};
};

/// Numbers over a plane, row 0 at the top (the greatest y), as a picture in false colours with a scale. NaN: no value.
struct ColourMap {
    std::string name;  // of the file: NAME.svg
    std::string title, x_label, y_label, value_label;
    double x0, x1, y0, y1;  // what the map's borders stand for
    int columns, rows;
    std::vector<double> values;  // rows x columns
    double low, high;            // of the colours' scale
};

struct NamedPicture {
    std::string name;     // of the file: NAME.png
    std::string caption;  // a sentence
    Image image;          // linear light
};

/// Several pictures one after the other, all of one size: NAME.png, animated.
struct Animation {
    std::string name, caption;
    std::vector<Image> frames;
    double seconds_per_frame = 0.1;
};

struct Result {
    // What scripts read: names end in their unit, the error of NAME is NAME_error; numbers as number_json() writes them.
    Json figures = Json::object();
    Json notes = Json::object();  // why a figure is null: {"PATH.OF.NAME": "..."}
    void note(const std::string& path, const std::string& why) { notes[path] = why; }
    std::vector<Finding> findings;
    std::vector<std::string> remarks;  // sentences: what bounds a figure, where it differs from theory and why
    std::vector<DataTable> tables;
    std::vector<Plot> plots;
    std::vector<ColourMap> maps;
    std::vector<NamedPicture> pictures;
    std::vector<Animation> animations;
};

}  // namespace lfdsim
