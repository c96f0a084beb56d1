// Test patterns. docs/model.md, "Test patterns".

#include "base/constants.h"
#include "base/problems.h"
#include "content/content.h"
#include "content/pickup/pickup.h"
#include "geometry/lens_misalignment.h"
#include "image/formats/encoding.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>

namespace lfdsim {
namespace {

// Returns a picture of the panel whose pixels colour(column, row, rgb) sets.
template <class Colour>
Image fill(const Display& display, const Colour& colour) {
    Image image(int(display.panel.pixels[0]), int(display.panel.pixels[1]));
    tbb::parallel_for(0, image.height, [&](int row) {
        for (int column = 0; column < image.width; ++column) colour(column, row, image.at(column, row));
    });
    return image;
}

void grey(bool white, float* rgb) { rgb[0] = rgb[1] = rgb[2] = white ? 1.f : 0.f; }

void check(const PatternOptions& o) {
    Problems problems;
    const auto need = [&](bool good, const char* what, double given, const char* allowed) {
        if (!good) problems.add(what, "{} given; allowed is {}", given, allowed);
    };
    need(o.cell_pixels >= 1, "cell_pixels", o.cell_pixels, "1 or more");
    need(std::abs(o.view_x) <= 0.5, "view_x", o.view_x, "-0.5 to 0.5");
    need(std::abs(o.view_y) <= 0.5, "view_y", o.view_y, "-0.5 to 0.5");
    need(std::abs(o.edge_deg) <= 90, "edge_deg", o.edge_deg, "-90 to 90");
    need(std::isfinite(o.depth_mm), "depth_mm", o.depth_mm, "any finite length");
    problems.report();
}

// Returns the pixels nearest to one position of each elemental image. They reach 3/4 of a pixel: one pixel if the position is a
// pixel's centre, two by two if it is a corner, with room for rounding in both cases.
Image view(const Display& display, const Geometry& geometry, const PatternOptions& o) {
    const Pickup pickup(display, geometry);
    const auto reach = [&](int axis) {
        return 0.75 * display.panel.pixel_pitch_mm / (pickup.lattice().pitch[axis] * pickup.scale);
    };
    return fill(display, [&](int column, int row, float* rgb) {
        const Pickup::ElementalPosition p = pickup.place(pickup.x_mm(column), pickup.y_mm(row));
        grey(p.owned && std::abs(p.u - o.view_x) <= reach(0) && std::abs(p.v - o.view_y) <= reach(1), rgb);
    });
}

// Returns a half plane at a depth, white on the right: its edge passes through the display's axis, edge_deg counter-clockwise
// from the vertical.
Image edge(const Display& display, const Geometry& geometry, const PatternOptions& o) {
    const Pickup pickup(display, geometry);
    const double c = std::cos(o.edge_deg * degree), s = std::sin(o.edge_deg * degree),
                 height = geometry.vertex_plane_mm + o.depth_mm - pickup.z_rear;
    return fill(display, [&](int column, int row, float* rgb) {
        const NodalLine l = pickup.line(pickup.x_mm(column), pickup.y_mm(row));
        grey(l.owned && c * (l.x + height * l.mx) + s * (l.y + height * l.my) > 0, rgb);
    });
}

// Returns the picture in which every pixel's codes give its position: R column / 16, G row / 16 (both modulo 256), B the two
// remainders.
Image address(const Display& display) {
    const std::vector<float>& light = decode_table(display.panel.encoding, 8);
    return fill(display, [&](int column, int row, float* rgb) {
        rgb[0] = light[column / 16 & 255];
        rgb[1] = light[row / 16 & 255];
        rgb[2] = light[column % 16 * 16 + row % 16];
    });
}

}  // namespace

std::vector<std::string> pattern_names() { return {"checkerboard", "white", "view", "edge", "address"}; }

Image pattern(const std::string& name, const Display& display, const Geometry& geometry, const PatternOptions& options) {
    if (knows_no_errors(display)) {
        const Display meant = without_errors(display);
        return pattern(name, meant, resolve(meant), options);
    }
    check(options);
    const int cell = options.cell_pixels;
    if (name == "checkerboard")
        return fill(display, [&](int column, int row, float* rgb) { grey((row / cell + column / cell) % 2 == 0, rgb); });
    if (name == "white") return fill(display, [](int, int, float* rgb) { grey(true, rgb); });
    if (name == "view") return view(display, geometry, options);
    if (name == "edge") return edge(display, geometry, options);
    if (name == "address") return address(display);
    throw InputError("pattern", fmt::format("\"{}\" is not known; there are {}", name, fmt::join(pattern_names(), ", ")));
}

}  // namespace lfdsim
