#include "image/overlay/overlay.h"

#include "helpers.h"
#include "image/compare/blur.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace lfdsim {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();
constexpr Corners trapezoid{Point{103, 58}, Point{811, 40}, Point{760, 645}, Point{95, 590}};

Corners rectangle_of(double x0, double y0, double x1, double y1) { return {Point{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

std::string fault(const Corners& corners) {
    return test::input_error([&] { check_corners("--corners", corners); });
}

TEST(Homography, TakesCornersToCorners) {
    const Corners from = rectangle_of(20, 10, 420, 250);
    for (const Corners& to : {trapezoid, from, rectangle_of(5, 6, 7, 9)}) {
        const Homography h(from, to);
        for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t axis = 0; axis < 2; ++axis) EXPECT_NEAR(h(from[k][0], from[k][1])[axis], to[k][axis], 1e-10);
    }
}

// Two things that every perspective keeps: straight lines, and the crossing of the diagonals.
TEST(Homography, KeepsLinesAndTheirCrossings) {
    const Homography h(rectangle_of(20, 10, 420, 250), trapezoid), back(trapezoid, rectangle_of(20, 10, 420, 250));
    const auto cross = [](Point a, Point b, Point c) { return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]); };
    EXPECT_NEAR(cross(h(20, 10), h(111, 95), h(202, 180)), 0, 1e-7);
    EXPECT_NEAR(cross(trapezoid[0], trapezoid[2], h(220, 130)), 0, 1e-7);
    EXPECT_NEAR(cross(trapezoid[1], trapezoid[3], h(220, 130)), 0, 1e-7);
    const Point there = h(77, 201), here = back(there[0], there[1]);
    EXPECT_NEAR(here[0], 77, 1e-10);
    EXPECT_NEAR(here[1], 201, 1e-10);
}

TEST(Homography, DerivativesAreThoseOfDifferences) {
    const Homography h(rectangle_of(20, 10, 420, 250), trapezoid);
    constexpr double step = 1e-4;
    for (const auto& [x, y] : {Point{30, 30}, Point{400, 60}, Point{222, 240}})
        for (std::size_t axis = 0; axis < 2; ++axis) {
            EXPECT_NEAR(h.derivatives(x, y)[0][axis], (h(x + step, y)[axis] - h(x - step, y)[axis]) / (2 * step), 1e-7);
            EXPECT_NEAR(h.derivatives(x, y)[1][axis], (h(x, y + step)[axis] - h(x, y - step)[axis]) / (2 * step), 1e-7);
        }
}

TEST(Corners, OnlyConvexOnesInOrder) {
    const auto [a, b, c, d] = trapezoid;
    for (const Corners& turned : {Corners{a, b, c, d}, {b, c, d, a}, {c, d, a, b}, {d, a, b, c}}) EXPECT_EQ(fault(turned), "");
    for (const Corners& mirrored : {Corners{d, c, b, a}, {c, b, a, d}, {b, a, d, c}, {a, d, c, b}})
        EXPECT_NE(fault(mirrored).find("counter-clockwise"), std::string::npos);
    for (const Corners& crossed : {Corners{a, c, b, d}, {a, b, d, c}, {a, b, Point{200, 200}, d}, {a, b, c, Point{457, 49}}})
        EXPECT_NE(fault(crossed).find("--corners: the corners do not make a convex quadrilateral"), std::string::npos);
    EXPECT_NE(fault({a, a, c, d}).find("0 pixels apart"), std::string::npos);
    EXPECT_NE(fault({a, b, c, Point{NAN, 3}}).find("apart"), std::string::npos);
}

