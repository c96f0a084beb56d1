#include "analysis/luminance_theory.h"

#include "analysis/paraxial_lines.h"
#include "model/numbers.h"
#include "model/screen.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lfdsim {
namespace {

/// Of all surfaces at normal incidence: the lens's, and those of the layers that no lens is glued on.
double transmission(const Display& d, const Geometry& g) {
    if (d.render.fresnel == Fresnel::none) return 1;
    double t = 1;
    const auto cross = [&](double below, double above) { t *= 4 * below * above / ((below + above) * (below + above)); };
    for (const PlacedSurface& s : g.surfaces) cross(s.index_below, s.index_above);
    const std::vector<PlacedLayer>& layers = g.layers;
    for (std::size_t k = 0; k < layers.size(); ++k) {
        const bool top = k + 1 == layers.size();
        if (!(top && g.glued)) cross(layers[k].index, top ? 1 : layers[k + 1].index);
    }
    return t;
}

/// What lines of sight see that meet a lens's clear aperture, and those that come down beside it, over the panel's luminance.
struct Passed {
    double lens, beside;
};
Passed passed(const Display& d, const Geometry& g) {
    const double t = transmission(d, g);
    if (d.lens.is_thin() || d.array.surround == Surround::opaque || d.lens.stop_radius_mm) return {t, 0};
    return {t, d.array.surround == Surround::plate ? t : 1};
}

/// The mean over lines of sight that aim at the screen: evenly chosen lenses, places in their cells and angles of the diffuser.
/// Good to a thousandth.
double seen_mean(const Display& d, const Geometry& g, double eye_mm) {
    constexpr int count = 1 << 19;
    const ParaxialLines lines(d, g, {0, 0, eye_mm});
    const Lattice<double>& l = g.lattice;
    const Passed share = passed(d, g);
    const PanelBehind panel(g);
    const Vec3d eye{0, 0, eye_mm};
    double seen = 0, all = 0;
    const auto number = [&](double choice, std::size_t k) {
        return std::min(std::floor((0.5 + 0.5 * choice) * l.count[k]), l.count[k] - 1);
    };
    for (const Choice& c : even_choices(count)) {
        const auto axis = optics::axis_in_array(l, optics::Cell<double>{number(c[4], 0), number(c[5], 1)});
        optics::Place<double> in{l.half_pitch[0] * c[0], 0.5 * l.pitch[1] * c[1]};
        if (l.hexagonal) {  // the corners of this box belong to a neighbour's cell: the same place in the hexagon
            const auto centre = optics::axis_of(l, optics::cell_at(l, in.x, in.y));
            in = {in.x - centre.x, in.y - centre.y};
        }
        const auto aimed = optics::in_display(l, optics::Place<double>{axis.x + in.x, axis.y + in.y});
        if (!panel.meets(eye, aimed.x, aimed.y)) continue;
        ++all;
        const auto line = lines.look(aimed.x, aimed.y, c[2], c[3]);
        if (line && lines.on_panel(line->seen)) seen += line->through ? share.lens : share.beside;
    }
    return all > 0 ? seen / all : nan;
}

}  // namespace

TheoryFigure luminance_over_panel(const Display& d, const Geometry& g, double eye_mm) {
    if (d.panel.emission_exponent != 0) return {nan, "theory holds for a panel that is equally bright from all directions"};
    return {seen_mean(d, g, eye_mm), ""};
}

}  // namespace lfdsim
