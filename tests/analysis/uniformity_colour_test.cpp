// Colour over a white screen and over angle: ideal lenses and pinholes over stripes, where the colour seen through each has a
// closed form, and glass that disperses, by Snell's law.
#include "analysis/uniformity/uniformity_colour.h"
#include "analysis/uniformity/uniformity.h"
#include "base/constants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace lfdsim::colour_uniformity {
namespace {

constexpr double eye_mm = 600, gap = 3, pitch = 1.07, pixel = 0.21;
constexpr int across = 24, up = 8;  // lenses; parts are single ones

Display stripes() {
    Display d;
    d.panel.pixels = {150, 60};
    d.panel.pixel_pitch_mm = pixel;
    d.panel.subpixels = SubpixelLayout::rgb_stripe;
    d.array.count = {across, up};
    d.array.pitch_mm = pitch;
    d.array.gap_mm = gap;
    d.array.aperture = Aperture::cell;
    d.camera.position_mm = {0, 0, eye_mm};
    d.content.viewing_distance_mm = eye_mm;
    return d;
}

Json colours_of(const Display& d, Result& result) {
    const Subject s(d, {}, {});
    Job job;
    Parts parts(job, 0, colour_work(s).parts, 0);
    tell_colour_uniformity(s, eye_mm, parts, result);
    return result.figures["colour"];
}

/// Distances of colours from that of their sum, each counted alike: the largest and the mean.
struct Distances {
    double largest = 0, mean = 0;
};
Distances distances(const std::vector<std::array<double, 3>>& all) {
    std::array<double, 3> sum{};
    for (const auto& rgb : all)
        for (std::size_t c = 0; c < 3; ++c) sum[c] += rgb[c];
    const auto uv = [](const std::array<double, 3>& rgb) {
        const double x = 0.4124 * rgb[0] + 0.3576 * rgb[1] + 0.1805 * rgb[2],
                     y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2],
                     z = 0.0193 * rgb[0] + 0.1192 * rgb[1] + 0.9505 * rgb[2], s = x + 15 * y + 3 * z;
        return std::array{4 * x / s, 9 * y / s};
    };
    Distances found;
    for (const auto& rgb : all) {
        const double away = std::hypot(uv(rgb)[0] - uv(sum)[0], uv(rgb)[1] - uv(sum)[1]);
        found.largest = std::max(found.largest, away);
        found.mean += away / double(all.size());
    }
    return found;
}

double axis_of(int lens, int lenses) { return (lens + 0.5 - 0.5 * lenses) * pitch; }

/// Light in each colour of a stretch of the panel, over white's, if stripes are shrunk by a factor.
std::array<double, 3> of_stretch(double from, double to, double shrink) {
    std::array<double, 3> light{};
    for (int c = 0; c < 3; ++c)
        for (double k = std::floor(from / pixel) - 1; k <= to / pixel + 1; ++k) {
            const double middle = (k + (c + 0.5) / 3) * pixel, half = shrink * pixel / 6;
            light[std::size_t(c)] += std::max(0., std::min(to, middle + half) - std::max(from, middle - half)) / (to - from);
        }
    return light;
}

// CIE 15: illuminant D65, and the primaries of IEC 61966-2-1.
TEST(Chromaticity, IsThatOfThePrimaries) {
    const std::pair<std::array<double, 3>, Chromaticity> known[] = {{{1, 1, 1}, {0.1978, 0.4683}},
                                                                    {{1, 0, 0}, {0.4507, 0.5229}},
                                                                    {{0, 0.3, 0}, {0.1250, 0.5625}},
                                                                    {{0, 0, 2}, {0.1754, 0.1579}}};
    for (const auto& [rgb, uv] : known)
        for (const std::size_t k : {0u, 1u}) EXPECT_NEAR(chromaticity(rgb)[k], uv[k], 2e-4);
    EXPECT_TRUE(std::isnan(chromaticity({0, 0, 0})[0]));
}

