#include "foreign_png.h"
#include "helpers.h"
#include "image/formats/encoding.h"

#include <gtest/gtest.h>

namespace lfdsim {
namespace {

using test::ForeignPng;

/// Rows of a picture whose samples at (column, row, channel) are `sample`, packed as PNG packs them.
template <class Sample>
std::vector<std::vector<png_byte>> pack(int width, int height, int channels, int depth, Sample sample) {
    std::vector<std::vector<png_byte>> rows;
    for (int y = 0; y < height; ++y) {
        std::vector<png_byte> row(std::size_t((width * channels * depth + 7) / 8));
        for (int i = 0; i < width * channels; ++i) {
            const unsigned value = sample(i / channels, y, i % channels);
            if (depth == 16) {
                row[std::size_t(2 * i)] = png_byte(value >> 8);
                row[std::size_t(2 * i + 1)] = png_byte(value);
            } else {
                row[std::size_t(i * depth / 8)] |= png_byte(value << (8 - depth - i * depth % 8));
            }
        }
        rows.push_back(row);
    }
    return rows;
}

// Every depth of gray, interlaced or not, decodes to code / (2^depth - 1).
TEST(Png, GrayOfAllDepths) {
    const test::TemporaryFolder folder;
    for (const int depth : {1, 2, 4, 8, 16})
        for (const bool interlaced : {false, true}) {
            const unsigned top = (1u << depth) - 1;
            const auto sample = [&](int x, int y, int) { return unsigned(x * 7919 + y * 104729) & top; };
            test::save_png(folder / "gray.png",
                           ForeignPng{13, 11, depth, PNG_COLOR_TYPE_GRAY, pack(13, 11, 1, depth, sample), interlaced});
            const Image image = read_image(folder / "gray.png", Encoding::linear);
            ASSERT_EQ(image.width, 13);
            ASSERT_EQ(image.height, 11);
            for (int y = 0; y < 11; ++y)
                for (int x = 0; x < 13; ++x)
                    for (int c = 0; c < 3; ++c) ASSERT_FLOAT_EQ(image.at(x, y)[c], float(sample(x, y, 0)) / float(top)) << depth;
        }
}

TEST(Png, RgbOfBothDepthsIntoImageAndTexels) {
    const test::TemporaryFolder folder;
    for (const int depth : {8, 16})
        for (const bool interlaced : {false, true}) {
            const auto sample = [&](int x, int y, int c) {
                return unsigned(x * 7919 + y * 104729 + c * 1299709) & ((1u << depth) - 1);
            };
            test::save_png(folder / "rgb.png",
                           ForeignPng{13, 11, depth, PNG_COLOR_TYPE_RGB, pack(13, 11, 3, depth, sample), interlaced});
            const Image image = read_image(folder / "rgb.png", Encoding::srgb);
            Texels texels = read_panel_image(folder / "rgb.png", Encoding::srgb, 13, 11);
            for (int y = 0; y < 11; ++y)
                for (int x = 0; x < 13; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const float light = decode_table(Encoding::srgb, depth)[sample(x, y, c)];
                        ASSERT_EQ(image.at(x, y)[c], light);
                        ASSERT_EQ(texels.row(y)[4 * x + c], light);
                    }
            EXPECT_EQ(texels.data()[3], 0);
        }
}

TEST(Png, PalettesOfAllDepths) {
    const test::TemporaryFolder folder;
    for (const int depth : {1, 2, 4, 8}) {
        std::vector<png_color> palette;
        for (int i = 0; i < 1 << depth; ++i) palette.push_back({png_byte(i * 37), png_byte(255 - i), png_byte(i * 5)});
        const auto sample = [&](int x, int y, int) { return unsigned(x + 3 * y) & ((1u << depth) - 1); };
        test::save_png(folder / "palette.png",
                       ForeignPng{13, 11, depth, PNG_COLOR_TYPE_PALETTE, pack(13, 11, 1, depth, sample), false, palette});
        const Image image = read_image(folder / "palette.png", Encoding::srgb);
        for (int y = 0; y < 11; ++y)
            for (int x = 0; x < 13; ++x) {
                const png_color color = palette[sample(x, y, 0)];
                EXPECT_EQ(image.at(x, y)[0], decode_table(Encoding::srgb, 8)[color.red]);
                EXPECT_EQ(image.at(x, y)[1], decode_table(Encoding::srgb, 8)[color.green]);
                EXPECT_EQ(image.at(x, y)[2], decode_table(Encoding::srgb, 8)[color.blue]);
            }
    }
}

TEST(Png, TransparencyIsRefusedWithItsRemedy) {
    const test::TemporaryFolder folder;
    const auto zero = [](int, int, int) { return 0u; };
    const ForeignPng pictures[] = {{4, 4, 8, PNG_COLOR_TYPE_RGB_ALPHA, pack(4, 4, 4, 8, zero)},
                                   {4, 4, 16, PNG_COLOR_TYPE_GRAY_ALPHA, pack(4, 4, 2, 16, zero)},
                                   {4, 4, 8, PNG_COLOR_TYPE_RGB, pack(4, 4, 3, 8, zero), false, {}, true}};
    for (const ForeignPng& picture : pictures) {
        test::save_png(folder / "alpha.png", picture);
        const std::string message = test::input_error([&] { read_image(folder / "alpha.png", Encoding::srgb); });
        EXPECT_NE(message.find("alpha channel"), std::string::npos) << message;
        EXPECT_NE(message.find("remove it"), std::string::npos) << message;
    }
}

// Renderers and screenshots write alpha by default: full everywhere, it is no transparency.
TEST(Png, FullAlphaIsNone) {
    const test::TemporaryFolder folder;
    const auto code = [](int channels, unsigned full, bool clear) {
        return [=](int x, int y, int c) {
            return c == channels - 1 ? (clear && x == 3 && y == 2 ? full - 1 : full) : unsigned(40 * x + 10 * y + c);
        };
    };
    for (const bool interlaced : {false, true})
        for (const bool clear : {false, true}) {
            const ForeignPng pictures[] = {
                {5, 4, 8, PNG_COLOR_TYPE_RGB_ALPHA, pack(5, 4, 4, 8, code(4, 255, clear)), interlaced},
                {5, 4, 16, PNG_COLOR_TYPE_RGB_ALPHA, pack(5, 4, 4, 16, code(4, 65535, clear)), interlaced},
                {5, 4, 8, PNG_COLOR_TYPE_GRAY_ALPHA, pack(5, 4, 2, 8, code(2, 255, clear)), interlaced}};
            for (const ForeignPng& picture : pictures) {
                test::save_png(folder / "alpha.png", picture);
                const auto read = [&] { return read_image(folder / "alpha.png", Encoding::srgb); };
                if (clear) {
                    const std::string message = test::input_error(read);
                    EXPECT_NE(message.find("not full at column 3, row 2"), std::string::npos) << message;
                    continue;
                }
                const std::vector<float>& table = decode_table(Encoding::srgb, picture.depth);
                const Image image = read();
                const bool grey = picture.color_type == PNG_COLOR_TYPE_GRAY_ALPHA;
                for (int y = 0; y < 4; ++y)
                    for (int x = 0; x < 5; ++x)
                        for (int c = 0; c < 3; ++c)
                            ASSERT_EQ(image.at(x, y)[c], table[std::size_t(40 * x + 10 * y + (grey ? 0 : c))]);
            }
        }
}

// More than one strip of rows, so that the joins between separately compressed parts are read back; all codes occur.
TEST(Png, EveryCodeSurvivesWritingAndReading) {
    const test::TemporaryFolder folder;
    for (const Encoding encoding : {Encoding::srgb, Encoding::linear})
        for (const int bits : {8, 16}) {
            const std::vector<float>& table = decode_table(encoding, bits);
            Image image(219, 300);  // 65700 pixels
            for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = table[(i / 3 * (i % 3 + 1)) % table.size()];
            write_image(folder / "codes.png", image, {.bits = bits, .encoding = encoding, .metadata = {}});
            EXPECT_EQ(read_image(folder / "codes.png", encoding).rgb, image.rgb);
        }
}

TEST(Png, SameImageSameBytes) {
    const test::TemporaryFolder folder;
    const Image image = test::random_image(200, 333);
    write_image(folder / "a.png", image);
    write_image(folder / "b.png", image);
    EXPECT_EQ(test::load(folder / "a.png"), test::load(folder / "b.png"));
}

// A legal file may be 1000 times smaller than its pixels: the guard against absurd claims must let it pass.
TEST(Png, WhitePictureIsTinyAndReadable) {
    const test::TemporaryFolder folder;
    const std::vector<png_byte> row(3840 * 3, 0xff);
    test::save_png(folder / "white.png", ForeignPng{3840, 2160, 8, PNG_COLOR_TYPE_RGB, {2160, row}});
    EXPECT_LT(std::filesystem::file_size(folder / "white.png"), 3840u * 2160 * 3 / 300);
    Texels texels = read_panel_image(folder / "white.png", Encoding::srgb, 3840, 2160);
    EXPECT_EQ(texels.row(2159)[4 * 3839 + 2], 1);
}

}  // namespace
}  // namespace lfdsim
