#include "image/sheet.h"

#include "image/font.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int margin = 12;
constexpr float background = 0.012f, ink = 0.6f;  // linear light: a dark grey, and a light one

void paste(const Image& from, Image& to, int x, int y) {
    for (int row = 0; row < from.height; ++row) std::copy_n(from.at(0, row), std::size_t(from.width) * 3, to.at(x, y + row));
}

}  // namespace

Image scaled(const Image& from, int width, int height) {
    Image to(width, height);
    const double sx = double(from.width) / width, sy = double(from.height) / height;
    // the share of [low, high] that lies in pixel i
    const auto share = [](double low, double high, int i) { return std::min(high, i + 1.0) - std::max(low, double(i)); };
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double x0 = column * sx, x1 = x0 + sx, y0 = row * sy, y1 = y0 + sy;
            double sum[3] = {};
            for (int y = int(y0); y < std::min(int(std::ceil(y1)), from.height); ++y)
                for (int x = int(x0); x < std::min(int(std::ceil(x1)), from.width); ++x)
                    for (int c = 0; c < 3; ++c) sum[c] += share(x0, x1, x) * share(y0, y1, y) * from.at(x, y)[c];
            for (int c = 0; c < 3; ++c) to.at(column, row)[c] = float(sum[c] / (sx * sy));
        }
    return to;
}

Image contact_sheet(std::span<const Image> pictures, std::span<const std::string> labels, int columns) {
    const int count = int(pictures.size());
    columns = std::clamp(columns, 1, std::max(count, 1));
    int width = 1;
    for (const Image& p : pictures) width = std::max(width, p.width);
    const int scale = std::max(1, width / 240), label = labels.empty() ? 0 : glyph_height * scale + margin / 2;
    std::vector<int> tops;  // of each row
    int bottom = margin;
    for (int first = 0; first < count; first += columns) {
        int tallest = 0;
        for (int i = first; i < std::min(count, first + columns); ++i) tallest = std::max(tallest, pictures[std::size_t(i)].height);
        tops.push_back(bottom);
        bottom += label + tallest + margin;
    }
    Image sheet(columns * (width + margin) + margin, bottom);
    std::fill(sheet.rgb.begin(), sheet.rgb.end(), background);
    for (int i = 0; i < count; ++i) {
        const int x = margin + i % columns * (width + margin), y = tops[std::size_t(i / columns)];
        if (!labels.empty()) {
            const auto fitting = std::size_t(width / (glyph_width * scale));
            draw_text(sheet, x, y, scale, labels[std::size_t(i)].substr(0, fitting), ink);
        }
        paste(pictures[std::size_t(i)], sheet, x, y + label);
    }
    return sheet;
}

}  // namespace lfdsim
