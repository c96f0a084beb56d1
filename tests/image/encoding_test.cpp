#include "image/formats/encoding.h"

#include "helpers.h"

#include <gtest/gtest.h>
#include <cmath>
#include <limits>

namespace lfdsim {
namespace {

// IEC 61966-2-1 in the standard's own words: values from its two branches and the published codes of mid gray.
TEST(Encoding, KnownValues) {
    EXPECT_EQ(srgb_to_linear(0), 0);
    EXPECT_EQ(srgb_to_linear(1), 1);
    EXPECT_NEAR(srgb_to_linear(0.04), 0.04 / 12.92, 1e-15);
    EXPECT_NEAR(srgb_to_linear(188 / 255.0), 0.502886, 1e-6);
    EXPECT_NEAR(linear_to_srgb(0.18), 0.461356, 1e-6);
    EXPECT_EQ(linear_to_srgb(-1), 0);
    EXPECT_DOUBLE_EQ(linear_to_srgb(2), 1);  // 1.055 - 0.055
}

// The standard's rounded constants leave a step of 3e-8 in light where the branches meet; elsewhere the two are inverse.
TEST(Encoding, Inverse) {
    for (int i = 0; i <= 10000; ++i) EXPECT_NEAR(srgb_to_linear(linear_to_srgb(i / 1e4)), i / 1e4, 5e-8) << i;
}

class BothEncodings : public testing::TestWithParam<Encoding> {};
INSTANTIATE_TEST_SUITE_P(Encoding, BothEncodings, testing::Values(Encoding::srgb, Encoding::linear));

TEST_P(BothEncodings, TableIsTheFormula) {
    for (const int bits : {8, 16}) {
        const std::vector<float>& table = decode_table(GetParam(), bits);
        const double top = (1 << bits) - 1;
        ASSERT_EQ(table.size(), std::size_t(1) << bits);
        for (std::size_t code = 0; code < table.size(); ++code) {
            const double value = double(code) / top;
            ASSERT_EQ(table[code], float(GetParam() == Encoding::srgb ? srgb_to_linear(value) : value)) << code;
        }
    }
}

TEST_P(BothEncodings, EveryCodeComesBack) {
    Image image(256, 1);
    for (int code = 0; code < 256; ++code)
        for (int c = 0; c < 3; ++c) image.at(code, 0)[c] = decode_table(GetParam(), 8)[std::size_t(code)];
    const auto codes = encode8(image, GetParam());
    for (std::size_t i = 0; i < codes.size(); ++i) EXPECT_EQ(codes[i], i / 3);
}

// Around every step between two codes, and on a fine sweep over all magnitudes, the fast encoder equals the rounded formula.
TEST_P(BothEncodings, EncoderIsExact) {
    std::vector<float> lights;
    for (int code = 0; code < 255; ++code) {
        const double middle = (code + 0.5) / 255;
        float x = float(GetParam() == Encoding::srgb ? srgb_to_linear(middle) : middle);
        for (int i = 0; i < 4; ++i) x = std::nextafter(x, 0.0f);
        for (int i = 0; i < 9; ++i, x = std::nextafter(x, 2.0f)) lights.push_back(x);
    }
    for (double x = 1e-6; x < 1.1; x *= 1.0003) lights.push_back(float(x));
    while (lights.size() % 3 != 0) lights.push_back(0);
    Image image(int(lights.size() / 3), 1);
    image.rgb = lights;
    const auto codes = encode8(image, GetParam());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const double light = std::min(1.0, double(lights[i]));
        const double value = GetParam() == Encoding::srgb ? linear_to_srgb(light) : light;
        ASSERT_EQ(codes[i], std::floor(255 * value + 0.5)) << lights[i];
    }
}

TEST_P(BothEncodings, ClipsWhatNoCodeCanShow) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    Image image(2, 1);
    image.rgb = {-1, -infinity, -0.0f, 1.5f, infinity, std::numeric_limits<float>::quiet_NaN()};
    EXPECT_EQ(encode8(image, GetParam()), (std::vector<std::uint8_t>{0, 0, 0, 255, 255, 0}));
}

}  // namespace
}  // namespace lfdsim
