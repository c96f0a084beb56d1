#include "base/constants.h"
#include "image/formats/png_memory.h"
#include "report/pages/base64.h"
#include "report/plots/svg.h"
#include "report/plots/svg_axes.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lfdsim {
namespace {

constexpr double map_width = 600, bar_width = 18;

/// Returns the sRGB codes of a colour from dark blue (t = 0) through green to light yellow (1): lightness rises evenly, so that the
/// map is readable in grey and without colour vision. It is computed in Oklab (Ottosson, "A perceptual color space for image
/// processing", 2020).
std::array<std::uint8_t, 3> colour(double t) {
    const double light = 0.28 + 0.67 * t, turn = (285 - 180 * t) * degree, chroma = 0.09 + 0.06 * t * (1.6 - t);
    const double a = chroma * std::cos(turn), b = chroma * std::sin(turn);
    const double l = std::pow(light + 0.3963377774 * a + 0.2158037573 * b, 3);
    const double m = std::pow(light - 0.1055613458 * a - 0.0638541728 * b, 3);
    const double s = std::pow(light - 0.0894841775 * a - 1.2914855480 * b, 3);
    const double rgb[] = {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
                          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
                          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
    std::array<std::uint8_t, 3> codes{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double x = std::clamp(rgb[k], 0., 1.), code = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
        codes[k] = std::uint8_t(std::lround(255 * code));
    }
    return codes;
}

/// Returns the map as a PNG of one pixel for each value; values that are not finite are transparent.
std::string png_of(const ColourMap& map) {
    std::vector<std::uint8_t> codes;
    codes.reserve(map.values.size() * 4);
    for (const double value : map.values) {
        if (!std::isfinite(value)) {
            codes.insert(codes.end(), {0, 0, 0, 0});
            continue;
        }
        const double share = map.high > map.low ? (value - map.low) / (map.high - map.low) : 0.5;
        for (const std::uint8_t code : colour(std::clamp(share, 0., 1.))) codes.push_back(code);
        codes.push_back(255);
    }
    return png_bytes(map.columns, map.rows, 4, codes);
}

std::string png_of_scale() {
    std::vector<std::uint8_t> codes;
    for (int k = 255; k >= 0; --k)
        for (const std::uint8_t code : colour(k / 255.)) codes.push_back(code);
    return png_bytes(1, 256, 3, codes);
}

std::string picture(const std::string& png, Point corner, double wide, double high) {
    return fmt::format(
        "<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" "
        "href=\"data:image/png;base64,{}\"/>\n",
        px(corner[0]), px(corner[1]), px(wide), px(high), base64(png));
}

/// Returns the part of a label after its last comma, its unit.
std::string unit(const std::string& label) {
    const std::size_t comma = label.rfind(", ");
    return comma == label.npos ? "" : label.substr(comma + 2);
}

}  // namespace

std::string svg(const ColourMap& map) {
    if (map.columns < 1 || map.rows < 1 || map.values.size() != std::size_t(map.columns) * std::size_t(map.rows))
        throw std::invalid_argument("a map's values are not rows x columns");
    if (!(map.x0 <= map.x1 && map.y0 <= map.y1 && map.low <= map.high)) throw std::invalid_argument("a map's range is reversed");
    // Axes, and the size of the map's area.
    const PlotAxis x(map.x0, map.x1, 8), y(map.y0, map.y1, 6), scale(map.low, map.high, 6);
    const double left = room_beside(y) + 4, right = bar_width + 24 + room_beside(scale);
    double wide = map_width - left - right, high = 320;
    if (const std::string of_x = unit(map.x_label); !of_x.empty() && of_x == unit(map.y_label)) {
        const double sides = (x.high() - x.low()) / (y.high() - y.low());  // width over height, in the unit of both axes
        if (sides > 0.2 && sides < 5) {
            high = std::min(440., wide / sides);
            wide = high * sides;
        }
    }
    const std::vector<std::string> title = wrapped(map.title, 17, map_width - 24);
    const double top = 20 + 20 * double(title.size());
    const PlotFrame frame{left, top, wide, high, x, y};
    SvgDrawing drawing(map_width, frame.bottom() + room_below, map.title);
    for (std::size_t k = 0; k < title.size(); ++k)
        drawing.text({12, 22 + 20 * double(k)}, title[k], "font-size=\"15\" font-weight=\"600\"");
    drawing.add(picture(png_of(map), {left, top}, wide, high));
    frame.draw(drawing, map.x_label, map.y_label, false);

    // The colour scale.
    const double bar = frame.right() + 20;
    drawing.add(picture(png_of_scale(), {bar, top}, bar_width, high));
    drawing.rectangle({bar, top}, bar_width, high, "stroke=\"currentColor\"");
    for (const double tick : scale.ticks()) {
        const double at_y = top + high * (1 - scale.share(tick));
        drawing.line({bar + bar_width, at_y}, {bar + bar_width + 4, at_y}, "");
        drawing.text({bar + bar_width + 8, at_y + 4}, scale.label(tick), "font-size=\"12\"");
    }
    const double label_x = bar + bar_width + room_beside(scale) - 8, label_y = top + 0.5 * high;
    drawing.text({label_x, label_y}, map.value_label,
                 fmt::format("text-anchor=\"middle\" transform=\"rotate(-90 {} {})\"", px(label_x), px(label_y)));
    return drawing.svg();
}

}  // namespace lfdsim
