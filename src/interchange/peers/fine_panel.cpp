#include "interchange/peers/fine_panel.h"

#include "base/input_error.h"
#include "geometry/subpixels.h"

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

/// A subpixel's part in fine pixels, those whose centres it holds.
struct FinePart {
    LitPart part;
    std::int64_t times;

    /// Returns whether the centre of a fine pixel, whose column (axis 0) or row (1) is `place`, lies in the part along that axis.
    bool holds(std::int64_t place, std::size_t axis) const {
        const double at = (double(place % cell(axis)) + 0.5) / double(times);
        return at >= part.from[axis] && at < part.to[axis];
    }
    /// Returns the size of the cell along an axis, in fine pixels.
    std::int64_t cell(std::size_t axis) const { return part.plane.cell[axis] * times; }
    /// Returns the factor that makes white white in the mean, whatever rounding does to the part.
    double brightness() const {
        double area = 1;
        for (const std::size_t axis : {0u, 1u}) {
            std::int64_t count = 0;
            for (std::int64_t place = 0; place < cell(axis); ++place) count += holds(place, axis);
            area *= double(count) / double(cell(axis));
        }
        if (area == 0)
            throw InputError("panel.aperture_ratio",
                             "makes subpixels too small for another renderer's panel image; take a larger value");
        return part.share / area;
    }
};

/// Returns the largest brightness of the parts in fine pixels.
double peak_of(const std::vector<LitPart>& parts, int times) {
    double most = 0;
    for (const LitPart& part : parts) most = std::max(most, FinePart{part, times}.brightness());
    return most;
}

}  // namespace

FinePanel fine_panel(const Display& display) {
    FinePanel fine{display, 1, 1, {}};
    if (lights_whole_pixels(display.panel)) return fine;
    const std::vector<LitPart> parts = lit_parts(display.panel);
    while (fine.times < most_times && !shows_borders(parts, fine.times)) ++fine.times;
    fine.light = 1 / peak_of(parts, fine.times);
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
        fmt::format("The panel's light is {:.4g} times the display's, so that its brightest subpixels are at most 1.", fine.light));
    if (!shows_borders(parts, fine.times))
        fine.deviations.push_back(fmt::format("Borders of subpixels are rounded to 1/{} of a pixel.", fine.times));
    return fine;
}

Texels fine_image(const FinePanel& fine, const Panel& panel, const Texels& shown) {
    const std::int64_t columns = shown.columns(), rows = shown.rows();
    Texels image(columns * fine.times, rows * fine.times);
    for (const LitPart& part : lit_parts(panel)) {
        const FinePart lit{part, fine.times};
        const float brightness = float(lit.brightness() * fine.light);
        const auto [across, down] = part.plane.cell;
        for (std::int64_t y = 0; y < image.rows(); ++y) {
            const std::int64_t row = y / lit.cell(1) * down + part.plane.pixel[1];
            if (row < 0 || row >= rows || !lit.holds(y, 1)) continue;
            for (std::int64_t x = 0; x < image.columns(); ++x) {
                const std::int64_t column = x / lit.cell(0) * across + part.plane.pixel[0];
                if (column < 0 || column >= columns || !lit.holds(x, 0)) continue;
                for (int c = 0; c < 3; ++c)
                    if (part.channel == 3 || part.channel == c)
                        image.row(y)[4 * x + c] = brightness * shown.data()[4 * (row * columns + column) + c];
            }
        }
    }
    return image;
}

}  // namespace lfdsim
