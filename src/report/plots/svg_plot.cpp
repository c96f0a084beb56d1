#include "report/plots/svg.h"
#include "report/plots/svg_axes.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lfdsim {
namespace {

constexpr double row_height = 20, mark_row = 15, bar_row = 17;

// Colours that colour-blind people can distinguish, of medium lightness, so that they are visible on white and on black; the dashes
// differ from one curve to the next, and when a colour is used again.
constexpr const char* colours[] = {"#1f7fc0", "#d55e00", "#009e73", "#b0508a", "#b8860b", "#4a90d9"};
constexpr const char* dashes[] = {"", " stroke-dasharray=\"8 4\"", " stroke-dasharray=\"2 3\"", " stroke-dasharray=\"9 3 2 3\""};
constexpr const char* mark_style = "stroke=\"currentColor\" stroke-opacity=\"0.6\" stroke-dasharray=\"5 4\"";

/// The colours of curves of the panel's channels: red, green, blue.
constexpr const char* channel_colours[] = {"#d64545", "#2e9e55", "#3f78d8"};

const char* colour_of(const Series& s, std::size_t k) {
    return s.channel ? channel_colours[*s.channel] : colours[k % std::size(colours)];
}

std::string line_style(const Series& s, std::size_t k) {
    return fmt::format("stroke=\"{}\" stroke-width=\"2\"{}", colour_of(s, k), dashes[k % std::size(dashes)]);
}

/// Returns marks at points, by the number of the series: disks (lines without length with round ends), squares (lines as wide as
/// long) or crosses.
std::string dots(const Series& s, const std::vector<Point>& points, std::size_t k) {
    std::string d;
    for (const auto& [x, y] : points) {
        if (k % 3 == 0) d += fmt::format("M{} {}h0", px(x), px(y));
        if (k % 3 == 1) d += fmt::format("M{} {}h3.6", px(x - 1.8), px(y));
        if (k % 3 == 2) d += fmt::format("M{} {}h5M{} {}v5", px(x - 2.5), px(y), px(x), px(y - 2.5));
    }
    const char* pens[] = {"stroke-width=\"4\" stroke-linecap=\"round\"", "stroke-width=\"3.6\"", "stroke-width=\"1.2\""};
    return fmt::format("<path d=\"{}\" stroke=\"{}\" {}/>\n", d, colour_of(s, k), pens[k % 3]);
}

struct Ranges {
    PlotRange x, y;
};

/// Returns the ranges of the axes: of all finite points, and of y also of thresholds near them, with a margin of 5 %, or from 0
/// where that is near.
Ranges ranges(const Plot& plot) {
    Ranges r;
    for (const Series& s : plot.series) {
        if (s.x.size() != s.y.size()) throw std::invalid_argument("a series has different numbers of x and y");
        for (std::size_t i = 0; i < s.x.size(); ++i) {
            if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
            r.x.add(s.x[i]);
            r.y.add(s.y[i]);
        }
    }
    // A threshold is included if it is no further outside than the range is wide.
    const double span = r.y.high - r.y.low, low = r.y.low - span, high = r.y.high + span;
    for (const PlotMark& m : plot.marks)
        if (!m.vertical && (r.y.empty() || span == 0 || (m.at >= low && m.at <= high))) r.y.add(m.at);
    if (r.y.empty()) return r;
    const double pad = 0.05 * (r.y.high - r.y.low);
    r.y.low = r.y.low >= 0 && r.y.low <= 0.35 * r.y.high ? 0 : r.y.low - pad;
    r.y.high += pad;
    return r;
}

/// The labels of series and of marks outside the plot, in rows from left to right.
struct Legend {
    explicit Legend(double width) : width_(width) {}

    struct Entry {
        std::string label;
        int series;   // whose line is drawn before the text; -1: none
        double x;     // pixels
        int row;      // 0 at the top
        bool begins;  // it is the first line of its label
    };
    std::vector<Entry> entries;
    int rows = 0;

