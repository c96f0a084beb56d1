// Plots and maps as SVG: axes, what is drawn of bad and empty data, and that any text gives valid XML.
#include "report/plots/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "../image/helpers.h"
#include "base/constants.h"
#include "report/pages/base64.h"
#include "report/plots/svg_axes.h"

namespace lfdsim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> labels(const PlotAxis& axis) {
    std::vector<std::string> all;
    for (const double tick : axis.ticks()) all.push_back(axis.label(tick));
    return all;
}

TEST(PlotAxis, HasRoundTicks) {
    EXPECT_THAT(labels({0, 1, 5}), ElementsAre("0", "0.2", "0.4", "0.6", "0.8", "1.0"));
    EXPECT_THAT(labels({-30, 30, 6}), ElementsAre("−30", "−20", "−10", "0", "10", "20", "30"));
    EXPECT_THAT(labels({0.71, 0.79, 4}), ElementsAre("0.72", "0.74", "0.76", "0.78"));
    EXPECT_THAT(labels({0, 4e7, 4}), ElementsAre("0", "1e+07", "2e+07", "3e+07", "4e+07"));
    EXPECT_THAT(labels({1000, 1000.2, 2}), ElementsAre("1000.0", "1000.1", "1000.2"));
}

TEST(PlotAxis, StaysSoundForAnyRange) {
    for (const auto& [low, high] : {std::pair(0., 0.), {5., 5.}, {-1e300, 1e300}, {1e-300, 2e-300}, {1e20, 1e20}, {1., -1.}}) {
        const PlotAxis axis(low, high, 6);
        EXPECT_LT(axis.low(), axis.high());
        EXPECT_GE(axis.ticks().size(), 1u) << low;
        EXPECT_LE(axis.ticks().size(), 8u) << low;
    }
}

Plot plot(std::vector<Series> series) { return {"name", "A title", "angle, deg", "SSIM", std::move(series)}; }

/// Curves that are drawn: paths of the width of curves in the frame.
int curves(const std::string& svg) {
    const std::regex curve("<path d=\"M[^\"]*\" stroke=\"#[0-9a-f]{6}\" stroke-width=\"2\"");
    return int(std::distance(std::sregex_iterator(svg.begin(), svg.end(), curve), std::sregex_iterator()));
}

TEST(PlotSvg, BreaksCurvesWhereThereIsNoNumber) {
    EXPECT_EQ(curves(svg(plot({{"", {0, 1, 2, 3, 4, 5}, {1, 2, 3, 2, 1, 0}}}))), 1);
    EXPECT_EQ(curves(svg(plot({{"", {0, 1, 2, 3, 4, 5}, {1, 2, nan, 2, 1, 0}}}))), 2);
    // A place alone between two gaps is a dot, not lost.
    const std::string alone = svg(plot({{"", {0, 1, 2, 3, 4}, {1, nan, 2, infinity, 1}}}));
    EXPECT_EQ(curves(alone), 0);
    EXPECT_THAT(alone, HasSubstr("h0M"));
}

TEST(PlotSvg, LineIsWhereTheNumbersAre) {
    // Two points at the frame's left and right: the path's ends are the frame's, which the rectangle tells.
    const std::string text = svg(plot({{"", {10, 20}, {0, 1}}}));
    std::smatch frame, curve;
    ASSERT_TRUE(std::regex_search(text, frame,
                                  std::regex("<rect x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\" height=\"([0-9.]+)\"")));
    ASSERT_TRUE(
        std::regex_search(text, curve, std::regex("<path d=\"M([0-9.]+) ([0-9.]+) ([0-9.]+) ([0-9.]+)\" stroke=\"#1f7fc0\"")));
    const auto number = [](const auto& match) { return std::stod(match.str()); };
    const double left = number(frame[1]), top = number(frame[2]), width = number(frame[3]), height = number(frame[4]);
    EXPECT_NEAR(number(curve[1]), left, 0.02);
    EXPECT_NEAR(number(curve[3]), left + width, 0.02);
    EXPECT_NEAR(number(curve[2]), top + height, 0.02);                // 0 is the foot of the axis
    EXPECT_NEAR(number(curve[4]), top + height * 0.05 / 1.05, 0.02);  // 5 % room above
}

