// Test patterns, pixel by pixel where a closed form says what they are.
#include "image/formats/encoding.h"
#include "small_world.h"

namespace {

using namespace small_world;

Image make(const std::string& name, const Display& d, const PatternOptions& o = {}) { return pattern(name, d, resolve(d), o); }

bool white(const Image& image, int column, int row) {
    const float* p = image.at(column, row);
    EXPECT_TRUE((p[0] == 0 || p[0] == 1) && p[0] == p[1] && p[1] == p[2]);
    return p[0] == 1;
}

TEST(Pattern, HasThePanelsSize) {
    for (const std::string& name : pattern_names()) {
        const Image image = make(name, display());
        EXPECT_EQ(image.width, 240) << name;
        EXPECT_EQ(image.height, 160) << name;
    }
}

TEST(Pattern, Checkerboard) {
    PatternOptions o;
    o.cell_pixels = 7;
    const Image image = make("checkerboard", display(), o);
    for (int row = 0; row < 160; ++row) {
        for (int column = 0; column < 240; ++column) ASSERT_EQ(white(image, column, row), (row / 7 + column / 7) % 2 == 0);
    }
}

TEST(Pattern, White) {
    const Image image = make("white", display());
    for (const float x : image.rgb) ASSERT_EQ(x, 1);
}

// As codes, in either encoding: R and G count blocks of 16, B the place inside.
TEST(Pattern, AddressSurvivesTheEncoding) {
    Display d = display();
    for (const Encoding encoding : {Encoding::srgb, Encoding::linear}) {
        d.panel.encoding = encoding;
        const std::vector<std::uint8_t> codes = encode8(make("address", d), encoding);
        for (int row = 0; row < 160; ++row) {
            for (int column = 0; column < 240; ++column) {
                const std::uint8_t* c = &codes[3 * (std::size_t(row) * 240 + column)];
                ASSERT_EQ(c[0] * 16 + c[2] / 16, column);
                ASSERT_EQ(c[1] * 16 + c[2] % 16, row);
            }
        }
    }
}

// The elemental images are 20 pixels wide here, so their centres are pixel corners: four pixels each, the same in all.
TEST(Pattern, ViewLightsTheSamePlaceOfEachElementalImage) {
    const Display d = display();
    const Image centre = make("view", d);
    PatternOptions o;
    o.view_x = 0.275;  // 5.5 pixels right of the centre and 3.5 above it: the centre of a pixel
    o.view_y = 0.175;
    const Image side = make("view", d, o);
    for (int row = 0; row < 160; ++row) {
        for (int column = 0; column < 240; ++column) {
            const int i = column % 20, j = row % 20;
            ASSERT_EQ(white(centre, column, row), (i == 9 || i == 10) && (j == 9 || j == 10));
            ASSERT_EQ(white(side, column, row), i == 15 && j == 6);
        }
    }
}

// The edge of a half plane at a depth, through the pick-up's formula, in and before the lens plane.
TEST(Pattern, EdgeStandsAtItsDepth) {
    const Display d = display();
    for (const double depth : {0., 80.}) {
        PatternOptions o;
        o.edge_deg = 5;
        o.depth_mm = depth;
        const Image image = make("edge", d, o);
        for (int row = 0; row < 160; ++row) {
            for (int column = 0; column < 240; ++column) {
                const double x = (column + 0.5 - 120) * 0.2, y = (80 - row - 0.5) * 0.2;
                const double cx = std::floor(x / 4) * 4 + 2, cy = std::floor(y / 4) * 4 + 2;
                const double side = (cx + depth * (cx - x) / 10) * std::cos(5 * M_PI / 180) +
                                    (cy + depth * (cy - y) / 10) * std::sin(5 * M_PI / 180);
                if (std::abs(side) < 1e-9) continue;
                ASSERT_EQ(white(image, column, row), side > 0);
            }
        }
    }
}

TEST(Pattern, BadOptionsAreAllReported) {
    PatternOptions o;
    o.cell_pixels = 0;
    o.view_x = 0.6;
    o.view_y = std::numeric_limits<double>::quiet_NaN();
    o.edge_deg = 91;
    o.depth_mm = std::numeric_limits<double>::infinity();
    try {
        make("white", display(), o);
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_EQ(e.problems.size(), 5u);
    }
    try {
        make("chessboard", display());
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr("checkerboard"));
    }
}

}  // namespace
