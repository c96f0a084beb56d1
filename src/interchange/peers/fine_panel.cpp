#include "interchange/peers/fine_panel.h"

#include "base/input_error.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int most_times = 12;           // fine pixels in a pixel, along an axis
constexpr double most_pixels = 1 << 28;  // of a fine panel

/// Returns whether all borders of subpixels are borders of fine pixels.
bool shows_borders(const std::vector<LitPart>& parts, int times) {
    const auto on_grid = [times](double place) { return std::abs(place * times - std::round(place * times)) < 1e-6; };
    return std::all_of(parts.begin(), parts.end(), [&](const LitPart& part) {
        return std::all_of(part.from.begin(), part.from.end(), on_grid) && std::all_of(part.to.begin(), part.to.end(), on_grid);
    });
}

/// Returns the area of the parts, in pixels for each pixel of the panel.
double area_of(const std::vector<LitPart>& parts) {
    double area = 0;
    for (const LitPart& part : parts) area += part.share / part.brightness();
    return area;
}

/// Returns whether the centre of a fine pixel, whose column (axis 0) or row (1) is `place`, lies in the part along that axis.
bool holds(const LitPart& part, std::int64_t times, std::int64_t place, std::size_t axis) {
    const double at = (double(place % (part.plane.cell[axis] * times)) + 0.5) / double(times);
    return at >= part.from[axis] && at < part.to[axis];
}

}  // namespace

FinePanel fine_panel(const Display& display) {
    FinePanel fine;
    fine.display = display;
    if (lights_whole_pixels(display.panel)) return fine;
    const std::vector<LitPart> parts = lit_parts(display.panel);
    while (fine.times < most_times && !shows_borders(parts, fine.times)) ++fine.times;
    const bool rounded = !shows_borders(parts, fine.times);
    fine.parts = rounded ? lit_parts_on_grid(display.panel, fine.times) : parts;
    double peak = 0;
    for (const LitPart& part : fine.parts) peak = std::max(peak, part.brightness());
    fine.light = 1 / peak;
    Panel& panel = fine.display.panel;
    double pixels = 1;
    for (std::int64_t& count : panel.pixels) pixels *= double(count *= fine.times);
    if (pixels > most_pixels)
        throw InputError("panel.subpixels",
                         fmt::format("need an image of {} x {} pixels for another renderer, which takes at most {:.0f} "
                                     "in all; give a smaller panel, or --set 'panel.subpixels=\"none\"' "
                                     "panel.aperture_ratio=1",
                                     panel.pixels[0], panel.pixels[1], most_pixels));
    panel.pixel_pitch_mm /= fine.times;
    panel.aperture_ratio = 1;
    panel.subpixels = SubpixelLayout::none;
    panel.subpixel_cell.reset();
    panel.custom.clear();
    fine.deviations.push_back(
        fmt::format("The panel's light is {:.4g} times the display's{}, so that its brightest subpixels are at most 1.", fine.light,
                    rounded ? " in the mean" : ""));
    if (rounded)
        fine.deviations.push_back(
            fmt::format("Subpixels are rounded to 1/{} of a pixel: their area is {:.4g} times the display's, and where they are "
                        "lit, their light {:.4g} times.",
                        fine.times, area_of(fine.parts) / area_of(parts), fine.light * area_of(parts) / area_of(fine.parts)));
    return fine;
}

Texels fine_image(const FinePanel& fine, const Texels& shown) {
    const std::int64_t columns = shown.columns(), rows = shown.rows();
    Texels image(columns * fine.times, rows * fine.times);
    for (const LitPart& part : fine.parts) {
        const float brightness = float(part.brightness() * fine.light);
        const auto [across, down] = part.plane.cell;
        for (std::int64_t y = 0; y < image.rows(); ++y) {
            const std::int64_t row = y / (down * fine.times) * down + part.plane.pixel[1];
            if (row < 0 || row >= rows || !holds(part, fine.times, y, 1)) continue;
            for (std::int64_t x = 0; x < image.columns(); ++x) {
                const std::int64_t column = x / (across * fine.times) * across + part.plane.pixel[0];
                if (column < 0 || column >= columns || !holds(part, fine.times, x, 0)) continue;
                for (int c = 0; c < 3; ++c)
                    if (part.channel == 3 || part.channel == c)
                        image.row(y)[4 * x + c] += brightness * shown.data()[4 * (row * columns + column) + c];
            }
        }
    }
    return image;
}

}  // namespace lfdsim