TEST(PlotSvg, DrawsWhatHasNoWidthOrNothing) {
    for (const Plot& p : {plot({}), plot({{"none", {}, {}}}), plot({{"nan", {nan, 1}, {0, nan}}}), plot({{"one", {3}, {4}}}),
                          plot({{"flat", {0, 1}, {2, 2}}}), plot({{"huge", {0, 1}, {-1e308, 1e308}}})}) {
        const std::string text = svg(p);
        EXPECT_THAT(text, HasSubstr("A title"));
        EXPECT_THAT(text, Not(HasSubstr("nan\"")));
        EXPECT_THAT(text, Not(HasSubstr("inf")));
    }
    EXPECT_THROW(svg(plot({{"", {0, 1}, {2}}})), std::invalid_argument);
}

TEST(PlotSvg, NamesMarksWithinAndOutside) {
    Plot p = plot({{"a", {0, 10}, {0, 1}}, {"b", {0, 10}, {1, 0}}});
    p.marks = {{"theory", 5}, {"far", 1e6}, {"threshold", 0.85, false}, {"nowhere", nan}};
    const std::string text = svg(p);
    EXPECT_THAT(text, HasSubstr(">theory<"));
    EXPECT_THAT(text, HasSubstr(">threshold<"));
    EXPECT_THAT(text, HasSubstr(">far: at 1e+06, outside<"));
    EXPECT_THAT(text, Not(HasSubstr("nowhere")));
}

TEST(PlotSvg, DrawsIntervalsAsBarsCutAtTheAxis) {
    Plot p = plot({{"", {-10, 10}, {1, 2}}});
    p.bars = {{"through infinity", {{-infinity, -5}, {5, 99}}}, {"far away", {{40, 50}}}};
    const std::string drawn = svg(p);
    const std::regex bar("<rect x=\"([0-9.]+)\" y=\"[0-9.]+\" width=\"([0-9.]+)\"[^>]*fill-opacity=\"0.35\"");
    std::vector<double> left, wide;
    for (std::sregex_iterator at(drawn.begin(), drawn.end(), bar), end; at != end; ++at)
        left.push_back(std::stod((*at)[1])), wide.push_back(std::stod((*at)[2]));
    ASSERT_EQ(left.size(), 2u);
    EXPECT_NEAR(wide[0], wide[1], 0.02);
    EXPECT_NEAR(left[1] - left[0], 3 * wide[0], 0.03);  // from -10 and from 5, 5 long
    EXPECT_THAT(drawn, HasSubstr("far away: nowhere here"));
}

TEST(PlotSvg, HasOneScaleForBothAxesWhereAsked) {
    Plot p = plot({{"", {0, 4}, {0, 1}, true}});
    p.equal_axes = true;
    std::smatch d;
    const std::string text = svg(p);
    ASSERT_TRUE(std::regex_search(text, d, std::regex("<path d=\"M([0-9.]+) ([0-9.]+)h0M([0-9.]+) ([0-9.]+)h0\"")));
    const double right = std::stod(d[3]) - std::stod(d[1]), up = std::stod(d[2]) - std::stod(d[4]);
    EXPECT_NEAR(right / up, 4, 0.01);
}

// In DejaVu Sans of 12 pixels it is 110.5 pixels wide.
TEST(PlotSvg, LabelsEndWithinTheDrawing) {
    EXPECT_GE(text_width("edge by geometry", 12), 110.5);
    EXPECT_LE(text_width("edge by geometry", 12), 112.5);
    Plot p = plot({{"", {-30, 30}, {0, 1}}});
    p.marks = {{"edge by geometry", -29}, {"edge by geometry", 28}, {"a limit", 0.5, false}};
    const std::string text = svg(p);
    const std::regex place("<text x=\"([0-9.]+)\"[^>]*font-size=\"12\">([^<]*)<");
    int labels = 0;
    for (std::sregex_iterator at(text.begin(), text.end(), place), end; at != end; ++at, ++labels)
        EXPECT_LE(std::stod((*at)[1]) + text_width((*at)[2].str(), 12), 600) << (*at)[2];
    EXPECT_EQ(labels, 3);
}

TEST(Labels, NeitherTouchEachOtherNorALine) {
    const std::vector<double> lines{70, 76, 104, 133, 133, 163, 690};
    const std::vector<std::string> texts{"panel",          "lenses", "marginal plane", "diffuser", "central depth plane",
                                         "marginal plane", "the eye"};
    const std::vector<LabelPlace> places = place_labels(lines, texts, 12, 720);
    for (std::size_t a = 0; a < lines.size(); ++a) {
        const double from = places[a].x, to = from + text_width(texts[a], 12);
        EXPECT_LE(to, 720);
        for (std::size_t b = 0; b < lines.size(); ++b) {
            if (a == b) continue;
            const bool beside = to < places[b].x || from > places[b].x + text_width(texts[b], 12);
            EXPECT_TRUE(beside || places[a].row != places[b].row) << texts[a] << ", " << texts[b];
            if (lines[b] >= 690) continue;
            EXPECT_TRUE(lines[b] <= from || lines[b] > to || places[b].row < places[a].row) << texts[a];
        }
    }
}

