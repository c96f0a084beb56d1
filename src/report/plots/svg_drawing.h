// A drawing in SVG, piece by piece, with text in the colour of its surroundings, so that it suits light and dark pages. Floor 4.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Returns text for XML and HTML, with special letters and control characters (base/printable.h) escaped.
std::string escaped(std::string_view);

/// Returns pixels to two decimals, without trailing zeros; "0" for values that are not finite.
std::string px(double);

/// Returns the width of a text in pixels in DejaVu Sans, which is wider than most fonts. `size`: of the font, pixels.
double text_width(std::string_view, double size);

/// Returns the text in lines of at most about `width` pixels, broken between words only.
std::vector<std::string> wrapped(std::string_view text, double size, double width);

/// The position of a label above an upright line.
struct LabelPlace {
    double x;  // pixels, where the label begins
    int row;   // 0 is the lowest
};
/// Returns positions for labels, each beginning at its line, in rows such that no line that rises to its label crosses another
/// label. `lines` are the x of the lines in ascending order, in a drawing of this width.
std::vector<LabelPlace> place_labels(std::span<const double> lines, std::span<const std::string> labels, double size, double width);

/// A point (x, y) of a drawing, pixels from its upper left corner.
using Point = std::array<double, 2>;

/// An SVG picture that is drawn line by line. `style` has further attributes, such as `stroke="#1f7fc0" stroke-width="2"`; without
/// a stroke, lines are in the colour of text.
class SvgDrawing {
  public:
    /// Begins a drawing of a size in pixels; `title` says what it shows, for screen readers.
    SvgDrawing(double width, double height, std::string_view title);

    void line(Point from, Point to, std::string_view style);
    void path(std::span<const Point>, std::string_view style, bool closed = false);
    void rectangle(Point corner, double width, double height, std::string_view style);
    void text(Point at, std::string_view, std::string_view style);
    /// Draws a dimension line with arrow heads, its label to the right of the middle of an upright one, else above.
    void dimension(Point from, Point to, std::string_view label);
    /// Adds elements that are SVG already.
    void add(std::string_view svg) { body_ += svg; }

    std::string svg() const { return head_ + body_ + "</svg>\n"; }

  private:
    std::string head_, body_;
};

}  // namespace lfdsim
