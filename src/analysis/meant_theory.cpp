#include "analysis/meant_theory.h"

#include "analysis/meant_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

constexpr int lines_summed = 1 << 15;

/// A place in the clear aperture of a lens, from the array's middle in its own axes; nothing for what is in the box about it only.
std::optional<optics::Place<double>> in_aperture(const Geometry& g, const ApertureShape& shape, const Choice& c) {
    const Lattice<double>& l = g.lattice;
    const auto number = [&](std::size_t k) { return std::min(std::floor((0.5 + 0.5 * c[4 + k]) * l.count[k]), l.count[k] - 1); };
    const auto axis = optics::axis_in_array(l, optics::Cell<double>{number(0), number(1)});
    const bool hexagon = shape.form == ApertureShape::Form::hexagon, slit = shape.form == ApertureShape::Form::slit;
    const double height = slit ? g.array_height_mm : shape.width_mm[1] * (hexagon ? 2 / std::numbers::sqrt3 : 1);
    const double x = 0.5 * shape.width_mm[0] * c[0], y = 0.5 * height * c[1];
    if (!shape.holds(x, y)) return {};
    return optics::Place<double>{axis.x + x, axis.y + y};
}

}  // namespace

MeantTheory::MeantTheory(const Subject& s, double distance_mm)
    : subject_(s),
      distance_mm_(distance_mm),
      spread_(s, distance_mm - s.geometry().rear_principal_mm),
      pickup_(s.display(), s.geometry()) {
    if (s.display().lens.is_thin() && !s.geometry().layers.empty()) choices_ = even_choices(lines_summed);
}

double MeantTheory::meant(double x_mm, double low, double high) const {
    return choices_.empty() ? spread_.meant(x_mm, low, high) : sum(x_mm, low, high);
}

double MeantTheory::sum(double x_mm, double low, double high) const {
    const Geometry& g = subject_.geometry();
    const ParaxialLines lines(subject_.display(), g, {x_mm, 0, distance_mm_});
    const ApertureShape shape = aperture_shape(subject_.display(), g);
    const PanelBehind panel(g);
    int found = 0, all = 0;
    for (const Choice& c : choices_) {
        const auto place = in_aperture(g, shape, c);
        if (!place) continue;
        const auto lands = optics::in_display(g.lattice, *place);
        const auto aim = lines.aim_at(lands.x, lands.y, c[2], c[3]);
        if (!aim) continue;
        const auto aimed = optics::to_array(g.lattice, aim->x - g.lattice.offset[0], aim->y - g.lattice.offset[1]);
        if (std::abs(aimed.x) > 0.5 * g.array_width_mm || std::abs(aimed.y) > 0.5 * g.array_height_mm) continue;
        if (!panel.meets({x_mm, 0, distance_mm_}, aim->x, aim->y)) continue;
        const auto line = lines.look(aim->x, aim->y, c[2], c[3]);
        if (!line || !line->through || !lines.on_panel(line->seen)) continue;
        const auto seen = optics::in_display(g.lattice, line->seen);
        const auto slope = meant_slope(pickup_, g, seen.x, seen.y);
        if (!slope) continue;
        ++all;
        found += low <= *slope && *slope <= high;
    }
    return all > 0 ? double(found) / all : 0;
}

}  // namespace lfdsim
