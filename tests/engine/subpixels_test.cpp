// Subpixels in pictures: single rays against a search over the described rectangles, means over boxes against the area of those
// rectangles.
#include "geometry/subpixels.h"
#include "engine/estimator/panel_planes.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "../model/panels.h"
#include "display/keys.h"
#include "engine/estimator/panel_covariance.h"
#include "engine/scene/traced_display.h"
#include "pictures.h"

namespace lfdsim {
namespace {

/// The light of channel c at a point of the panel, in pixels from its corner, as the description says.
double light_at(const Panel& panel, const Texels& shown, double x, double y, int c) {
    if (x < 0 || y < 0 || x >= double(panel.pixels[0]) || y >= double(panel.pixels[1])) return 0;
    const SubpixelCell cell = subpixel_cell(panel);
    const double across = double(cell.size[0]), down = double(cell.size[1]), side = 0.5 * std::sqrt(panel.aperture_ratio);
    for (const Subpixel& s : cell.subpixels) {
        if (int(s.channel) != c) continue;
        for (int i = -2; i <= 2; ++i)
            for (int j = -2; j <= 2; ++j) {
                const double left = (std::floor(x / across) + i) * across, top = (std::floor(y / down) + j) * down;
                const auto inside = [&](double at, double from, double to) {
                    return at >= 0.5 * (from + to) - side * (to - from) && at < 0.5 * (from + to) + side * (to - from);
                };
                if (!inside(x - left, s.rect[0], s.rect[2]) || !inside(y - top, s.rect[1], s.rect[3])) continue;
                const double column = left + double(s.pixel[0]), row = top + double(s.pixel[1]);
                if (column < 0 || row < 0 || column >= double(panel.pixels[0]) || row >= double(panel.pixels[1])) return 0;
                return gain(panel, c) * double(shown.data()[4 * (std::int64_t(row) * shown.columns() + std::int64_t(column)) + c]);
            }
    }
    return 0;
}

class OfLayout : public testing::TestWithParam<SubpixelLayout> {
  protected:
    static Display display() {
        Display d = ideal_example();
        d.panel = with_subpixels(d.panel, GetParam());
        return d;
    }
};

// Behind lenses that bend nothing a camera's rays end at the points of the frame, which lies in the panel's plane.
TEST_P(OfLayout, RaysMeetTheDescribedRectangles) {
    Display d = display();
    d.lens.as<IdealLens>().focal_length_mm = 1e6;
    const Texels shown = noise_panel(d);
    const int width = 311, height = 211;
    d.camera.resolution = {width, height};
    for (const double frame : {3.0, 1.05 * double(d.panel.pixels[0]) * d.panel.pixel_pitch_mm}) {  // a few pixels; all of the panel
        d.camera.frame_width_mm = frame;
        const Image seen = picture(d, shown);
        const double step = frame / width / d.panel.pixel_pitch_mm;
        std::array<int, 3> lit{};
        int compared = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c) {
                    const double column = 0.5 * double(d.panel.pixels[0]) + (x - 155) * step,
                                 row = 0.5 * double(d.panel.pixels[1]) + (y - 105) * step;
                    const double wanted = light_at(d.panel, shown, column, row, c);
                    bool border = false;
                    for (const double off : {-2e-3, 2e-3})
                        border = border || light_at(d.panel, shown, column + off, row, c) != wanted ||
                                 light_at(d.panel, shown, column, row + off, c) != wanted;
                    if (border) continue;
                    ASSERT_NEAR(seen.at(x, y)[c], wanted, 1e-5) << x << " " << y << " " << c;
                    ++compared;
                    lit[std::size_t(c)] += wanted > 0;
                }
        EXPECT_GT(compared, 2.8 * width * height);
        for (const int each : lit) EXPECT_GT(each, 1000);
    }
}

// 12 rays along each axis of a pixel, over 24 x 16 pixels: all borders of the presets lie between rays.
TEST_P(OfLayout, WhiteIsWhiteInTheMean) {
    Display d = display();
    if (GetParam() == SubpixelLayout::custom) {
        d.panel.aperture_ratio = 1;
        for (Subpixel& s : d.panel.custom)  // borders on twelfths
            for (double& border : s.rect) border = std::round(12 * border) / 12;
    }
    d.lens.as<IdealLens>().focal_length_mm = 1e6;
    d.camera.resolution = {24 * 12, 16 * 12};
    d.camera.frame_width_mm = 24 * d.panel.pixel_pitch_mm;
    const Image seen = picture(d, uniform_panel(d, 1));
    double sum[3] = {};
    for (std::size_t k = 0; k < seen.rgb.size(); ++k) sum[k % 3] += double(seen.rgb[k]);
    for (const double each : sum) EXPECT_NEAR(each / double(seen.rgb.size() / 3), 1, 1e-6);
}

/// A panel of noise, as the filtered estimator reads it.
struct ReadPanel {
    explicit ReadPanel(const Display& d)
        : panel(d.panel),
          shown(noise_panel(d)),
          summed(shown),
          reading{.planes = planes(d.panel)},
          scene(make_traced_display<float>(d, resolve(d))) {
        light = {planes_of(summed, reading).data(), scene.emission.whole, &scene.emission};
    }
    double light_at(double x, double y, int c) const { return lfdsim::light_at(panel, shown, x, y, c); }

