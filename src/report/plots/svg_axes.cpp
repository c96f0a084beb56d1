#include "report/plots/svg_axes.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double most = 1e300;  // differences of such numbers are finite

/// Returns the least of 1, 2 or 5 times a power of ten that is not less than x > 0.
double round_up(double x) {
    const double power = std::pow(10, std::floor(std::log10(x)));
    for (const double digit : {1., 2., 5.})
        if (x <= digit * power * (1 + 1e-9)) return digit * power;
    return 10 * power;
}

}  // namespace

void PlotRange::add(double value) {
    if (!(std::abs(value) <= most)) return;
    const bool first = empty();
    low = first ? value : std::min(low, value);
    high = first ? value : std::max(high, value);
}

PlotAxis::PlotAxis(double low, double high, int ticks) : low_(low), high_(high) {
    if (low_ > high_) low_ = 0, high_ = 1;
    const double size = std::max(std::abs(low_), std::abs(high_));
    if (high_ - low_ <= 1e-10 * size || size == 0) {  // the same number throughout
        const double wide = size == 0 ? 1 : 0.1 * size;
        low_ -= wide;
        high_ += wide;
    }
    step_ = round_up((high_ - low_) / std::max(ticks, 1));
}

std::vector<double> PlotAxis::ticks() const {
    std::vector<double> all;
    for (double k = std::ceil(low_ / step_ - 1e-9); k <= std::floor(high_ / step_ + 1e-9); ++k) all.push_back(k * step_);
    return all;
}

std::string PlotAxis::label(double tick) const {
    if (std::abs(tick) < 0.5 * step_) return "0";
    const double size = std::max(std::abs(low_), std::abs(high_));
    // Decimals down to the first digit of the step; very large or small numbers have an exponent.
    const int of_step = int(std::floor(std::log10(step_) + 1e-9)), of_size = int(std::floor(std::log10(size)));
    std::string text = fmt::format("{:.{}f}", std::abs(tick), std::max(0, -of_step));
    if (size >= 1e6 || step_ < 1e-5) text = fmt::format("{:.{}e}", std::abs(tick), std::max(0, of_size - of_step));
    return (tick < 0 ? "\u2212" : "") + text;
}

double room_beside(const PlotAxis& axis) {
    double widest = 0;
    for (const double tick : axis.ticks()) widest = std::max(widest, text_width(axis.label(tick), 12));
    return widest + 36;
}

void PlotFrame::draw(SvgDrawing& drawing, const std::string& x_label, const std::string& y_label, bool grid) const {
    const char *thin = "stroke-opacity=\"0.14\"", *small = "font-size=\"12\" text-anchor=\"middle\"";
    for (const double tick : x.ticks()) {
        const double at_x = at(tick, y.low())[0];
        if (grid) drawing.line({at_x, top}, {at_x, bottom()}, thin);
        drawing.line({at_x, bottom()}, {at_x, bottom() + 4}, "");
        drawing.text({at_x, bottom() + 18}, x.label(tick), small);
    }
    for (const double tick : y.ticks()) {
        const double at_y = at(x.low(), tick)[1];
        if (grid) drawing.line({left, at_y}, {right(), at_y}, thin);
        drawing.line({left - 4, at_y}, {left, at_y}, "");
        drawing.text({left - 8, at_y + 4}, y.label(tick), "font-size=\"12\" text-anchor=\"end\"");
    }
    drawing.rectangle({left, top}, width, height, "stroke=\"currentColor\"");
    drawing.text({left + 0.5 * width, bottom() + 40}, x_label, "text-anchor=\"middle\"");
    const double label_x = left - room_beside(y) + 12, label_y = top + 0.5 * height;
    drawing.text({label_x, label_y}, y_label,
                 fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {} {})\"", px(label_x), px(label_y)));
}

}  // namespace lfdsim
