// A drawing in SVG, piece by piece: text in the colour of its surroundings, so that it suits a light page and a dark one. Floor 4.
#pragma once
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Text for XML and HTML: special letters escaped, and what a page would obey in place of showing it (base/printable.h).
std::string escaped(std::string_view);

/// Pixels to two decimals, without trailing zeros. 0 for values that are not finite.
std::string px(double);

/// Width of a text in pixels in DejaVu Sans, which is wider than most fonts.
double text_width(std::string_view, double size);

/// The text in lines of about `width` pixels at most, as far as its words allow.
std::vector<std::string> wrapped(std::string_view text, double size, double width);

/// Labels above upright lines: each begins at its line, in a row, 0 the lowest, chosen so that no line that rises to its label
/// crosses another label.
struct LabelPlace {
    double x;
    int row;
};
/// `lines`: their x in ascending order, in a drawing of this width.
std::vector<LabelPlace> place_labels(std::span<const double> lines, std::span<const std::string> labels, double size, double width);

/// Pixels, y down.
using Point = std::array<double, 2>;

/// An SVG picture that is drawn line by line. `style`: further attributes, `stroke="#1f7fc0" stroke-width="2"`; without one, lines
/// are in the colour of text.
class SvgDrawing {
  public:
    /// `title`: what is drawn, for screen readers.
    SvgDrawing(double width, double height, std::string_view title);

    void line(Point from, Point to, std::string_view style);
    void path(std::span<const Point>, std::string_view style, bool closed = false);
    void rectangle(Point corner, double width, double height, std::string_view style);
    void text(Point at, std::string_view, std::string_view style);
    /// A dimension line with arrow heads, its label to the right of the middle of an upright one, else above.
    void dimension(Point from, Point to, std::string_view label);
    void add(std::string_view svg) { body_ += svg; }

    std::string svg() const { return head_ + body_ + "</svg>\n"; }

  private:
    std::string head_, body_;
};

}  // namespace lfdsim
