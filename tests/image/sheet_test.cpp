// Contact sheets: labels are whole, and large enough where a sheet is shown 480 pixels wide.
#include "image/sheet.h"
#include "image/font.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace lfdsim {
namespace {

/// Rows of a sheet with anything of a label's colour in them.
int inked_rows(const Image& sheet) {
    int rows = 0;
    for (int y = 0; y < sheet.height; ++y) {
        bool ink = false;
        for (int x = 0; x < sheet.width; ++x) ink = ink || sheet.at(x, y)[0] == 0.6f;
        rows += ink;
    }
    return rows;
}

TEST(Sheet, LabelsAreReadAt480Pixels) {
    for (const auto& [count, width] : {std::pair{7, 480}, {2, 406}, {2, 640}, {1, 100}, {3, 2000}}) {
        const std::vector<Image> pictures(std::size_t(count), Image(width, 4));
        for (const char* label : {"view, +10.3\xc2\xb0", "scene, +0\xc2\xb0"}) {
            std::vector<std::string> labels(std::size_t(count), label), cut(labels);
            cut.back().resize(cut.back().size() - 2);
            const Image sheet = contact_sheet(pictures, labels, count);
            EXPECT_GE(inked_rows(sheet) * 480. / sheet.width, 7) << label << count << " of " << width;  // a letter's dots of ten
            EXPECT_NE(sheet.rgb, contact_sheet(pictures, cut, count).rgb)
                << "the last letter is cut off: " << count << " of " << width;
        }
    }
}

TEST(Sheet, TakesAnyLabel) {
    const std::vector<Image> pictures(3, Image(20, 10));
    for (const std::string label :
         {"", " ", "\n\t", "averyveryverylongwordthatfitsnowhere", "\xc2", "a b c d e f g h i j k l m n o p q r s t u"}) {
        const Image sheet = contact_sheet(pictures, std::vector<std::string>(3, label), 3);
        EXPECT_EQ(sheet.width, 3 * 32 + 12);
        EXPECT_LE(sheet.height, 200) << label;
    }
    EXPECT_EQ(contact_sheet(pictures, {}, 2).height, 2 * 10 + 3 * 12);
}

TEST(Sheet, LettersAreDrawnByLinesWithSmoothEdges) {
    const auto drawn = [](const char* text, int scale) {
        Image image(glyph_width * scale * 2, glyph_height * scale);
        draw_text(image, 0, 0, scale, text, 1);
        return image;
    };
    const Image large = drawn("O/", 8);
    EXPECT_GT(std::ranges::count_if(large.rgb, [](float v) { return v > 0.05f && v < 0.95f; }), 100);
    EXPECT_EQ(large.at(2 * 8, 4)[0], 1);   // on the O's upper edge
    EXPECT_EQ(large.at(2 * 8, 28)[0], 0);  // in its middle
    // The slash is one line: no step of its dots, from (4, 1) to (0, 5), is missing or a corner.
    for (double t = 0; t <= 4; t += 0.25) EXPECT_EQ(large.at(48 + int(8 * (4.5 - t)), int(8 * (1.5 + t)))[0], 1) << t;
    for (const float v : drawn("O/", 1).rgb) EXPECT_TRUE(v == 0 || v == 1);
    // One place for each character, whatever its bytes.
    EXPECT_EQ(drawn("\xc3\xa4i", 2).rgb, drawn("ai", 2).rgb);
    EXPECT_EQ(drawn("\xc2\xb5m", 2).rgb, drawn("um", 2).rgb);
    EXPECT_EQ(drawn("\xe2\x88\x92"
                    "1",
                    2)
                  .rgb,
              drawn("-1", 2).rgb);
    EXPECT_NE(drawn("\xe4\xb8\xad"
                    "1",
                    2)
                  .rgb,
              drawn(" 1", 2).rgb);
    EXPECT_NE(drawn("\xc2\xb1", 2).rgb, drawn("\xe4\xb8\xad", 2).rgb);  // plus or minus is no box
    EXPECT_EQ(drawn("\xff\xff", 2).rgb, drawn("\xe4\xb8\xad\xe4\xb8\xad", 2).rgb);
}

}  // namespace
}  // namespace lfdsim