    /// Adds a label, to the last row if it fits there; one that is wider than the plot continues in further rows.
    void add(const std::string& label, int series) {
        const double sample = series < 0 ? 0 : 36, wide = sample + text_width(label, 13) + 18;
        if (rows == 0 || next_ + wide > width_ - 12) {
            ++rows;
            next_ = 12;
        }
        const std::vector<std::string> lines = wrapped(label, 13, width_ - 24 - sample);
        for (std::size_t k = 0; k < lines.size(); ++k) entries.push_back({lines[k], series, next_, rows - 1 + int(k), k == 0});
        if (lines.size() > 1) rows += int(lines.size()) - 1;
        next_ += wide;
    }

  private:
    double width_, next_ = 0;
};

bool within(const PlotAxis& axis, double value) { return value >= axis.low() && value <= axis.high(); }

Legend legend_of(const Plot& plot, const PlotAxis& x, const PlotAxis& y, double width) {
    Legend legend(width);
    for (std::size_t k = 0; k < plot.series.size(); ++k)
        if (plot.series.size() > 1 || !plot.series[k].label.empty()) legend.add(plot.series[k].label, int(k));
    for (const PlotMark& m : plot.marks)
        if (std::isfinite(m.at) && !within(m.vertical ? x : y, m.at))
            legend.add(fmt::format("{}: at {:.4g}, outside", m.label, m.at), -1);
    return legend;
}

/// The upright marks within the x axis, and the positions of their labels above the frame.
struct MarkLabels {
    std::vector<const PlotMark*> marks;
    std::vector<LabelPlace> places;
    int rows = 0;

    MarkLabels(const Plot& plot, const PlotAxis& axis, double left, double wide, double whole) {
        for (const PlotMark& m : plot.marks)
            if (m.vertical && within(axis, m.at)) marks.push_back(&m);
        std::stable_sort(marks.begin(), marks.end(), [](const PlotMark* a, const PlotMark* b) { return a->at < b->at; });
        std::vector<double> lines;
        std::vector<std::string> labels;
        for (const PlotMark* m : marks) {
            lines.push_back(left + wide * axis.share(m->at));
            labels.push_back(m->label);
        }
        places = place_labels(lines, labels, 12, whole - 4);
        for (const LabelPlace& place : places) rows = std::max(rows, place.row + 1);
    }
};

/// Draws a series as lines between consecutive points; points without neighbours, and series of dots, are drawn as marks.
void draw_series(SvgDrawing& drawing, const PlotFrame& frame, const Series& s, std::size_t k) {
    std::vector<Point> run, alone;
    const auto finish = [&] {
        if (s.dots || run.size() == 1)
            alone.insert(alone.end(), run.begin(), run.end());
        else
            drawing.path(run, line_style(s, k));
        run.clear();
    };
    for (std::size_t i = 0; i < s.x.size(); ++i) {
        if (within(frame.x, s.x[i]) && within(frame.y, s.y[i]))
            run.push_back(frame.at(s.x[i], s.y[i]));
        else
            finish();
    }
    finish();
    if (!alone.empty()) drawing.add(dots(s, alone, k));
}

/// Draws a row for each bar, with its label at the left over its spans.
void draw_bars(SvgDrawing& drawing, const PlotFrame& frame, const std::vector<PlotBar>& bars, double top) {
    for (std::size_t k = 0; k < bars.size(); ++k) {
        const double row = top + bar_row * double(k);
        bool any = false;
        for (const auto& [from, to] : bars[k].spans) {
            const double low = std::max(from, frame.x.low()), high = std::min(to, frame.x.high());
            if (!(low <= high)) continue;
            const double left = frame.at(low, frame.y.low())[0], right = frame.at(high, frame.y.low())[0];
            drawing.rectangle(
                {left, row}, std::max(right - left, 1.), bar_row - 4,
                fmt::format("fill=\"{}\" fill-opacity=\"0.35\" stroke=\"none\"", colours[(k + 2) % std::size(colours)]));
            any = true;
        }
        drawing.text({frame.left + 4, row + bar_row - 6}, bars[k].label + (any ? "" : ": nowhere here"), "font-size=\"12\"");
    }
}

/// Gives both axes the same scale: the range that would be enlarged more is widened. 6 % are left at the borders.
void make_equal(Ranges& r, double wide, double high) {
    const double per_pixel = 1.06 * std::max((r.x.high - r.x.low) / wide, (r.y.high - r.y.low) / high);
    const auto widen = [&](PlotRange& range, double pixels) {
        const double more = 0.5 * (per_pixel * pixels - (range.high - range.low));
        range = {range.low - more, range.high + more};
    };
    widen(r.x, wide);
    widen(r.y, high);
}

}  // namespace