    Panel panel;
    Texels shown;
    SummedPanel summed;
    PanelReading reading;
    optics::TracedDisplay<float> scene;
    optics::PanelLight light;
    optics::PanelBase<float> base{40, 30, 0, 0};
};

/// The mean of what the described rectangles show in a box.
double mean_over(const ReadPanel& panel, double x, double y, double wide, double high, int c) {
    const auto part = [](double middle, double size, double from, double to) {
        return std::max(std::min(middle + size / 2, to) - std::max(middle - size / 2, from), 0.0);
    };
    const auto pixels = [](double middle, double size, std::int64_t count) {  // subpixels lie up to a cell away
        return std::pair{std::max(std::int64_t(std::floor(middle - size / 2)) - 3, std::int64_t(0)),
                         std::min(std::int64_t(std::floor(middle + size / 2)) + 3, count - 1)};
    };
    const auto [left, right] = pixels(x, wide, panel.panel.pixels[0]);
    const auto [top, bottom] = pixels(y, high, panel.panel.pixels[1]);
    double sum = 0;
    for (std::int64_t row = top; row <= bottom; ++row)
        for (std::int64_t column = left; column <= right; ++column)
            for (const SubpixelRect& lit : lit_rects(panel.panel, c, column, row)) {
                const double at_x = double(column) + 0.5, at_y = double(row) + 0.5;
                const double columns = double(panel.panel.pixels[0]), rows = double(panel.panel.pixels[1]);
                sum += part(x, wide, std::max(at_x + lit.from[0], 0.0), std::min(at_x + lit.to[0], columns)) *
                       part(y, high, std::max(at_y + lit.from[1], 0.0), std::min(at_y + lit.to[1], rows)) *
                       double(panel.shown.data()[4 * (row * panel.shown.columns() + column) + c]);
            }
    return sum * gain(panel.panel, c) / (wide * high);
}

/// Boxes of up to 20 pixels with their middles from..to, in pixels from the panel's corner.
void expect_means_of_rectangles(const Display& d, std::array<double, 2> from, std::array<double, 2> to) {
    const ReadPanel panel(d);
    Random random(7);
    for (int n = 0; n < 300; ++n) {
        const double wide = std::exp(random(std::log(0.05), std::log(20))), high = std::exp(random(std::log(0.05), std::log(20))),
                     x = random(from[0], to[0]), y = random(from[1], to[1]);
        optics::Light<float> light;
        optics::add_light(panel.light, panel.base,
                          optics::Boxes<float>{float(x - 40), float(y - 30), float(wide), float(high), 1.0f}, light);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(light(0, c), mean_over(panel, x, y, wide, high, c), 1e-3 * gain(d.panel, c))
                << x << " " << y << " " << wide << " x " << high << " " << c;
    }
}

TEST_P(OfLayout, MeansOverBoxesAreThoseOfTheirRectangles) {
    const Display d = display();
    expect_means_of_rectangles(d, {-1, -1}, {double(d.panel.pixels[0]) + 1, double(d.panel.pixels[1]) + 1});
}

/// Light spreads evenly along a line and over a box about its points, both in panel pixels.
struct LineOfBoxes {
    double columns, rows, wide, high;
};

/// RMS of what the light of such spreads differs from the mean over their points: of upright boxes of the same variances, and as
/// the estimator reads them.
struct SpreadErrors {
    double upright = 0, read = 0;
};
SpreadErrors errors_of(const Display& d, const std::function<LineOfBoxes(Random&)>& draw) {
    const ReadPanel panel(d);
    Random random(8);
    SpreadErrors squares;
    constexpr int spreads = 200, along = 128;
    for (int n = 0; n < spreads; ++n) {
        const LineOfBoxes of = draw(random);
        const double x = random(20, 60), y = random(20, 60);
        const auto at_x = float(x - 40), at_y = float(y - 30);
        optics::PanelCovariance<float> line{}, box{};
        line.add(float(of.columns), float(of.rows));
        box.add(float(of.wide), 0);
        box.add(0, float(of.high));
        optics::Light<float> read, upright;
        optics::add_spread(panel.light, panel.base, at_x, at_y, line, box, 1.0f, read);
        optics::add_light(panel.light, panel.base,
                          optics::Boxes<float>{at_x, at_y, std::sqrt(line.w2 + box.w2), std::sqrt(line.h2 + box.h2), 1.0f},
                          upright);
        double truth[3] = {0, 0, 0};  // of boxes, no wider than a pixel, along the line
        for (int k = 0; k < along; ++k) {
            const double share = (k + 0.5) / along - 0.5;
            optics::Light<float> light;
            optics::add_light(panel.light, panel.base,
                              optics::Boxes<float>{at_x + float(share * of.columns), at_y + float(share * of.rows), float(of.wide),
                                                   float(of.high), 1.0f},
                              light);
            for (int c = 0; c < 3; ++c) truth[c] += double(light(0, c)) / along;
        }
        for (int c = 0; c < 3; ++c) {
            const auto add = [&](double& to, float light) { to += (light - truth[c]) * (light - truth[c]) / (3 * spreads); };
            add(squares.read, read(0, c));
            add(squares.upright, upright(0, c));
        }
    }
    return {std::sqrt(squares.upright), std::sqrt(squares.read)};
}

TEST_P(OfLayout, LeaningLinesAreNotBoxes) {
    for (const bool along_rows : {false, true}) {
        const auto error = errors_of(display(), [=](Random& random) {
            const double length = random(0.4, 4), aside = length * random(0.2, 0.5) * (random(0, 1) < 0.5 ? -1 : 1);
            const double wide = random(0.02, 0.3), high = random(0.02, 0.3);
            return along_rows ? LineOfBoxes{length, aside, wide, high} : LineOfBoxes{aside, length, wide, high};
        });
        EXPECT_LT(error.read, 0.2 * error.upright) << along_rows << " " << error.read << " of " << error.upright;
    }
}

// Of so small ones the differences from box to box would be lost in rounding.
TEST_P(OfLayout, SmallSpreadsLoseNoLight) {
    const auto error = errors_of(display(), [](Random& random) {
        return LineOfBoxes{random(0, 0.01), random(0, 0.01), random(0, 0.004), random(0, 0.004)};
    });
    EXPECT_LT(error.read, 0.02 + error.upright);
}

TEST(Subpixels, NothingShinesBeyondABorderThatCutsCells) {
    Display d = ideal_example();
    d.panel.subpixels = SubpixelLayout::custom;
    d.panel.subpixel_cell = {{3, 2}};
    d.panel.custom = {{Channel::r, {0, 0}, {1.1, 0, 2.4, 1}},
                      {Channel::g, {0, 0}, {0.3, 0.2, 1.1, 1.7}},
                      {Channel::b, {0, 0}, {2.4, 0.5, 2.9, 2}},
                      {Channel::b, {2, 1}, {1.2, 1, 2.4, 1.4}}};
    for (const std::int64_t columns : {121, 122}) {
        d.panel.pixels = {columns, 81};
        ASSERT_TRUE(validate(d).empty()) << validate(d).front().what;
        expect_means_of_rectangles(d, {double(columns) - 4, 40}, {double(columns) + 2, 83});
        expect_means_of_rectangles(d, {0, 77}, {double(columns) + 1, 83});
    }
}

INSTANTIATE_TEST_SUITE_P(Subpixels, OfLayout,
                         testing::Values(SubpixelLayout::rgb_stripe, SubpixelLayout::bgr_stripe, SubpixelLayout::rgb_rows,
                                         SubpixelLayout::pentile_rgbg, SubpixelLayout::delta, SubpixelLayout::custom),
                         [](const auto& of) { return std::string(word(of.param)); });

}  // namespace
}  // namespace lfdsim
