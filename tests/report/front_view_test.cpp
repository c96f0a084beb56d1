// The cells from the front: their corners against the lattice's own figures.
#include "report/drawings/front_view.h"
#include "base/constants.h"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

namespace lfdsim {
namespace {

constexpr double side = 200;

/// Corners of the first path whose attributes contain a text, pixels from the square's middle, y up.
std::vector<Point> corners_of(const Display& d, const std::string& attribute) {
    SvgDrawing drawing(side, side, "cells");
    draw_front(drawing, {0, 0}, side, d, resolve(d));
    const std::string svg = drawing.svg();
    const std::regex path("<path d=\"M([^\"z]*)z\" ([^>]*)/>");
    for (std::sregex_iterator found(svg.begin(), svg.end(), path), end; found != end; ++found) {
        if ((*found)[2].str().find(attribute) == std::string::npos) continue;
        std::istringstream numbers((*found)[1]);
        std::vector<Point> points;
        for (Point p; numbers >> p[0] >> p[1];) points.push_back({p[0] - side / 2, side / 2 - p[1]});
        return points;
    }
    return {};
}
std::vector<Point> middle_cell(const Display& d) { return corners_of(d, "stroke-width=\"1.6\""); }

Display display(LatticeKind lattice) {
    Display d;
    d.panel.pixels = {400, 300};
    d.panel.pixel_pitch_mm = 0.1;
    d.lens.kind = IdealLens{0.4, 4};
    d.array.lattice = lattice;
    d.array.pitch_mm = 2;
    d.array.gap_mm = 4;
    d.array.aperture = Aperture::circle;
    return d;
}

TEST(FrontView, HexagonsHaveTheirCornersUpAndDownBeforeTheTurn) {
    Display d = display(LatticeKind::hexagon);
    d.array.rotation_deg = 10;
    const std::vector<Point> corners = middle_cell(d);
    ASSERT_EQ(corners.size(), 6u);
    const double scale = side / (2.5 * 2);
    bool upper = false;
    for (const auto& [x, y] : corners) {
        EXPECT_NEAR(std::hypot(x, y), scale * 2 / std::sqrt(3.), 0.02);
        upper = upper || std::abs(std::remainder(std::atan2(y, x) / degree - 100, 360)) < 0.1;
    }
    EXPECT_TRUE(upper);
    // The clear aperture is a disk of 0.4 mm.
    for (const auto& [x, y] : corners_of(d, "fill-opacity=\"0.5\"")) EXPECT_NEAR(std::hypot(x, y), scale * 0.4, 0.02);
}

TEST(FrontView, StripsLeanToTheRight) {
    Display d = display(LatticeKind::strips);
    d.array.slant_deg = 20;
    const std::vector<Point> corners = middle_cell(d);
    ASSERT_EQ(corners.size(), 4u);
    const double scale = side / (2.5 * 2), c = std::cos(20 * degree), s = std::sin(20 * degree);
    for (const auto& [x, y] : corners) {
        EXPECT_NEAR(std::abs(c * x - s * y), scale * 1, 0.02);  // half a pitch across
        EXPECT_GT(std::abs(s * x + c * y), 0.7 * side);         // out of the square
    }
}

TEST(FrontView, BricksAreRectangles) {
    Display d = display(LatticeKind::brick);
    d.array.pitch_mm = {2, 3};
    const std::vector<Point> corners = middle_cell(d);
    ASSERT_EQ(corners.size(), 4u);
    for (const auto& [x, y] : corners) {
        EXPECT_NEAR(std::abs(x), side / 7.5 * 1, 0.02);
        EXPECT_NEAR(std::abs(y), side / 7.5 * 1.5, 0.02);
    }
}

}  // namespace
}  // namespace lfdsim
