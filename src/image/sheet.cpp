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
