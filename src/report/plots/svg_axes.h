// Axes with round numbers, and the frame around a plot. Floor 4.
#pragma once
#include "report/plots/svg_drawing.h"

#include <string>
#include <vector>

namespace lfdsim {

/// A range of numbers with ticks at multiples of 1, 2 or 5 times a power of ten.
class PlotAxis {
  public:
    /// Makes an axis with at most about `ticks` ticks. A range without width is widened; low > high means an empty range, shown as
    /// 0 to 1.
    PlotAxis(double low, double high, int ticks);

    double low() const { return low_; }
    double high() const { return high_; }
    std::vector<double> ticks() const;
    /// Returns the text of a tick, with the decimals that the step needs and a true minus sign.
    std::string label(double tick) const;
    /// Returns a value's position along the axis: 0 at low, 1 at high.
    double share(double value) const { return (value - low_) / (high_ - low_); }

  private:
    double low_, high_, step_;
};

/// The smallest and the largest of the values added; those that are not finite, or above 1e300, do not count.
struct PlotRange {
    double low = 1, high = -1;
    bool empty() const { return low > high; }
    void add(double value);
};

/// The rectangle of a plot in its drawing, pixels.
struct PlotFrame {
    double left, top, width, height;
    PlotAxis x, y;

    Point at(double x_value, double y_value) const {
        return {left + width * x.share(x_value), top + height * (1 - y.share(y_value))};
    }
    double right() const { return left + width; }
    double bottom() const { return top + height; }
    /// Draws ticks, numbers, labels and, if wanted, a grid.
    void draw(SvgDrawing&, const std::string& x_label, const std::string& y_label, bool grid) const;
};

/// Returns the pixels that the numbers and the label of an upright axis need beside the frame.
double room_beside(const PlotAxis&);
inline constexpr double room_below = 48;

}  // namespace lfdsim
