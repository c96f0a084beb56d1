// What a measure finds: figures, curves, pictures. Floor 3, public as a part of measure.h: plain data.
//
// A measure states each figure once, by Result::add(): scripts' number, error and reason, and the report's line follow from it.
#pragma once
#include "image/image.h"

#include <nlohmann/json.hpp>

#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace lfdsim {

using Json = nlohmann::ordered_json;

struct Estimate;  // estimate.h

/// The value of a figure is a number or an interval of two, measured or by theory, with its errors.
struct FigureValue {
    std::vector<double> numbers;      // empty: there is none. NaN: it is undefined or was not found, and `missing` says why
    std::vector<double> errors = {};  // of each; empty: none is stated
    std::string missing = {};

    FigureValue() = default;
    /// Makes a value that scripts read as null.
    static FigureValue none(std::string why) {
        FigureValue value;
        value.missing = std::move(why);
        return value;
    }
    FigureValue(double without_error, std::string why_missing = {}) : numbers{without_error}, missing(std::move(why_missing)) {}
    FigureValue(std::vector<double> all, std::vector<double> error = {}, std::string why_missing = {})
        : numbers(std::move(all)), errors(std::move(error)), missing(std::move(why_missing)) {}
    /// `why_missing` is kept where the estimate is NaN.
    FigureValue(const Estimate&, const std::string& why_missing = {});
    FigureValue(const Estimate& low, const Estimate& high, std::string why_missing = {});
};

/// A line of the report's table says what a figure is, in which unit, and what theory has for it.
struct FigureLine {
    std::string label, unit = {};
    FigureValue theory = {};
    std::string theory_path = {};  // of theory's value for scripts; empty: it is not in this place, or has another form
    std::string remark = {};       // unless the figure or its theory is missing: the line then says why
};

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

    static DataTable of_rows(std::string name, const std::vector<std::string>& columns);
    /// Adds one value to each column.
    void add_row(std::span<const double>);
    void add_row(std::initializer_list<double> row) { add_row(std::span(row.begin(), row.size())); }
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

/// Curves over one axis for the report and for scripts: each is a line of the plot and a column of the table.
struct Curves {
    Plot plot;
    DataTable table;  // of the plot's name; its first column is the axis

    Curves(const std::string& name, std::string title, std::string x_label, std::string y_label, Column x);
    void add(std::string label, std::string column, std::vector<double> y);
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
    // What scripts read: names end in their unit, the error of NAME is NAME_error; numbers as figure_json.h writes them.
    Json figures = Json::object();
    Json notes = Json::object();  // why a figure is null: {"PATH.OF.NAME": "..."}
    void note(const std::string& path, const std::string& why) { notes[path] = why; }
    /// Adds a figure for scripts under a path such as "screen.uniformity_percent", with a note where it is missing; and its line
    /// of the table.
    void add(const std::string& path, const FigureValue&);
    void add(const std::string& path, const FigureValue&, const FigureLine&);
    /// Adds a line alone, of a figure that scripts find in other units or at another place.
    void add_line(const FigureValue&, const FigureLine&);
    void add(Curves);
    std::vector<Finding> findings;
    std::vector<std::string> remarks;  // sentences: what bounds a figure, where it differs from theory and why
    std::vector<DataTable> tables;
    std::vector<Plot> plots;
    std::vector<ColourMap> maps;
    std::vector<NamedPicture> pictures;
    std::vector<Animation> animations;
};

}  // namespace lfdsim