// A part within its noise of a tenth of the mean luminance may be dark or not: the error covers both.
TEST(Chromaticity, ErrorsCoverPartsAtTheLimitOfDarkness) {
    for (const double brightness : {0.0990, 0.0999, 0.1001, 0.1010}) {  // over the mean of all
        std::vector<ColourSums> parts(10);
        for (std::size_t k = 0; k < parts.size(); ++k)
            for (std::size_t set = 0; set < independent_sets; ++set) {
                const double noise = 0.03 * (set % 2 == 0 ? 1 : -1), blue = k % 2 == 0 ? 1 : 1.2;
                if (k > 0) parts[k][0][set] = parts[k][1][set] = 1, parts[k][2][set] = blue;
                if (k == 0) parts[k][0][set] = 3 * brightness * (1 + noise);
            }
        double rest = 0;
        for (std::size_t k = 1; k < parts.size(); ++k) rest += 0.9278 + 0.0722 * parts[k][2][0];
        const double mean = rest / (10 - brightness), red = brightness * mean / 0.2126;  // its luminance: that share of the mean
        for (std::size_t set = 0; set < independent_sets; ++set) parts[0][0][set] = red * (1 + 0.03 * (set % 2 == 0 ? 1 : -1));
        const ColourSpread found = colour_spread(parts, std::vector(10, 1.));
        std::vector<std::array<double, 3>> lit;
        for (std::size_t k = 1; k < parts.size(); ++k) lit.push_back({1, 1, parts[k][2][0]});
        const Distances dark = distances(lit);
        lit.push_back({red, 0, 0});
        const Distances all = distances(lit);
        ASSERT_GT(all.mean, dark.mean + 0.02);
        for (const Distances& either : {dark, all}) {
            EXPECT_NEAR(found.mean.value, either.mean, found.mean.error + 1e-9) << brightness;
            EXPECT_NEAR(found.largest.value, either.largest, found.largest.error + 1e-9) << brightness;
        }
    }
}

// Between the eyes' angles, too, colours are what the figures say: a lens in focus shows one stripe after the other.
TEST(ColourUniformity, ErrorsOverAngleCoverAnglesBetween) {
    Display d = stripes();
    d.lens.kind = IdealLens{{}, 1 / (1 / gap + 1 / (eye_mm - gap))};
    Result result;
    const Json json = colours_of(d, result);
    std::vector<std::array<double, 3>> all;
    constexpr int fine = 20000;
    const double half = json["angle_deg"][1].get<double>() * degree, axis = axis_of((across - 1) / 2, across);
    for (int k = 0; k < fine; ++k) {
        const double angle = half * ((k + 0.5) / fine * 2 - 1), x = eye_mm * std::sin(angle), z = eye_mm * std::cos(angle) - gap;
        const double in_pixel = (axis + (axis - x) * gap / z) / pixel, stripe = 3 * (in_pixel - std::floor(in_pixel));
        std::array<double, 3> light{};
        light[std::size_t(stripe)] = 3;
        all.push_back(light);
    }
    EXPECT_NEAR(json["horizontal_delta_uv_mean"], distances(all).mean, json["horizontal_delta_uv_mean_error"].get<double>());
    EXPECT_NEAR(json["horizontal_delta_uv_largest"], distances(all).largest,
                json["horizontal_delta_uv_largest_error"].get<double>());
    EXPECT_LT(json["horizontal_delta_uv_mean_error"], 0.03);
}

// A lens that images the eye onto the panel shows one point, and so one colour, without noise.
TEST(ColourUniformity, InFocusEachLensHasTheColourOfOneStripe) {
    Display d = stripes();
    d.lens.kind = IdealLens{{}, 1 / (1 / gap + 1 / (eye_mm - gap))};
    std::vector<std::array<double, 3>> expected;
    for (int k = 0; k < across; ++k) {
        const double in_pixel = axis_of(k, across) * (1 + gap / (eye_mm - gap)) / pixel,
                     stripe = 3 * (in_pixel - std::floor(in_pixel));
        std::array<double, 3> light{};
        light[std::size_t(stripe)] = 3;
        ASSERT_GT(std::abs(stripe - std::round(stripe)), 1e-3);
        expected.push_back(light);
    }
    Result result;
    const Json json = colours_of(d, result);
    EXPECT_NEAR(json["screen_delta_uv_largest"], distances(expected).largest, 1e-9);
    EXPECT_NEAR(json["screen_delta_uv_mean"], distances(expected).mean, 1e-9);
    EXPECT_LT(json["screen_delta_uv_largest_error"], 1e-9);
    EXPECT_LT(json["screen_delta_uv_mean_error"], 1e-9);
    EXPECT_GT(json["screen_delta_uv_mean"], 0.1);
    EXPECT_EQ(json["dark_parts"], 0);
}