TEST(Blur, OfAPointIsAGaussian) {
    constexpr int size = 61, middle = 30;
    for (const double sigma : {0.7, 1.5, 4.0}) {
        std::vector<float> values(size * size * 2);
        values[(middle * size + middle) * 2 + 1] = 1;
        blur(values, size, size, 2, sigma);
        double sum = 0, across = 0, down = 0;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                EXPECT_EQ(values[std::size_t(y * size + x) * 2], 0);  // the other channel
                const double v = values[std::size_t(y * size + x) * 2 + 1];
                sum += v;
                across += v * (x - middle) * (x - middle);
                down += v * (y - middle) * (y - middle);
            }
        EXPECT_NEAR(sum, 1, 1e-6);
        EXPECT_NEAR(across, sigma * sigma, 0.01 * sigma * sigma);  // cut at 4 sigma
        EXPECT_NEAR(down, sigma * sigma, 0.01 * sigma * sigma);
    }
}

TEST(Blur, LeavesEvenLightAlone) {
    std::vector<float> values(7 * 5 * 3, 0.25f);
    blur(values, 7, 5, 3, 6);  // wider than the picture
    for (const float v : values) EXPECT_NEAR(v, 0.25, 1e-6);
}

TEST(Align, TheSamePictureStaysToTheLastBit) {
    const Image image = test::random_image(60, 40);
    const Corners all = rectangle_of(0, 0, 60, 40);
    const Aligned aligned = align(image, all, 60, 40, all, none);
    EXPECT_EQ(aligned.light.rgb, image.rgb);
    EXPECT_EQ(aligned.screen.pixels(), 60 * 40);
}

// A photograph of three times the view's resolution: each pixel is the mean of nine.
TEST(Align, IsAMeanOverThePixel) {
    const Image image = test::random_image(96, 72);
    const Aligned aligned = align(image, rectangle_of(0, 0, 96, 72), 32, 24, rectangle_of(0, 0, 32, 24), none);
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 32; ++x)
            for (int c = 0; c < 3; ++c) {
                double mean = 0;
                for (int k = 0; k < 9; ++k) mean += image.at(3 * x + k % 3, 3 * y + k / 3)[c] / 9.0;
                EXPECT_NEAR(aligned.light.at(x, y)[c], mean, 1e-6);
            }
}

// Light that changes evenly over the plane of the view is known at each of its pixels, whatever the perspective.
TEST(Align, PutsLightWhereItBelongs) {
    const Corners in_view = rectangle_of(12, 9, 152, 109);
    const Homography to_view(trapezoid, in_view);
    Image photograph(900, 700);
    for (int y = 0; y < 700; ++y)
        for (int x = 0; x < 900; ++x) {
            const Point p = to_view(x + 0.5, y + 0.5);
            for (std::size_t c = 0; c < 3; ++c) photograph.at(x, y)[c] = float(c < 2 ? p[c] : p[0] + p[1]);
        }
    const Aligned aligned = align(photograph, trapezoid, 160, 120, in_view, none);
    EXPECT_EQ(aligned.screen.pixels(), 140 * 100);
    for (int y = 9; y < 109; ++y)
        for (int x = 12; x < 152; ++x) {
            EXPECT_NEAR(aligned.light.at(x, y)[0], x + 0.5, 0.01);
            EXPECT_NEAR(aligned.light.at(x, y)[1], y + 0.5, 0.01);
        }
    EXPECT_EQ(aligned.light.at(3, 50)[2], 0);  // beside the screen
}

TEST(Align, TellsWhatIsSaturated) {
    Image image(64, 48);
    image.at(20, 30)[1] = 0.99f;
    const Corners all = rectangle_of(0, 0, 64, 48);
    const auto count = [&](double saturation) {
        const Aligned aligned = align(image, all, 32, 24, rectangle_of(0, 0, 32, 24), saturation);
        EXPECT_EQ(aligned.saturated[15 * 32 + 10], saturation <= 0.99);
        return std::count(aligned.saturated.begin(), aligned.saturated.end(), 1);
    };
    EXPECT_GE(count(0.98), 1);
    EXPECT_LE(count(0.98), 4);  // a sample between two pixels asks both
    EXPECT_EQ(count(1), 0);
}

