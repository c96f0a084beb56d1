#include "interchange/pov/pov_cell.h"

#include "interchange/meshed/cell_sides.h"
#include "interchange/peers/scene_text.h"

#include <algorithm>
#include <cmath>

namespace lfdsim::peers {
namespace {

constexpr double flat_overlap_mm = 1e-6;  // of flat parts of neighbouring cells

}  // namespace

PovCell::PovCell(const Geometry& g)
    : lattice_(g.lattice),
      half_(cell_half(g)),
      corners_(cell_corners(g)),
      outer_radius_(std::hypot(corners_.x[0], corners_.y[0])) {}

double PovCell::widest_half() const { return std::max(half_[0], half_[1]); }

std::string PovCell::box(double low, double high, double wider) const {
    const double x = half_[0] + wider, y = half_[1] + wider;
    return fmt::format("box {{ {}, {} }}", vector(-x, -y, low), vector(x, y, high));
}

std::string PovCell::prism(double low, double high, double wider) const {
    if (corners_.count == 4) return box(low, high, wider);
    // A hexagon is what three strips, turned by 60 degrees against each other, have in common.
    const double x = half_[0] + wider, y = 2 * half_[1];
    std::string strips;
    for (const int turn : {0, 60, 120})
        strips += fmt::format(" box {{ {}, {}{} }}", vector(-x, -y, low), vector(x, y, high),
                              turn == 0 ? "" : fmt::format(" rotate {} * z", turn));
    return "intersection {" + strips + " }";
}

std::string PovCell::column(double radius, double low, double high) const {
    if (strips())
        return fmt::format("box {{ {}, {} }}", vector(-radius, -1.1 * half_length(), low),
                           vector(radius, 1.1 * half_length(), high));
    return fmt::format("cylinder {{ {}, {}, {} }}", vector(0, 0, low), vector(0, 0, high), text(radius));
}

std::string PovCell::flat(double z, double radius) const {
    const std::string cell = prism(z - 1, z + 1, flat_overlap_mm),
                      disc = fmt::format("  disc {{ {}, z, {}", vector(0, 0, z), text(1.06 * outer_radius_));
    if (strips() && radius > 0)
        return fmt::format("{} clipped_by {{ {} object {{ {} inverse }} }}", disc, cell, column(radius, z - 1, z + 1));
    return fmt::format("{}, {} clipped_by {{ {} }}", disc, text(radius), cell);
}

std::vector<PovCell::PrismSide> PovCell::sides() const {
    const auto [x, y] = half_;
    const double px = lattice_.pitch[0], py = lattice_.pitch[1];
    const std::string right = fmt::format("I = {}", last(0)), left = "I = 0", top = fmt::format("J = {}", last(1)),
                      bottom = "J = 0";
    const double side_y = corners_.y[1];  // where the sides to left and right end: a hexagon's corners are up and down
    std::vector<PrismSide> all{{{x, -side_y}, {x, side_y}, {px, 0}, right}, {{-x, -side_y}, {-x, side_y}, {-px, 0}, left}};
    if (strips()) return all;
    if (!lattice_.staggered) {
        all.push_back({{-x, y}, {x, y}, {0, py}, top});
        all.push_back({{-x, -y}, {x, -y}, {0, -py}, bottom});
        return all;
    }
    // Odd rows are shifted to the right: their right neighbours above and below have the next number, of even rows the same.
    const std::string no_right = fmt::format("I + mod(J, 2) > {}", last(0)), no_left = "I + mod(J, 2) < 1";
    for (const int up : {1, -1})
        for (const int out : {1, -1})
            all.push_back({{out * x, up * side_y},
                           {0, up * y},
                           {out * px / 2, up * py},
                           fmt::format("{} | {}", up > 0 ? top : bottom, out > 0 ? no_right : no_left)});
    return all;
}

std::string PovCell::axis_x() const {
    const std::string x = fmt::format("(I - {}) * {}", text(0.5 * double(last(0))), text(lattice_.pitch[0]));
    // J may be -1
    return lattice_.staggered ? fmt::format("{} + (mod(J + 2, 2) - 0.5) * {}", x, text(lattice_.pitch[0] / 2)) : x;
}

std::string PovCell::axis_y() const { return fmt::format("(J - {}) * {}", text(0.5 * double(last(1))), text(lattice_.pitch[1])); }

}  // namespace lfdsim::peers
