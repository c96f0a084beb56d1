#include "image/compare/compare.h"

#include "helpers.h"
#include "image/formats/encoding.h"

#include <gtest/gtest.h>
#include <cmath>
#include <sstream>

namespace lfdsim {
namespace {

Image constant(int width, int height, float light) {
    Image image(width, height);
    std::fill(image.rgb.begin(), image.rgb.end(), light);
    return image;
}

TEST(Compare, EqualImages) {
    const Image image = test::random_image(40, 30);
    const Comparison result = compare(image, image);
    EXPECT_EQ(result.ssim, 1);
    EXPECT_EQ(result.rmse, 0);
    EXPECT_EQ(result.psnr_db, std::numeric_limits<double>::infinity());
    EXPECT_EQ(result.max_difference, 0);
}

// Without variance only the luminance term is left: (2 a b + C1)/(a^2 + b^2 + C1), a and b sRGB-encoded, C1 = 0.01^2. Luma has an
// error of 1e-7 (single precision), of which the variance terms, divided by C2 = 9e-4, keep less than 1e-6.
TEST(Compare, ConstantImagesGiveTheLuminanceTerm) {
    const double a = linear_to_srgb(0.2), b = linear_to_srgb(0.5);
    const Comparison result = compare(constant(20, 11, 0.2f), constant(20, 11, 0.5f));
    EXPECT_NEAR(result.ssim, (2 * a * b + 1e-4) / (a * a + b * b + 1e-4), 1e-6);
    EXPECT_NEAR(result.rmse, 0.3, 1e-7);
    EXPECT_NEAR(result.psnr_db, -20 * std::log10(0.3), 1e-6);
}

TEST(Compare, ValuesBeyondWhiteLookWhite) {
    EXPECT_EQ(compare(constant(11, 11, 1), constant(11, 11, 3)).ssim, 1);
    EXPECT_EQ(compare(constant(11, 11, 0), constant(11, 11, -3)).ssim, 1);
}

TEST(Compare, FindsTheGreatestDifference) {
    const Image a = test::random_image(40, 30);
    Image b = a;
    b.at(17, 23)[2] += 4;
    b.at(5, 6)[0] -= 3;
    const Comparison result = compare(a, b);
    EXPECT_NEAR(result.max_difference, 4, 1e-6);
    EXPECT_EQ(result.max_column, 17);
    EXPECT_EQ(result.max_row, 23);
    EXPECT_EQ(result.max_channel, 2);
    EXPECT_NEAR(result.rmse, 5 / std::sqrt(40 * 30 * 3.0), 1e-6);
}

TEST(Compare, ARegionIsAsIfCutOut) {
    const Image a = test::random_image(40, 30, 1), b = test::random_image(40, 30, 2);
    const Rect region{7, 5, 30, 27};
    Image cut_a(23, 22), cut_b(23, 22);
    for (int y = 0; y < 22; ++y)
        for (int x = 0; x < 23; ++x)
            for (int c = 0; c < 3; ++c) {
                cut_a.at(x, y)[c] = a.at(x + 7, y + 5)[c];
                cut_b.at(x, y)[c] = b.at(x + 7, y + 5)[c];
            }
    const Comparison part = compare(a, b, region), whole = compare(cut_a, cut_b);
    EXPECT_EQ(part.ssim, whole.ssim);
    EXPECT_EQ(part.rmse, whole.rmse);
    EXPECT_EQ(part.max_difference, whole.max_difference);
    EXPECT_EQ(part.max_column, whole.max_column + 7);
    EXPECT_EQ(part.max_row, whole.max_row + 5);
}

// Windows of 11 rows: those of rows 0-149 and those of rows 140-299 are together those of all, however they are gathered.
TEST(Compare, PartsAddUpToTheWhole) {
    const Image a = test::random_image(20, 300, 1);
    Image b = test::random_image(20, 300, 2);
    std::copy_n(a.rgb.begin(), b.rgb.size() / 2, b.rgb.begin());  // alike above, unlike below
    const double above = compare(a, b, Rect{0, 0, 20, 150}).ssim, below = compare(a, b, Rect{0, 140, 20, 300}).ssim;
    EXPECT_GT(above, below + 0.5);
    EXPECT_NEAR(compare(a, b).ssim, (140 * above + 150 * below) / 290, 1e-12);
}

TEST(Compare, RefusesWhatCannotBeCompared) {
    const Image image = test::random_image(40, 30);
    EXPECT_NE(test::input_error([&] { compare(image, test::random_image(30, 40)); }).find("40 x 30 and 30 x 40"),
              std::string::npos);
    EXPECT_NE(test::input_error([&] { compare(constant(10, 30, 0), constant(10, 30, 0)); }).find("at least 11 x 11"),
              std::string::npos);
    EXPECT_NE(test::input_error([&] { compare(image, image, Rect{0, 0, 41, 30}); }).find("exceeds the picture"), std::string::npos);
    EXPECT_NE(test::input_error([&] { compare(image, image, Rect{5, 5, 2, 20}); }).find("at least 11 x 11"), std::string::npos);
}

// The independent reference: scikit-image on the same arrays. 1e-6 allows for luma in single precision.
TEST(Compare, AgreesWithScikitImage) {
    if (std::system("/usr/bin/python3 -c 'import skimage.metrics' 2>/dev/null") != 0)
        GTEST_SKIP() << "scikit-image is not installed";
    const test::TemporaryFolder folder;
    const auto pair = [](float noise, unsigned seed) {  // a smooth picture, and the same with noise
        Image a(97, 61), b = test::random_image(97, 61, seed);
        for (int y = 0; y < 61; ++y)
            for (int x = 0; x < 97; ++x)
                for (int c = 0; c < 3; ++c) {
                    a.at(x, y)[c] =
                        0.5f + 0.6f * std::sin(0.1f * float(x * (c + 1))) * std::cos(0.07f * float(y));  // clips at both ends
                    b.at(x, y)[c] = a.at(x, y)[c] + noise * (b.at(x, y)[c] - 0.5f);
                }
        return std::pair(a, b);
    };
    std::vector<std::pair<Image, Image>> pairs{{test::random_image(97, 61, 4), test::random_image(97, 61, 5)}};
    for (const float noise : {1e-4f, 1e-3f, 0.01f, 0.03f, 0.1f, 0.2f, 0.4f, 0.7f, 1.f, 2.f})
        pairs.push_back(pair(noise, unsigned(pairs.size())));
    pairs.emplace_back(pairs[1].first, pairs[5].second);
    const std::string script = LFDSIM_SOURCE_DIR "/tests/image/ssim_reference.py";
    std::string command = "/usr/bin/python3 '" + script + "'";
    for (std::size_t i = 0; i < std::size(pairs); ++i)
        for (const auto& [name, image] : {std::pair("a", &pairs[i].first), std::pair("b", &pairs[i].second)}) {
            const std::filesystem::path path = folder / (name + std::to_string(i) + ".npy");
            write_image(path, *image);
            command += ' ' + path.string();
        }
    ASSERT_EQ(std::system((command + " > " + (folder / "out").string()).c_str()), 0);
    std::istringstream out(test::load(folder / "out"));
    for (const auto& [a, b] : pairs) {
        double ssim = 0, rmse = 0;
        ASSERT_TRUE(out >> ssim >> rmse);
        const Comparison result = compare(a, b);
        EXPECT_NEAR(result.ssim, ssim, 1e-6);
        EXPECT_NEAR(result.rmse, rmse, 1e-9);
    }
}

}  // namespace
}  // namespace lfdsim