std::string svg(const Plot& plot, double width) {
    // Axes, with room for the labels of thresholds at the right.
    Ranges r = ranges(plot);
    double right = 16;
    for (const PlotMark& m : plot.marks)
        if (!m.vertical) right = std::max(right, text_width(m.label, 12) + 12);
    right = std::min(right, 0.4 * width);
    const double left = room_beside(PlotAxis(r.y.low, r.y.high, 6)) + 4;
    double area = 300;
    if (plot.equal_axes && !r.x.empty() && (r.x.high > r.x.low || r.y.high > r.y.low)) {
        const double wide = width - left - right, sides = (r.y.high - r.y.low) / (r.x.high - r.x.low);
        area = std::clamp(wide * sides, 200., 440.);
        make_equal(r, wide, area);
    }
    const PlotAxis x(r.x.low, r.x.high, width < 480 ? 5 : 9), y(r.y.low, r.y.high, 6);

    // The layout, from the top: title, legend, bars, labels of upright marks, the frame.
    const std::vector<std::string> title = wrapped(plot.title, 17, width - 24);
    const Legend legend = legend_of(plot, x, y, width);
    const MarkLabels marks(plot, x, left, width - left - right, width);
    const double legend_top = 12 + row_height * double(title.size());
    const double bars_top = legend_top + row_height * legend.rows + 8;
    const double top = bars_top + bar_row * double(plot.bars.size()) + mark_row * marks.rows + 6;
    const PlotFrame frame{left, top, width - left - right, area, x, y};

    SvgDrawing drawing(width, frame.bottom() + room_below, plot.title);
    for (std::size_t k = 0; k < title.size(); ++k)
        drawing.text({12, 22 + row_height * double(k)}, title[k], "font-size=\"15\" font-weight=\"600\"");
    for (const Legend::Entry& e : legend.entries) {
        const double at_y = legend_top + row_height * (e.row + 0.7);
        drawing.text({e.x + (e.series < 0 ? 0 : 34), at_y}, e.label, "");
        if (e.series < 0 || !e.begins) continue;
        const std::size_t k = std::size_t(e.series);
        if (plot.series[k].dots)
            drawing.add(dots(plot.series[k], {{e.x + 14, at_y - 4}}, k));
        else
            drawing.line({e.x, at_y - 4}, {e.x + 28, at_y - 4}, line_style(plot.series[k], k));
    }
    frame.draw(drawing, plot.x_label, plot.y_label, true);
    draw_bars(drawing, frame, plot.bars, bars_top);
    for (std::size_t k = 0; k < marks.marks.size(); ++k) {
        const double at_x = frame.at(marks.marks[k]->at, y.low())[0], label_y = top - 5 - mark_row * marks.places[k].row;
        const double rise = marks.places[k].x < at_x ? -3 : 9;  // the line ends beside its label or, if that lies across it, below
        drawing.line({at_x, label_y - rise}, {at_x, frame.bottom()}, mark_style);
        drawing.text({marks.places[k].x, label_y}, marks.marks[k]->label, "font-size=\"12\"");
    }
    // Thresholds from the top down, their labels at least 13 pixels apart.
    double above = -1e9;
    std::vector<const PlotMark*> levels;
    for (const PlotMark& m : plot.marks)
        if (!m.vertical && within(y, m.at)) levels.push_back(&m);
    std::stable_sort(levels.begin(), levels.end(), [](const PlotMark* a, const PlotMark* b) { return a->at > b->at; });
    for (const PlotMark* m : levels) {
        const double at_y = frame.at(x.low(), m->at)[1];
        drawing.line({frame.left, at_y}, {frame.right(), at_y}, mark_style);
        above = std::max(at_y + 4, above + 13);
        drawing.text({frame.right() + 6, above}, m->label, "font-size=\"12\"");
    }
    for (std::size_t k = 0; k < plot.series.size(); ++k) draw_series(drawing, frame, plot.series[k], k);
    return drawing.svg();
}

}  // namespace lfdsim