ColourMap map() {
    return {"map", "A map", "x, mm", "y, mm", "light", -10, 10, -5, 5, 4, 2, {0, 0.2, 0.4, 0.6, 0.8, 1, nan, 2}, 0, 1};
}

TEST(MapSvg, HoldsOnePixelForEachValue) {
    const std::string text = svg(map());
    std::smatch image;
    ASSERT_TRUE(std::regex_search(
        text, image, std::regex("width=\"([0-9.]+)\" height=\"([0-9.]+)\" preserveAspectRatio=\"none\"[^>]*base64,([^\"]*)\"")));
    EXPECT_NEAR(std::stod(image[1]) / std::stod(image[2]), 2, 0.01);  // mm along both axes
    std::string png;
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : image[3].str()) {  // back from base64
        if (c == '=') break;
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        bits = bits << 6 | std::uint32_t(digits.find(c));
        if ((count += 6) >= 8) png += char(bits >> (count -= 8) & 0xff);
    }
    const test::TemporaryFolder folder;
    test::save(folder / "map.png", png);
    const std::string command = "cd '" + folder.path().string() +
                                "' && /usr/bin/python3 -c \"from PIL import Image\np = Image.open('map.png')\n"
                                "assert (p.mode, p.size) == ('RGBA', (4, 2))\nopen('raw', 'wb').write(p.tobytes())\"";
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string codes = test::load(folder / "raw");
    ASSERT_EQ(codes.size(), 32u);
    const auto code = [&](int x, int y, int c) { return std::uint8_t(codes[std::size_t(4 * (4 * y + x) + c)]); };
    const auto light = [&](int x, int y) {
        return 0.2126 * double(code(x, y, 0)) + 0.7152 * double(code(x, y, 1)) + 0.0722 * double(code(x, y, 2));
    };
    EXPECT_LT(light(0, 0), light(1, 0));
    EXPECT_LT(light(1, 0), light(2, 0));
    EXPECT_LT(light(2, 0), light(3, 0));
    EXPECT_LT(light(3, 0), light(0, 1));
    EXPECT_LT(light(0, 1), light(1, 1));
    EXPECT_EQ(light(1, 1), light(3, 1));  // beyond the scale: its end
    EXPECT_EQ(code(1, 1, 3), 255);
    EXPECT_EQ(code(2, 1, 3), 0);  // no number

    ColourMap bad = map();
    bad.values.pop_back();
    EXPECT_THROW(svg(bad), std::invalid_argument);
    bad = map();
    bad.low = nan;
    EXPECT_THROW(svg(bad), std::invalid_argument);
}

TEST(Base64, HasTheVectorsOfItsStandard) {  // RFC 4648, section 10
    for (const auto& [bytes, text] : {std::pair("", ""),
                                      {"f", "Zg=="},
                                      {"fo", "Zm8="},
                                      {"foo", "Zm9v"},
                                      {"foob", "Zm9vYg=="},
                                      {"fooba", "Zm9vYmE="},
                                      {"foobar", "Zm9vYmFy"}})
        EXPECT_EQ(base64(bytes), text);
}

TEST(Svg, IsValidXmlWhateverTextItHolds) {
    const std::string nasty = "a<b & \"c\" 'd' ]]> \x01\x1b[31m \xff\xfe \xc3\xa9 </text>";
    Plot p{"n", nasty, nasty, nasty, {{nasty, {0, 1}, {0, 1}}, {nasty, {0, 1}, {1, 0}, true}}};
    p.marks = {{nasty, 0.5}, {nasty, 0.5, false}, {nasty, 99}};
    ColourMap m = map();
    m.title = m.x_label = m.y_label = m.value_label = nasty;
    const test::TemporaryFolder folder;
    test::save(folder / "plot.svg", svg(p));
    test::save(folder / "map.svg", svg(m));
    const std::string command = "cd '" + folder.path().string() +
                                "' && /usr/bin/python3 -c \"import xml.etree.ElementTree as e\n"
                                "for f in ['plot.svg', 'map.svg']:\n"
                                "    t = e.parse(f).getroot()\n"
                                "    assert 'a<b & ' in t[0].text and '\\u00e9' in t[0].text, t[0].text\"";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

}  // namespace
}  // namespace lfdsim