// Lens dots on black, in colours: as hard for the fit as a display without a diffuser.
Image dots(int width, int height) {
    std::mt19937 engine(7);
    Image image(width, height);
    for (int y = 0; y < height; y += 12)
        for (int x = 0; x < width; x += 12) {
            const float colour[] = {float(engine() % 100) / 100, float(engine() % 100) / 100, float(engine() % 100) / 100};
            for (int j = 2; j < 9 && y + j < height; ++j)
                for (int i = 2; i < 9 && x + i < width; ++i) std::copy_n(colour, 3, image.at(x + i, y + j));
        }
    return image;
}

Aligned as_seen(Image light) {
    const int width = light.width, height = light.height;
    return {std::move(light), Region::of({0, 0, width, height}), std::vector<std::uint8_t>(std::size_t(width) * height)};
}

TEST(Match, FindsGainsBesideWhatDoesNotBelong) {
    const Image view = dots(320, 200);
    Image light = view;
    for (std::size_t i = 0; i < light.rgb.size(); ++i) light.rgb[i] *= i % 3 == 0 ? 0.5f : i % 3 == 1 ? 1.25f : 2;
    const Match clean = match(view, as_seen(light), false, none, 0);
    EXPECT_NEAR(clean.ssim, 1, 1e-6);
    EXPECT_NEAR(clean.rmse, 0, 1e-6);
    for (int y = 60; y < 140; ++y)
        for (int x = 100; x < 220; ++x) std::fill_n(light.at(x, y), 3, 0.9f);  // 15 % of the screen
    const Match covered = match(view, as_seen(light), false, none, 0);
    for (const Match& m : {clean, covered}) {
        EXPECT_NEAR(m.gains[0], 0.5, 1e-5);
        EXPECT_NEAR(m.gains[1], 1.25, 1e-5);
        EXPECT_NEAR(m.gains[2], 2, 1e-5);
    }
    EXPECT_LT(covered.ssim, 0.95);
}

TEST(Match, FindsTheBlur) {
    const Image view = dots(320, 200);
    EXPECT_EQ(match(view, as_seen(view), true, none, 0).blur_px, 0);
    for (const double sigma : {0.6, 1.5, 5.0}) {
        Image light = view;
        for (float& x : light.rgb) x *= 0.7f;
        blur(light.rgb, 320, 200, 3, sigma);
        const Match m = match(view, as_seen(light), true, none, 0);
        EXPECT_NEAR(m.blur_px, sigma, 0.01 * sigma);
        EXPECT_NEAR(m.gains[0], 0.7, 0.001);
        EXPECT_GT(m.ssim, 0.9999);
        EXPECT_LT(match(view, as_seen(light), false, none, 0).ssim, m.ssim);
    }
}

// A photograph cannot hold more than white: the view is cut off there too, and gains rest on the rest.
TEST(Match, AllowsForWhite) {
    const Image view = dots(320, 200);
    Aligned photograph = as_seen(view);
    for (std::size_t i = 0; i < view.rgb.size(); ++i) {
        photograph.light.rgb[i] = std::min(1.6f * view.rgb[i], 1.f);
        photograph.saturated[i / 3] |= 1.6f * view.rgb[i] >= 1;
    }
    const Match m = match(view, photograph, false, 1, 0);
    EXPECT_NEAR(m.gains[1], 1.6, 1e-5);
    EXPECT_NEAR(m.rmse, 0, 1e-6);
    EXPECT_NEAR(m.used, 1 - double(std::count(photograph.saturated.begin(), photograph.saturated.end(), 1)) / (320 * 200), 1e-12);
}

