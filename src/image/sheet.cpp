#include "image/sheet.h"

#include "base/text.h"
#include "image/font.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <sstream>
#include <vector>

namespace lfdsim {
namespace {

constexpr std::size_t most_lines = 4;  // of a label

std::size_t letters_of(const std::string& text) { return std::size_t(std::count_if(text.begin(), text.end(), begins_character)); }

void paste(const Image& from, Image& to, int x, int y) {
    for (int row = 0; row < from.height; ++row) std::copy_n(from.at(0, row), std::size_t(from.width) * 3, to.at(x, y + row));
}

std::string first_letters(const std::string& text, std::size_t letters) {
    std::size_t end = 0;
    for (; end < text.size(); ++end)
        if (begins_character(text[end]) && letters-- == 0) break;
    return text.substr(0, end);
}

// Returns the label in lines of at most `letters`, broken between words: at most most_lines, and words cut to a line's length.
std::vector<std::string> lines_of(const std::string& label, std::size_t letters) {
    std::vector<std::string> lines;
    std::istringstream words(label);
    for (std::string word; words >> word;) {
        if (!lines.empty() && letters_of(lines.back()) + 1 + letters_of(word) <= letters)
            lines.back() += " " + word;
        else if (lines.size() < most_lines)
            lines.push_back(first_letters(word, letters));
        else
            break;
    }
    return lines;
}

// Returns the scale of the labels: as large as needed to read them on a sheet of that width, but not so large that a word is wider
// than a picture.
int fitting_scale(std::span<const std::string> labels, int picture_width, int sheet_width) {
    std::size_t longest = 1;
    for (const std::string& label : labels) {
        std::istringstream words(label);
        for (std::string word; words >> word;) longest = std::max(longest, letters_of(word));
    }
    return std::clamp(picture_width / (glyph_width * int(longest)), 1, readable_scale(sheet_width));
}

/// Places on a sheet: cells as wide as the widest picture, and rows as high as their highest picture and the longest label.
struct SheetLayout {
    int columns, cell_width, label_scale, label_height;
    std::size_t letters;             // of a line of a label
    std::vector<std::int64_t> tops;  // of each row, pixels from the sheet's upper edge
    std::int64_t width, height;
    std::int64_t left(int column) const { return sheet_margin + std::int64_t(column) * (cell_width + sheet_margin); }
};

SheetLayout layout_of(std::span<const Image> pictures, std::span<const std::string> labels, int columns) {
    const int count = int(pictures.size());
    SheetLayout s{};
    s.columns = std::clamp(columns, 1, std::max(count, 1));
    s.cell_width = 1;
    for (const Image& p : pictures) s.cell_width = std::max(s.cell_width, p.width);
    s.width = s.left(s.columns);
    s.label_scale = fitting_scale(labels, s.cell_width, int(std::min<std::int64_t>(s.width, std::numeric_limits<int>::max())));
    s.letters = std::size_t(s.cell_width / (glyph_width * s.label_scale));
    std::size_t lines = 0;  // of the longest label
    for (const std::string& each : labels) lines = std::max(lines, lines_of(each, s.letters).size());
    s.label_height = labels.empty() ? 0 : int(lines) * glyph_height * s.label_scale + sheet_margin / 2;
    s.height = sheet_margin;
    for (int first = 0; first < count; first += s.columns) {
        int tallest = 0;
        for (int i = first; i < std::min(count, first + s.columns); ++i)
            tallest = std::max(tallest, pictures[std::size_t(i)].height);
        s.tops.push_back(s.height);
        s.height += s.label_height + tallest + sheet_margin;
    }
    return s;
}

}  // namespace

double contact_sheet_pixels(std::span<const Image> pictures, std::span<const std::string> labels, int columns) {
    const SheetLayout layout = layout_of(pictures, labels, columns);
    return double(layout.width) * double(layout.height);
}

Image contact_sheet(std::span<const Image> pictures, std::span<const std::string> labels, int columns) {
    const SheetLayout layout = layout_of(pictures, labels, columns);
    Image sheet(int(layout.width), int(layout.height));
    std::fill(sheet.rgb.begin(), sheet.rgb.end(), sheet_background);
    for (int i = 0; i < int(pictures.size()); ++i) {
        const int x = int(layout.left(i % layout.columns)), y = int(layout.tops[std::size_t(i / layout.columns)]);
        if (!labels.empty()) {
            int line_y = y;
            for (const std::string& line : lines_of(labels[std::size_t(i)], layout.letters)) {
                draw_text(sheet, x, line_y, layout.label_scale, line, sheet_ink);
                line_y += glyph_height * layout.label_scale;
            }
        }
        paste(pictures[std::size_t(i)], sheet, x, y + layout.label_height);
    }
    return sheet;
}

}  // namespace lfdsim
