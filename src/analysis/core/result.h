// Results of a measure: figures, curves, pictures. Floor 3, public as a part of measure.h: plain data.
//
// A measure states each figure once, by Result::add(): the number, error and reason for scripts and the report's line follow from
// it.
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

/// The value of a figure: a number or an interval of two, measured or by theory, with its stated errors.
struct FigureValue {
    std::vector<double> numbers;      // empty: there is none. NaN: it is undefined or was not found, and `missing` says why
    std::vector<double> errors = {};  // one for each number; empty: none is stated
    std::string missing = {};         // the reason why a number is missing

    FigureValue() = default;
    /// Returns a value without numbers, which scripts read as null, with its reason.
    static FigureValue none(std::string why) {
        FigureValue value;
        value.missing = std::move(why);
        return value;
    }
    FigureValue(double without_error, std::string why_missing = {}) : numbers{without_error}, missing(std::move(why_missing)) {}
    FigureValue(std::vector<double> all, std::vector<double> error = {}, std::string why_missing = {})
        : numbers(std::move(all)), errors(std::move(error)), missing(std::move(why_missing)) {}
    /// An estimate with its error; `why_missing` is kept only if its value is NaN.
    FigureValue(const Estimate&, const std::string& why_missing = {});
    /// The interval from one estimate to another.
    FigureValue(const Estimate& low, const Estimate& high, std::string why_missing = {});
};

/// A line of the report's table: what a figure is, its unit, and its value by theory.
struct FigureLine {
    std::string label, unit = {};
    FigureValue theory = {};
    std::string theory_path = {};  // where scripts find the value by theory; empty: not there, or in another form
    std::string remark = {};       // shown unless the figure or its theory is missing: the line then states the reason
};

/// A line of the report's table as it is shown: a figure as measured, and by theory. Each is one number or an interval of two;
/// empty: there is none. NaN: it is undefined or was not found, and the remark says why.
struct Finding {
    std::string what, unit;
    std::vector<double> measured, theory;
    std::string remark = {};         // why they differ, or what the figure means
    std::vector<double> error = {};  // one for each measured number; empty: none is stated
};

/// A column of a CSV file. Its name ends in its unit: "angle_deg". NaN: an empty field.
struct Column {
    std::string name;
    std::vector<double> values;
};
/// Columns of equal length for a CSV file.
struct DataTable {
    std::string name;  // of the file: NAME.csv
    std::vector<Column> columns;

    /// Returns a table with these columns and no rows.
    static DataTable of_rows(std::string name, const std::vector<std::string>& columns);
    /// Adds a row: one value to each column.
    void add_row(std::span<const double>);
    void add_row(std::initializer_list<double> row) { add_row(std::span(row.begin(), row.size())); }
};

/// A curve of a plot. NaN interrupts it.
struct Series {
    std::string label;
    std::vector<double> x, y;
    bool dots = false;                        // only points, no line
    std::optional<std::size_t> channel = {};  // 0, 1, 2: drawn in red, green, blue
};
/// A line across the plot: horizontal at a threshold, vertical at theory's value.
struct PlotMark {
    std::string label;
    double at;
    bool vertical = true;
};
/// A row above the plot in which intervals of its axis are drawn as bars, cut at the axis's ends.
struct PlotBar {
    std::string label;
    std::vector<std::array<double, 2>> spans;  // empty: the row says that there is none
};
/// A plot of the report.
struct Plot {
    std::string name;  // of the file: NAME.svg
    std::string title, x_label, y_label;
    std::vector<Series> series;
    std::vector<PlotMark> marks = {};
    bool equal_axes = false;  // the same scale along both axes, for spot diagrams
    std::vector<PlotBar> bars = {};
};

/// Curves over one axis for the report and for scripts: each is a line of the plot and a column of the table.
struct Curves {
    Plot plot;
    DataTable table;  // of the plot's name; its first column is the axis

    Curves(const std::string& name, std::string title, std::string x_label, std::string y_label, Column x);
    void add(std::string label, std::string column, std::vector<double> y);
};

/// Numbers over a plane as a picture in false colours with a scale; row 0 is at the top (the greatest y). NaN: no value.
struct ColourMap {
    std::string name;  // of the file: NAME.svg
    std::string title, x_label, y_label, value_label;
    double x0, x1, y0, y1;  // coordinates of the map's borders
    int columns, rows;
    std::vector<double> values;  // rows x columns
    double low, high;            // ends of the colour scale
};

/// A picture of the report.
struct NamedPicture {
    std::string name;     // of the file: NAME.png
    std::string caption;  // a sentence
    Image image;          // linear light
};

/// Several pictures of one size that are shown one after the other: NAME.png, animated.
struct Animation {
    std::string name, caption;
    std::vector<Image> frames;
    double seconds_per_frame = 0.1;
};

/// All that a measure finds.
struct Result {
    // Figures for scripts: names end in their unit, the error of NAME is NAME_error; numbers as figure_json.h writes them.
    Json figures = Json::object();
    Json notes = Json::object();  // why a figure is null: {"PATH.OF.NAME": "..."}
    void note(const std::string& path, const std::string& why) { notes[path] = why; }
    /// Adds a figure for scripts under a path such as "screen.uniformity_percent", with a note of the reason if it is missing.
    void add(const std::string& path, const FigureValue&);
    /// Adds a figure for scripts together with its line of the table.
    void add(const std::string& path, const FigureValue&, const FigureLine&);
    /// Adds a line to the table only, for a figure that scripts find in other units or in another place.
    void add_line(const FigureValue&, const FigureLine&);
    /// Adds the plot and the table of curves.
    void add(Curves);
    std::vector<Finding> findings;
    std::vector<std::string> remarks;  // sentences: what limits a figure, where and why it differs from theory
    std::vector<DataTable> tables;
    std::vector<Plot> plots;
    std::vector<ColourMap> maps;
    std::vector<NamedPicture> pictures;
    std::vector<Animation> animations;
};

}  // namespace lfdsim
