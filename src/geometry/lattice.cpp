#include "geometry/lattice.h"

#include "base/constants.h"
#include "display/display.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double endless_mm = 1e9;  // beyond every panel; its square is a float

/// Returns half the width and height of the panel's bounding box in the array's frame, mm.
std::array<double, 2> half_panel_mm(const Panel& panel, double turn_deg) {
    const double w = double(panel.pixels[0]) * panel.pixel_pitch_mm / 2, h = double(panel.pixels[1]) * panel.pixel_pitch_mm / 2,
                 c = std::abs(std::cos(turn_deg * degree)), s = std::abs(std::sin(turn_deg * degree));
    return {w * c + h * s, w * s + h * c};
}

}  // namespace

std::array<std::int64_t, 2> covering_count(const Panel& panel, const LensArray& array) {
    const double c = std::cos(array.turn_deg() * degree), s = std::sin(array.turn_deg() * degree);
    const auto [x, y] = array.offset_mm;
    const auto half = half_panel_mm(panel, array.turn_deg());
    const double half_x = half[0] + std::abs(c * x + s * y), half_y = half[1] + std::abs(c * y - s * x);
    const auto [px, py] = spacing_mm(panel, array);
    // A panel that ends within a billionth of a cell beyond a border is covered. NaN gives 1.
    const auto whole = [](double cells) { return cells > 1 ? std::int64_t(std::min(std::ceil(cells - 1e-9), 1e10)) : 1; };
    const std::int64_t columns = whole(2 * half_x / px + (is_staggered(array) ? 0.5 : 0));
    if (is_strips(array)) return {columns, 1};
    return {columns, whole(array.lattice == LatticeKind::hexagon ? 1 + (2 * half_y - px / std::sqrt(3)) / py : 2 * half_y / py)};
}

bool is_staggered(const LensArray& array) { return array.lattice == LatticeKind::hexagon || array.lattice == LatticeKind::brick; }

bool is_strips(const LensArray& array) { return array.lattice == LatticeKind::strips; }

bool differs_by_axis(const LensArray& array) {
    return array.lattice == LatticeKind::rectangle || array.lattice == LatticeKind::brick;
}

double strip_length_mm(const Panel& panel, double turn_deg) { return 2 * half_panel_mm(panel, turn_deg)[1]; }

std::array<double, 2> spacing_mm(const Panel& panel, const LensArray& array) {
    const double p = array.pitch_mm[0];
    if (is_strips(array)) return {p, strip_length_mm(panel, array.turn_deg())};
    return {p, array.lattice == LatticeKind::hexagon ? p * std::sqrt(3) / 2 : array.pitch_mm[1]};
}

std::array<std::int64_t, 2> lens_count(const Panel& panel, const LensArray& array) {
    return array.count ? *array.count : covering_count(panel, array);
}

std::array<double, 2> array_size_mm(const Panel& panel, const LensArray& array) {
    const auto [px, py] = spacing_mm(panel, array);
    const auto count = lens_count(panel, array);
    const double nx = double(count[0]), ny = double(count[1]), across = is_staggered(array) ? (nx + 0.5) * px : nx * px;
    return {across, array.lattice == LatticeKind::hexagon ? (ny - 1) * py + 2 * outer_radius_mm(array) : ny * py};
}

double inner_radius_mm(const LensArray& array) { return array.pitch_mm.least() / 2; }

double outer_radius_mm(const LensArray& array) {
    if (is_strips(array)) return array.pitch_mm[0] / 2;
    if (array.lattice == LatticeKind::hexagon) return array.pitch_mm[0] / std::sqrt(3);
    // Half the diagonal, in a form that gives p / sqrt(2) to the last bit for a square.
    const double q = array.pitch_mm[1] / array.pitch_mm[0];
    return array.pitch_mm[0] / std::sqrt(4 / (1 + q * q));
}

Lattice<double> make_lattice(const Panel& panel, const LensArray& array) {
    Lattice<double> l{};
    const auto spacing = spacing_mm(panel, array);
    const auto count = lens_count(panel, array);
    for (std::size_t k = 0; k < 2; ++k) {
        const double pitch = spacing[k];
        l.pitch[k] = pitch;
        l.per_pitch[k] = 1 / pitch;
        l.half_pitch[k] = pitch / 2;
        l.count[k] = double(count[k]);
        l.offset[k] = array.offset_mm[k];
    }
    l.cos_turn = std::cos(array.turn_deg() * degree);
    l.sin_turn = std::sin(array.turn_deg() * degree);
    l.hexagonal = array.lattice == LatticeKind::hexagon;
    l.staggered = is_staggered(array);
    l.strips = is_strips(array);
    if (l.strips) {  // any finite place lies in row 0
        l.per_pitch[1] = 0;
        l.half_pitch[1] = endless_mm;
    }
    return l;
}

}  // namespace lfdsim