// Out of focus a lens shows a stretch of the panel; seeds change the noise, and the error covers it.
TEST(ColourUniformity, OutOfFocusIsThatOfStretchesOfStripes) {
    Display d = stripes();
    d.panel.aperture_ratio = 0.5;
    const double f = 3.9;
    d.lens.kind = IdealLens{{}, f};
    std::vector<std::array<double, 3>> expected;
    for (int k = 0; k < across; ++k) {
        const double middle = axis_of(k, across) * (1 + gap / (eye_mm - gap)),
                     half = 0.5 * pitch * std::abs(1 + gap / (eye_mm - gap) - gap / f);
        expected.push_back(of_stretch(middle - half, middle + half, std::sqrt(0.5)));
    }
    const Distances truth = distances(expected);
    EXPECT_GT(truth.largest, 0.02);
    int covered = 0;
    constexpr int seeds = 8;
    for (int seed = 0; seed < seeds; ++seed) {
        d.render.seed = seed;
        Result result;
        const Json json = colours_of(d, result);
        EXPECT_NEAR(json["screen_delta_uv_largest"], truth.largest, 0.05 * truth.largest) << seed;
        EXPECT_NEAR(json["screen_delta_uv_mean"], truth.mean, 0.05 * truth.mean) << seed;
        covered += std::abs(json["screen_delta_uv_largest"].get<double>() - truth.largest) <= json["screen_delta_uv_largest_error"];
        covered += std::abs(json["screen_delta_uv_mean"].get<double>() - truth.mean) <= json["screen_delta_uv_mean_error"];
    }
    EXPECT_GE(covered, 2 * seeds - 2);
}

// Through a pinhole and a plate that disperses each colour comes from a place of its own.
TEST(ColourUniformity, ColoursGoThroughDispersingGlassBySnellsLaw) {
    Display d = stripes();
    constexpr double plate = 2.5, hole = 0.012;
    constexpr int rows = 2;
    d.array.count = {across, rows};
    d.panel.layers = {{plate, {}, Glass{"", Formula::nd_vd, {1.6, 9}}}};
    d.lens.kind = Pinhole{hole};
    d.array.aperture = Aperture::circle;
    d.array.offset_mm = {150, 0};  // so that light is oblique
    d.panel.pixels = {1800, 60};
    const auto per_square = [](double nm) { return 1e6 / (nm * nm); };
    const double b = 0.6 / 9 / (per_square(486.1327) - per_square(656.2725));
    const auto index = [&](double nm) { return 1.6 + b * (per_square(nm) - per_square(587.5618)); };
    const double z = gap + plate - plate / index(d.panel.wavelengths_nm[1]);  // of the sheet of pinholes
    Result result;
    colours_of(d, result);
    const auto table =
        std::find_if(result.tables.begin(), result.tables.end(), [](const DataTable& t) { return t.name == "uniformity_colour"; });
    int compared = 0, mixed = 0;
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k < across; ++k) {
            const double x = axis_of(k, across) + 150, y = axis_of(rows - 1 - row, rows), tangent = std::hypot(x, y) / (eye_mm - z);
            std::array<double, 3> light{};
            bool sure = true;
            for (std::size_t c = 0; c < 3; ++c) {
                const double sine = tangent / std::sqrt(1 + tangent * tangent) / index(d.panel.wavelengths_nm[c]);
                const double slope = x / (eye_mm - z),
                             seen = x + (z - plate) * slope + plate * slope / tangent * sine / std::sqrt(1 - sine * sine);
                const double stripe = 3 * (seen / pixel - std::floor(seen / pixel));
                light[c] = int(stripe) == int(c) ? 3 : 0;
                sure = sure && std::abs(stripe - std::round(stripe)) * pixel / 3 > 1.5 * hole;
            }
            mixed += light[0] + light[1] + light[2] != 3;
            if (!sure || light[0] + light[1] + light[2] == 0) continue;
            const auto part = std::size_t(row * across + k);
            EXPECT_NEAR(table->columns[2].values[part], chromaticity(light)[0], 1e-6) << row << " " << k;
            EXPECT_NEAR(table->columns[3].values[part], chromaticity(light)[1], 1e-6) << row << " " << k;
            ++compared;
        }
    EXPECT_GT(compared, 10);
    EXPECT_GT(mixed, 5);  // without dispersion there is exactly one colour
}

