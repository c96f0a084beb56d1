// Animated PNG, read back by Pillow and, as a still picture, by our own reader.
#include "image/formats/apng.h"

#include <gtest/gtest.h>

#include <sstream>

#include "helpers.h"
#include "image/formats/encoding.h"
#include "image/formats/png_memory.h"
#include "image/scaled.h"

namespace lfdsim {
namespace {

std::vector<Image> frames_of(int count) {
    std::vector<Image> frames;
    for (int k = 0; k < count; ++k) frames.push_back(test::random_image(37, 23, unsigned(k + 1)));
    return frames;
}

TEST(Animation, OtherProgramsReadEachFrame) {
    if (std::system("/usr/bin/python3 -c 'import PIL' 2>/dev/null") != 0) GTEST_SKIP() << "Pillow is not installed";
    const test::TemporaryFolder folder;
    for (const int count : {1, 2, 7}) {
        const std::vector<Image> frames = frames_of(count);
        write_animation(folder / "turn.png", frames, 0.125);
        const std::string command = "/usr/bin/python3 '" LFDSIM_SOURCE_DIR "/tests/image/apng_frames.py' " +
                                    (folder / "turn.png").string() + " " + (folder / "raw").string() + " > " +
                                    (folder / "out").string();
        ASSERT_EQ(std::system(command.c_str()), 0);
        EXPECT_EQ(test::load(folder / "out"), std::to_string(count) + " 37 23 125 0\n");
        std::string codes;
        for (const Image& frame : frames)
            for (const std::uint8_t code : encode8(frame, Encoding::srgb)) codes += char(code);
        EXPECT_TRUE(test::load(folder / "raw") == codes) << count << " frames";
    }
}

TEST(Animation, IsAPictureOfItsFirstFrame) {
    const test::TemporaryFolder folder;
    const std::vector<Image> frames = frames_of(3);
    write_animation(folder / "turn.png", frames, 0.1);
    EXPECT_EQ(encode8(read_image(folder / "turn.png", Encoding::srgb), Encoding::srgb), encode8(frames[0], Encoding::srgb));
}

TEST(Animation, RefusesWhatIsNone) {
    const test::TemporaryFolder folder;
    std::vector<Image> frames = frames_of(2);
    EXPECT_THROW(write_animation(folder / "a.png", {}, 0.1), std::invalid_argument);
    EXPECT_THROW(write_animation(folder / "a.png", frames, 0), std::invalid_argument);
    EXPECT_THROW(write_animation(folder / "a.png", frames, 66), std::invalid_argument);
    EXPECT_THROW(write_animation(folder / "none" / "a.png", frames, 0.1), InputError);
    frames[1] = Image(37, 22);
    EXPECT_THROW(write_animation(folder / "a.png", frames, 0.1), std::invalid_argument);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(PngInMemory, IsWhatTheFileHolds) {
    const test::TemporaryFolder folder;
    const Image image = frames_of(1)[0];
    test::save(folder / "a.png", png_bytes(37, 23, 3, encode8(image, Encoding::srgb)));
    write_image(folder / "b.png", image);
    EXPECT_EQ(read_image(folder / "a.png", Encoding::srgb).rgb, read_image(folder / "b.png", Encoding::srgb).rgb);
    EXPECT_THROW(png_bytes(37, 23, 4, encode8(image, Encoding::srgb)), std::invalid_argument);
    EXPECT_THROW(png_bytes(0, 0, 3, {}), std::invalid_argument);
}

TEST(Reduced, KeepsTheMeanOfEachArea) {
    Image image(6, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 6; ++x)
            for (int c = 0; c < 3; ++c) image.at(x, y)[c] = float(x + 10 * y + 100 * c);
    const Image third = reduced(image, 3);  // 2 x 2 pixels become one
    ASSERT_EQ(third.width, 3);
    ASSERT_EQ(third.height, 2);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 3; ++x)
            for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(third.at(x, y)[c], float(2 * x + 0.5 + 10 * (2 * y + 0.5) + 100 * c));
    const Image odd = reduced(image, 4);  // one and a half columns: 0 and half of 1
    ASSERT_EQ(odd.height, 3);
    EXPECT_FLOAT_EQ(odd.at(0, 0)[0], float((0 + 0.5 * 1) / 1.5 + (0 + 10. / 3) / (4. / 3)));
    EXPECT_EQ(reduced(image, 6).rgb, image.rgb);
    EXPECT_EQ(reduced(image, 600).rgb, image.rgb);
}

}  // namespace
}  // namespace lfdsim
