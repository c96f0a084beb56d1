#include "image/texels.h"

#include "helpers.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cstdint>
#include <new>

namespace lfdsim {
namespace {

TEST(Texels, AlignedAndZeroed) {
    Texels texels(613, 401);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(texels.data()) % (std::size_t(1) << 21), 0u);
    EXPECT_EQ(texels.row(2) - texels.data(), 2 * 613 * 4);
    for (std::int64_t i = 0; i < 613 * 401 * 4; ++i) ASSERT_EQ(texels.data()[i], 0);
}

TEST(Texels, CopiesAnImage) {
    const Image image = test::random_image(7, 5);
    Texels texels = make_texels(image);
    ASSERT_EQ(texels.columns(), 7);
    ASSERT_EQ(texels.rows(), 5);
    for (int row = 0; row < 5; ++row)
        for (int column = 0; column < 7; ++column) {
            const float* texel = texels.row(row) + 4 * column;
            for (int c = 0; c < 3; ++c) EXPECT_EQ(texel[c], image.at(column, row)[c]);
            EXPECT_EQ(texel[3], 0);
        }
}

TEST(Texels, ShowWhatAPngWouldHold) {
    const test::TemporaryFolder folder;
    Image image = test::random_image(301, 99);
    image.rgb[0] = -1;
    image.rgb[1] = 7;
    for (const Encoding encoding : {Encoding::srgb, Encoding::linear}) {
        write_image(folder / "a.png", image, {.bits = 8, .encoding = encoding, .metadata = {}});
        const Texels read = read_panel_image(folder / "a.png", encoding, 301, 99), shown = shown_texels(image, encoding);
        EXPECT_TRUE(std::equal(read.data(), read.data() + 301 * 99 * 4, shown.data()));
    }
}

TEST(Texels, MovesWithoutCopying) {
    Texels texels(4, 4);
    const float* const data = texels.data();
    const Texels moved = std::move(texels);
    EXPECT_EQ(moved.data(), data);
}

TEST(Texels, RefusesImpossibleSizes) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    EXPECT_THROW(Texels(0, 1), std::bad_alloc);
    EXPECT_THROW(Texels(-1, -1), std::bad_alloc);
    EXPECT_THROW(Texels(most, most), std::bad_alloc);
    EXPECT_THROW(Texels(std::int64_t(1) << 16, std::int64_t(1) << 15), std::bad_alloc);
}

}  // namespace
}  // namespace lfdsim