TEST(ColourUniformity, OverAngleTheSlitInTheMiddleRunsOverStripes) {
    Display d = stripes();
    constexpr double slit = 0.02;
    d.lens.kind = Pinhole{slit};
    d.array.lattice = LatticeKind::strips;
    d.array.slant_deg = 0;
    d.array.count.reset();
    d.array.aperture = Aperture::circle;
    Result result;
    const Json json = colours_of(d, result);
    const auto table = std::find_if(result.tables.begin(), result.tables.end(),
                                    [](const DataTable& t) { return t.name == "uniformity_colour_angle"; });
    std::vector<std::array<double, 3>> expected;
    const int strips = int(resolve(d).lattice.count[0]);
    const double lens = axis_of((strips - 1) / 2, strips);
    for (const double angle : table->columns[0].values) {
        const double slope = (eye_mm * std::sin(angle * degree) - lens) / (eye_mm * std::cos(angle * degree) - gap),
                     half = slit * (1 + gap / (eye_mm * std::cos(angle * degree) - gap));
        expected.push_back(of_stretch(lens - gap * slope - half, lens - gap * slope + half, 1));
    }
    EXPECT_NEAR(json["horizontal_delta_uv_largest"], distances(expected).largest, 0.02 * distances(expected).largest);
    EXPECT_NEAR(json["horizontal_delta_uv_mean"], distances(expected).mean, 0.03 * distances(expected).mean);
    EXPECT_LT(json["vertical_delta_uv_largest"], 1e-9);  // stripes have no end upwards
}

TEST(ColourUniformity, WithoutColoursItIsExactlyEven) {
    Display d = stripes();
    d.lens.kind = IdealLens{{}, 3.1};
    d.panel.subpixels = SubpixelLayout::none;
    d.panel.aperture_ratio = 0.5;
    Result result;
    const Json json = colours_of(d, result);
    for (const char* name : {"screen", "horizontal", "vertical"})
        for (const char* figure : {"_delta_uv_largest", "_delta_uv_mean", "_delta_uv_largest_error", "_delta_uv_mean_error"})
            EXPECT_EQ(json[std::string(name) + figure], 0) << name << figure;
    EXPECT_TRUE(result.tables.empty() && result.maps.empty());
}

TEST(ColourUniformity, OfAScreenThatNobodySeesIsNull) {
    Display d = stripes();
    d.lens.kind = IdealLens{{}, 3.1};
    d.array.offset_mm = {5000, 0};
    Result result;
    EXPECT_TRUE(colours_of(d, result)["screen_delta_uv_largest"].is_null());
    EXPECT_TRUE(result.notes.contains("colour.screen_delta_uv_largest"));
}

// The pictures of a white screen: in the mean as white as the panel, with colours in them where there are subpixels.
TEST(ColourUniformity, IsShownInPictures) {
    Display d = stripes();
    d.lens.kind = IdealLens{{}, 1 / (1 / gap + 1 / (eye_mm - gap))};
    d.camera.resolution = {240, 144};
    d.panel.pixels[1] = 90;
    (*d.array.count)[1] = 14;  // so that all of the picture from near by is screen
    Subject s(d, {}, {});
    Job job;
    const Result result = measure_uniformity(s, job);
    ASSERT_EQ(result.pictures.size(), 2u);
    const Image& close = result.pictures[1].image;
    std::array<double, 3> sum{};
    float most = 0, least = 1;
    for (std::size_t k = 0; k < close.rgb.size(); ++k) {
        sum[k % 3] += double(close.rgb[k]) / double(close.rgb.size() / 3);
        most = std::max(most, close.rgb[k]);
        least = std::min(least, close.rgb[k]);
    }
    EXPECT_EQ(most, 1);
    EXPECT_EQ(least, 0);
    EXPECT_NEAR(sum[0] + sum[1] + sum[2], 1, 0.01);  // each lens shows one of three colours, all as bright
}

}  // namespace
}  // namespace lfdsim::colour_uniformity