TEST(Match, RefusesWhatTellsNothing) {
    const Image view = dots(320, 200), black(320, 200);
    const auto said = [](const Image& simulated, const Aligned& photograph) {
        return test::input_error([&] { match(simulated, photograph, true, none, 0.001); });
    };
    EXPECT_NE(said(view, as_seen(black)).find("the photograph's red channel is black"), std::string::npos);
    EXPECT_NE(said(black, as_seen(view)).find("the view is black"), std::string::npos);
    Aligned photograph = as_seen(view);
    photograph.saturated.assign(320 * 200, 1);
    EXPECT_NE(said(view, photograph).find("saturated on 100.0 %"), std::string::npos);
    photograph = as_seen(view);
    photograph.screen = Region::of({7, 8, 17, 100});
    EXPECT_NE(said(view, photograph).find("no square of 11 x 11"), std::string::npos);
    photograph.screen = Region::of({7, 8, 7, 100});
    EXPECT_NE(said(view, photograph).find("no part of the screen"), std::string::npos);
}

TEST(FitCorners, FindsThemAndNoFurther) {
    const Image view = dots(320, 200), even = [] {
        Image image(320, 200);
        std::fill(image.rgb.begin(), image.rgb.end(), 0.5f);
        return image;
    }();
    const Corners all = rectangle_of(0, 0, 320, 200), clicked{Point{2, -1}, {317, 1.5}, {321, 202}, {-1, 198}};
    const auto distance = [](const Corners& a, const Corners& b) {
        double most = 0;
        for (std::size_t k = 0; k < 4; ++k) most = std::max(most, std::hypot(a[k][0] - b[k][0], a[k][1] - b[k][1]));
        return most;
    };
    const auto fitted = [&](const Image& picture, double most_px) {
        const Aligned aligned = align(picture, clicked, 320, 200, all, none);
        return fit_corners(picture, all, aligned, {1, 1, 1}, clicked, most_px);
    };
    EXPECT_LT(distance(fitted(view, 5), all), 0.1);
    EXPECT_LT(distance(fitted(view, 1), clicked), 1 + 1e-9);
    EXPECT_GT(distance(fitted(view, 1), clicked), 0.5);
    EXPECT_LT(distance(fitted(even, 5), clicked), 0.01);
    EXPECT_LT(distance(fitted(Image(320, 200), 5), clicked), 1e-9);
}

// Which is not where it would have ended, and is of no use, but soon.
TEST(LayOver, EndsWhereTheJobIsCancelled) {
    struct Stopped : Job {
        bool cancelled() const override { return true; }
    };
    const Image view = dots(320, 200);
    const Corners all = rectangle_of(0, 0, 320, 200), clicked{Point{2, -1}, {317, 1.5}, {321, 202}, {-1, 198}};
    EXPECT_EQ(fit_corners(view, all, align(view, clicked, 320, 200, all, none), {1, 1, 1}, clicked, 5, Stopped())[0][1], -1);
    Image light = view;
    blur(light.rgb, 320, 200, 3, 5);
    EXPECT_LT(match(view, as_seen(light), true, none, 0, Stopped()).blur_px, 1);
    EXPECT_EQ(align(view, all, 320, 200, all, none, {}, Stopped()).light.rgb, Image(320, 200).rgb);
    EXPECT_EQ(lay_over(view, all, {light, true, Encoding::srgb, clicked}, {true, true}, Stopped()).match.simulated.width, 0);
}

// A view in two colours still tells the exposure, as does a region that is no rectangle.
TEST(Match, ColoursThatAreNotThere) {
    Image view = dots(320, 200), light = view;
    for (std::size_t i = 2; i < view.rgb.size(); i += 3) view.rgb[i] = light.rgb[i] = 0;
    for (float& x : light.rgb) x *= 3;
    Aligned photograph = as_seen(light);
    photograph.screen = Region::polygon(Corners{Point{20, 10}, {300, 30}, {280, 190}, {40, 150}}, 320, 200);
    const Match m = match(view, photograph, false, none, 0);
    EXPECT_NEAR(m.gains[2], 3, 1e-5);
    EXPECT_NEAR(m.ssim, 1, 1e-6);
}

}  // namespace
}  // namespace lfdsim
