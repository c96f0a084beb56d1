#include "interchange/pov/pov_limits.h"

#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"
#include "geometry/vec.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/pov/pov_lenses.h"

#include <fmt/format.h>
#include <algorithm>

namespace lfdsim::peers {
namespace {

constexpr double longest_units = 4e6;  // of a ray, less than POV-Ray's limit of 1e7
constexpr double least_units = 1e-3;   // between surfaces that a ray meets

}  // namespace

double pov_units_per_mm(const Display& d, const Geometry& g) {
    return std::min(120 / d.array.pitch_mm.least(), longest_units / (length(d.camera.position_mm) + sheet_half(g)));
}

std::vector<std::string> pov_deviations(Display& shown, const Geometry& geometry, const PeerOptions& options) {
    std::vector<std::string> all;
    const bool opaque = shown.array.surround == Surround::opaque, filled = shown.array.aperture == Aperture::cell;
    shown.panel.encoding = Encoding::linear;
    const Fresnel fresnel = shown.render.fresnel;
    if (fresnel == Fresnel::schlick || (fresnel == Fresnel::exact && !opaque)) {
        shown.render.fresnel = Fresnel::none;
        all.push_back(opaque ? "render.fresnel: POV-Ray has no Schlick weights; refraction is without loss here"
                             : "render.fresnel: POV-Ray's weights would also remove totally reflected light; refraction is without "
                               "loss here");
    }
    if (opaque && options.triangles == std::nullopt && filled)
        all.push_back(
            fmt::format("array.aperture: the black walls between filled cells are {} pitches thick", 2 * pov_gap_pitches));
    if (shown.array.surround == Surround::clear && filled)
        all.push_back(
            fmt::format("array.aperture: bodies of glass that fill their cells are {} pitches of air apart; in lfdsim they touch",
                        2 * pov_gap_pitches));
    if (opaque && lenses_differ(shown.errors) && PovLenses(shown, geometry).overlap())
        all.push_back(
            "errors: where lenses overlap, a neighbour's wall or face may meet a lens's light; in lfdsim each is a separate body");
    const double least_mm = least_units / pov_units_per_mm(shown, geometry);
    if (least_mm > 1e-4 * shown.array.pitch_mm.least())
        all.push_back(
            fmt::format("camera.position_mm: so far away that POV-Ray may miss surfaces less than {:.3g} mm apart", least_mm));
    const auto apart = [&](const std::string& key, double distance_mm) {
        if (distance_mm < least_mm)
            all.push_back(fmt::format("{}: POV-Ray may miss surfaces less than {:.3g} mm apart; these are {:.3g}", key, least_mm,
                                      distance_mm));
    };
    for (std::size_t k = 0; k < shown.panel.layers.size(); ++k)
        apart(fmt::format("panel.layer.{}.thickness_mm", k), shown.panel.layers[k].thickness_mm);
    if (!geometry.glued && is_plane(geometry.surfaces.front()))
        apart("array.base_z_mm", geometry.base_z_mm - geometry.layers_top_mm);
    return all;
}

}  // namespace lfdsim::peers
