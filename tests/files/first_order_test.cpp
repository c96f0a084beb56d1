// The description of a first design reads back as the design.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/description/display_file.h"
#include "files/description/write_first_order.h"

namespace lfdsim {
namespace {

TEST(WriteFirstOrder, ReadsBackAsTheDesign) {
    const DesignRequest requests[] = {
        {8, {2560, 1600}, 30, 500, {}},
        {8, {2560, 1600}, 70, 500, -40},
        {0.7, {1920, 1080}, 30, 20, -1000},
        {100, {3840, 2160}, 40, 3000, {}, LensType::ideal},
        {5, {1080, 1920}, 100, 300, 30, LensType::ideal},
        {2, {64, 48}, 20, 400, 20},
    };
    for (const DesignRequest& request : requests) {
        FirstOrder made = first_order(request);
        made.display.name = "a \"name\"\nof two lines";
        const std::string text = write_first_order(made, "lfdsim new -o 'x\n[panel]\ny.toml'");
        EXPECT_EQ(parse_display(text, "text"), made.display) << text;
        for (std::size_t start = 0; start < text.size();) {  // lines as wide as a terminal
            const std::size_t end = text.find('\n', start);
            EXPECT_TRUE(end - start <= 100 || text[start] != '#') << text.substr(start, end - start);
            start = end + 1;
        }
    }
}

TEST(WriteFirstOrder, SaysWhyInWords) {
    const std::string text = write_first_order(first_order({8, {2560, 1600}, 30, 500, 50}), "lfdsim new");
    for (const char* words : {"a = 25.4 x 8 inches / sqrt(2560^2 + 1600^2)", "N = 21 panel pixels", "f = 1 / (1/g + 1/L)",
                              "R = (n - 1) f", "g = 1 / (2 tan(FOV/2)", "2 atan(p / 2d)", "Depth of field"})
        EXPECT_THAT(text, testing::HasSubstr(words));
}

}  // namespace
}  // namespace lfdsim
