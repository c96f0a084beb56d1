#include "analysis/crosstalk/intended_theory.h"

#include "analysis/core/eye_rays.h"

#include <cmath>

namespace lfdsim {
namespace {

/// Returns the position that a choice gives within the clear aperture of a lens, mm from the array's centre in its frame; nothing
/// if the position lies in the box about the aperture only.
std::optional<optics::Vec2<double>> in_aperture(const Geometry& g, const ApertureShape& shape, const Choice& c) {
    const auto axis = chosen_axis(g.lattice, c);
    const double height = shape.form == ApertureShape::ApertureForm::slit ? g.array_height_mm : shape.extent_mm(1);
    const double x = 0.5 * shape.extent_mm(0) * c[0], y = 0.5 * height * c[1];
    if (!shape.holds(x, y)) return {};
    return optics::Vec2<double>{axis.x + x, axis.y + y};
}

}  // namespace

MeantTheory::MeantTheory(const Display& d, const Geometry& g) : display_(d), geometry_(g), aperture_(aperture_shape(d, g)) {}

MetPlaces MeantTheory::look(const Vec3d& eye, const LineSets& sets) const {
    const Geometry& g = geometry_;
    const ParaxialLines lines(display_, g, eye);
    const PanelBehind panel(g);
    return {sets, 1, [&](const Choice& c, std::size_t) -> std::optional<MetPlaces::Met> {
                // Lines are chosen by where they meet the lenses, so that none is lost between apertures, and count if the point
                // that they aim at lies in the array's rectangle and on the screen.
                const auto place = in_aperture(g, aperture_, c);
                if (!place) return {};
                const auto lands = optics::in_display(g.lattice, *place);
                const auto aim = lines.aim_at(lands.x, lands.y, c[2], c[3]);
                if (!aim) return {};
                const auto aimed = optics::to_array(g.lattice, aim->x - g.lattice.offset[0], aim->y - g.lattice.offset[1]);
                if (std::abs(aimed.x) > 0.5 * g.array_width_mm || std::abs(aimed.y) > 0.5 * g.array_height_mm) return {};
                if (!panel.meets(eye, aim->x, aim->y)) return {};
                const auto line = lines.look(aim->x, aim->y, c[2], c[3]);
                if (!line || !line->through || !lines.on_panel(line->seen)) return {};
                const auto seen = optics::in_display(g.lattice, line->seen);
                return MetPlaces::Met{seen.x, seen.y, 1};
            }};
}

}  // namespace lfdsim
