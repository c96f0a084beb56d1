#include "report/plots/svg_drawing.h"

#include "base/printable.h"
#include "base/text.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : printable_lines(text)) {
        if (c == '&')
            safe += "&amp;";
        else if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += c;
    }
    return safe;
}

std::string px(double x) {
    if (!std::isfinite(x)) return "0";
    std::string text = fmt::format("{:.2f}", x);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

double text_width(std::string_view text, double size) {
    // The widths of the characters from the space to the tilde in DejaVu Sans, hundredths of the size, rounded up.
    static constexpr unsigned char widths[] = {
        32, 41, 46, 84, 64, 96, 78, 28, 40,  40, 50, 84, 32, 37, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64,  //
        64, 64, 34, 34, 84, 84, 84, 54, 100, 69, 69, 70, 78, 64, 58, 78, 76, 30, 30, 66, 56, 87, 75, 79,  //
        61, 79, 70, 64, 62, 74, 69, 99, 69,  62, 69, 40, 34, 40, 84, 50, 50, 62, 64, 55, 64, 62, 36, 64,  //
        64, 28, 28, 58, 28, 98, 64, 62, 64,  64, 42, 53, 40, 64, 60, 82, 60, 60, 53, 64, 34, 64, 84};
    static_assert(std::size(widths) == '~' - ' ' + 1);
    constexpr int widest = 100;  // assumed of characters that are not ASCII
    int sum = 0;
    for (const char c : text) sum += c >= ' ' && c <= '~' ? widths[c - ' '] : begins_character(c) ? widest : 0;
    return size * sum / 100;
}

std::vector<std::string> wrapped(std::string_view text, double size, double width) {
    std::vector<std::string> lines;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string word(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!lines.empty() && text_width(lines.back() + " " + word, size) <= width)
            lines.back() += " " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

// Labels are placed from the right, each in the lowest row where it ends to the left of the labels and lines already placed.
std::vector<LabelPlace> place_labels(std::span<const double> lines, std::span<const std::string> labels, double size,
                                     double width) {
    std::vector<LabelPlace> places(lines.size());
    std::vector<double> free;  // for each row, the x up to which it is free
    for (std::size_t k = lines.size(); k-- > 0;) {
        const double wide = text_width(labels[k], size), x = std::max(0., std::min(lines[k] + 3, width - wide));
        std::size_t row = 0;
        while (row < free.size() && x + wide > free[row] - 8) ++row;
        if (row == free.size()) free.push_back(width);
        // The label's line rises through its row and all rows below.
        for (std::size_t r = 0; r <= row; ++r) free[r] = std::min({free[r], x, lines[k]});
        places[k] = {x, int(row)};
    }
    return places;
}

SvgDrawing::SvgDrawing(double width, double height, std::string_view title) {
    const std::string name = escaped(title);
    head_ = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" role=\"img\" "
        "aria-label=\"{2}\" font-family=\"system-ui, 'DejaVu Sans', sans-serif\" font-size=\"13\" fill=\"none\" "
        "stroke-linejoin=\"round\" style=\"color:#1c1c1c;background:#fff\">\n<title>{2}</title>\n",
        px(width), px(height), name);
}

void SvgDrawing::line(Point from, Point to, std::string_view style) { path(std::array{from, to}, style); }

void SvgDrawing::path(std::span<const Point> points, std::string_view style, bool closed) {
    if (points.empty()) return;
    std::string d;
    for (const auto& [x, y] : points) d += fmt::format("{}{} {}", d.empty() ? "M" : " ", px(x), px(y));
    const bool coloured = style.find("stroke=") != style.npos;
    body_ += fmt::format("<path d=\"{}{}\" {}{}/>\n", d, closed ? "z" : "", coloured ? "" : "stroke=\"currentColor\" ", style);
}

void SvgDrawing::rectangle(Point corner, double width, double height, std::string_view style) {
    body_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" {}/>\n", px(corner[0]), px(corner[1]), px(width),
                         px(height), style);
}

void SvgDrawing::text(Point at, std::string_view text, std::string_view style) {
    const bool coloured = style.find("fill=") != style.npos;
    body_ += fmt::format("<text x=\"{}\" y=\"{}\" {}{}>{}</text>\n", px(at[0]), px(at[1]), coloured ? "" : "fill=\"currentColor\" ",
                         style, escaped(text));
}

void SvgDrawing::dimension(Point from, Point to, std::string_view label) {
    const double dx = to[0] - from[0], dy = to[1] - from[1], length = std::hypot(dx, dy);
    const bool upright = std::abs(dy) > std::abs(dx);
    line(from, to, "stroke-width=\"0.8\"");
    if (length > 0) {
        const double reach = std::min(7., 0.4 * length), ux = dx / length * reach, uy = dy / length * reach;
        for (const int end : {0, 1}) {
            const Point& tip = end ? to : from;
            const double s = end ? -1 : 1, bx = tip[0] + s * ux, by = tip[1] + s * uy;
            path(std::array<Point, 3>{{tip, {bx - 0.4 * uy, by + 0.4 * ux}, {bx + 0.4 * uy, by - 0.4 * ux}}},
                 "stroke=\"none\" fill=\"currentColor\"", true);
        }
    }
    const double x = 0.5 * (from[0] + to[0]), y = 0.5 * (from[1] + to[1]);
    if (upright)
        text({x + 6, y + 4}, label, "font-size=\"12\"");
    else
        text({x, y - 5}, label, "font-size=\"12\" text-anchor=\"middle\"");
}

}  // namespace lfdsim
