#include "image/overlay/overlay_picture.h"

#include "image/font.h"
#include "image/formats/encoding.h"
#include "image/sheet.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double full_scale = 0.25;  // difference in luma that gets the full colour

double encoded_luma(const float* rgb) {
    const auto code = [](float light) { return linear_to_srgb(std::clamp(double(light), 0.0, 1.0)); };
    return 0.2126 * code(rgb[0]) + 0.7152 * code(rgb[1]) + 0.0722 * code(rgb[2]);
}

/// Writes the colour of a difference: -1 blue, 0 white, 1 red.
void paint(double difference, float* rgb) {
    const double t = std::clamp(difference, -1.0, 1.0), pale = srgb_to_linear(1 - std::abs(t));
    rgb[0] = float(t < 0 ? pale : 1);
    rgb[1] = float(pale);
    rgb[2] = float(t > 0 ? pale : 1);
}

}  // namespace

Image overlay_picture(const Match& match, const Region& screen) {
    const Rect box = screen.bounds();
    const int width = box.x1 - box.x0, height = box.y1 - box.y0, square = std::max(8, std::max(width, height) / 12);
    const std::string labels[] = {"simulated", "photograph", "checkerboard of both", "half of each"};
    std::vector<Image> pictures;
    for (int k = 0; k < 4; ++k) {
        Image& to = pictures.emplace_back(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const float *s = match.simulated.at(box.x0 + x, box.y0 + y), *p = match.photograph.at(box.x0 + x, box.y0 + y);
                const float of_photograph = k == 0 ? 0.f : k == 1 ? 1.f : k == 3 ? 0.5f : float((x / square + y / square) % 2);
                for (int c = 0; c < 3; ++c) to.at(x, y)[c] = (1 - of_photograph) * s[c] + of_photograph * p[c];
            }
    }
    return contact_sheet(pictures, labels, 2);
}

Image difference_picture(const Match& match, const Region& screen) {
    const Rect box = screen.bounds();
    const int width = box.x1 - box.x0, height = box.y1 - box.y0;
    const int scale = readable_scale(width), label = glyph_height * scale + sheet_margin / 2;
    Image to(width + 2 * sheet_margin, height + 2 * label + 3 * sheet_margin);
    std::fill(to.rgb.begin(), to.rgb.end(), sheet_background);
    tbb::parallel_for(0, int(screen.rows.size()), [&](int k) {
        const int y = screen.top + k;
        for (int x = screen.rows[std::size_t(k)].from; x < screen.rows[std::size_t(k)].to; ++x)
            paint((encoded_luma(match.photograph.at(x, y)) - encoded_luma(match.simulated.at(x, y))) / full_scale,
                  to.at(sheet_margin + x - box.x0, sheet_margin + y - box.y0));
    });
    const int top = height + 2 * sheet_margin;
    for (int x = 0; x < width; ++x)
        for (int y = 0; y < label - sheet_margin / 2; ++y) paint(2 * (x + 0.5) / width - 1, to.at(sheet_margin + x, top + y));
    const auto text = [&](const std::string& words, double place) {  // 0: at the left, 1: at the right
        const int length = int(words.size()) * glyph_width * scale;
        draw_text(to, sheet_margin + int(place * (width - length)), top + label, scale, words, sheet_ink);
    };
    text(fmt::format("darker by {:.0f} %", 100 * full_scale), 0);
    text("equal", 0.5);
    text(fmt::format("brighter by {:.0f} %", 100 * full_scale), 1);
    return to;
}

}  // namespace lfdsim
