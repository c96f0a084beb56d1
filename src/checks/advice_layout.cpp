// Advice on the position of the array relative to the panel. docs/model.md, "Advice".

#include "base/constants.h"
#include "checks/advice_parts.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// Returns the share of the lenses whose elemental images are centred beside the panel, so that at least half of the image is
/// missing. The image of the lens at C is centred at e C, e the elemental pitch over the lens pitch. In arrays of more than 256
/// columns or rows 256 evenly spread ones are counted.
double share_beside_panel(const Geometry& g, const Lattice<double>& lattice, double elemental_over_lens_pitch) {
    const double cos = lattice.cos_turn, sin = lattice.sin_turn;
    const auto columns = std::int64_t(std::min(lattice.count[0], 256.)), rows = std::int64_t(std::min(lattice.count[1], 256.));
    std::int64_t beside = 0;
    for (std::int64_t j = 0; j < rows; ++j)
        for (std::int64_t i = 0; i < columns; ++i) {
            const double u = ((double(i) + 0.5) / double(columns) - 0.5) * g.array_width_mm,
                         v = ((double(j) + 0.5) / double(rows) - 0.5) * g.array_height_mm;
            const double x = elemental_over_lens_pitch * (cos * u - sin * v + lattice.offset[0]),
                         y = elemental_over_lens_pitch * (sin * u + cos * v + lattice.offset[1]);
            beside += std::abs(x) > g.panel_width_mm / 2 || std::abs(y) > g.panel_height_mm / 2;
        }
    return double(beside) / double(columns * rows);
}

}  // namespace

void advise_on_layout(Advised& a) {
    const Display& d = a.display;
    const Geometry& g = a.geometry;
    if (!(d.content.viewing_distance_mm > g.rear_principal_mm)) return;  // there are no such elemental images
    if (!d.array.count || is_strips(d.array)) return;                    // without a count lenses reach beyond the panel by design
    const double scale = a.theory.along[0].elemental_pitch_mm / g.lattice.pitch[0];  // p'/p, p as built
    // Shares beside the panel with and without offset and rotation tell these two causes from elemental images that are too wide.
    Lattice<double> straight = g.lattice;
    straight.cos_turn = 1;
    straight.sin_turn = straight.offset[0] = straight.offset[1] = 0;
    const double beside = share_beside_panel(g, g.lattice, scale), beside_straight = share_beside_panel(g, straight, scale);
    const bool by_errors = d.errors.shift_mm != std::array<double, 2>{} || d.errors.rotation_deg != 0;
    if (beside > beside_straight + 0.005)
        a.say(
            "the array is moved by {:.5g}, {:.5g} mm and turned by {:.5g} degrees{}: the elemental images of {:.3g} % of its "
            "lenses lie outside the panel, and these lenses stay dark. Reduce both (--set 'array.offset_mm=[0, 0]' --set "
            "array.rotation_deg=0{})",
            g.lattice.offset[0], g.lattice.offset[1], g.turn_deg, by_errors ? " with its errors" : "", 100 * beside,
            by_errors ? " --set 'errors.shift_mm=[0, 0]' --set errors.rotation_deg=0" : "");

    const double pixel = d.panel.pixel_pitch_mm;
    if (g.array_width_mm > g.panel_width_mm + pixel || g.array_height_mm > g.panel_height_mm + pixel) {
        a.say(
            "the lens array ({:.5g} x {:.5g} mm) is larger than the panel ({:.5g} x {:.5g} mm): its outer lenses have dark or "
            "missing images",
            g.array_width_mm, g.array_height_mm, g.panel_width_mm, g.panel_height_mm);
    } else if (beside_straight > 0.02) {
        const auto fitting = [&](double size, std::size_t k) {
            return std::clamp<std::int64_t>(std::int64_t(size / a.theory.along[k].elemental_pitch_mm), 1,
                                            std::int64_t(g.lattice.count[k]));
        };
        a.say(
            "the elemental images for a viewer at {:.5g} mm are {:.4f} times as wide as the lenses, {:.5g} x {:.5g} mm together, "
            "wider than the panel ({:.5g} x {:.5g} mm): {:.3g} % of the lenses have their elemental images outside it. Use fewer "
            "lenses (--set 'array.count=[{}, {}]') or a greater content.viewing_distance_mm",
            d.content.viewing_distance_mm, scale, scale * g.array_width_mm, scale * g.array_height_mm, g.panel_width_mm,
            g.panel_height_mm, 100 * beside_straight, fitting(g.panel_width_mm, 0), fitting(g.panel_height_mm, 1));
    }
    const auto unused = [&](double array_mm, double panel_mm, std::size_t k) {  // more than a tenth, and room for another lens
        return panel_mm - scale * array_mm > std::max(0.1 * panel_mm, a.theory.along[k].elemental_pitch_mm);
    };
    if (unused(g.array_width_mm, g.panel_width_mm, 0) || unused(g.array_height_mm, g.panel_height_mm, 1))
        a.say("the lens array ({:.5g} x {:.5g} mm) leaves more than a tenth of the panel ({:.5g} x {:.5g} mm) unused",
              g.array_width_mm, g.array_height_mm, g.panel_width_mm, g.panel_height_mm);
}

}  // namespace lfdsim
