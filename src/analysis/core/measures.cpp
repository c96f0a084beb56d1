// The table of all measures.

#include "analysis/core/measure.h"
#include "analysis/crosstalk/crosstalk.h"
#include "analysis/fov/fov.h"
#include "analysis/moire/moire.h"
#include "analysis/pictures/components.h"
#include "analysis/pictures/directions.h"
#include "analysis/resolution/dof.h"
#include "analysis/resolution/mtf.h"
#include "analysis/spots/spot.h"
#include "analysis/uniformity/uniformity.h"
#include "analysis/zone/zone.h"
#include "engine/devices/memory.h"

#include <fmt/format.h>

namespace lfdsim {
namespace {

constexpr MeasureNeeds scene{.scene = true, .panel_picture = true}, point_images{.point_images = true},
    panel_and_images{.panel_picture = true, .point_images = true},
    all_needs{.scene = true, .panel_picture = true, .point_images = true};

constexpr Measure all[] = {
    {"components", "Components", "Pictures through the lens array alone, through the diffuser alone, and of the whole display.",
     "the component tests of the 2019 paper", components_steps, measure_components, scene},
    {"directions", "Views from several directions", "Views of the display from the side and from above, beside the scene itself.",
     "pictures by ray tracing; photographs of the scene by the same camera", directions_steps, measure_directions, scene},
    {"fov", "Field of view", "The range of angles from which the display shows the scene correctly, horizontally and vertically.",
     "SSIM thresholds of the 2019 paper; Wang et al. 2004 for SSIM; theory 2 atan(p / 2g)", fov_steps, measure_fov, scene},
    {"dof", "Depth of field", "The range of depths, from the lenses, in which a scene is shown sharply.",
     "SSIM thresholds of the 2019 paper; spot sizes by ray tracing; paraxial theory", dof_steps, measure_dof, all_needs},
    {"zone", "Viewing zone",
     "The region from which every lens of the screen shows its own elemental image, not a neighbouring lens's.",
     "rays traced from viewers' positions; paraxial theory", zone_steps, measure_zone},
    {"crosstalk", "Crosstalk", "The light of other views, and of the content for the other eye, that reaches an eye.",
     "Woods 2012, IEC 62629-22-1, IDMS: 100 (leak - black) / (signal - black)", crosstalk_steps, measure_crosstalk},
    {"mtf", "Resolution", "The finest detail that the display shows, by depth and viewing angle.",
     "slanted edges after ISO 12233; theory: image of a panel pixel, paraxial spot and diffuser", mtf_steps, measure_mtf,
     panel_and_images},
    {"uniformity", "Uniformity and light",
     "The uniformity of a white screen over its area and over viewing angle, and the light efficiency.",
     "100 Lmin / Lmax; Michelson contrast; radiance theorem", uniformity_steps, measure_uniformity},
    {"moire", "Moire", "The moire pattern of lens lattice and panel pixels on a white screen.",
     "beats of the two lattices; contrast sensitivity by Mannos and Sakrison 1974", moire_steps, measure_moire},
    {"spot", "Spots and distortion", "The spots of one lens over field and depth, and its distortion.",
     "ray tracing by Snell's law; Welford 1986; paraxial theory D |z - L| / |L|", spot_steps, measure_spot, point_images},
};

}  // namespace

std::span<const Measure> measures() { return all; }

void require_needs(const Measure& m, const Display& d) {
    if (m.needs.point_images && d.lens.type() == LensType::pinhole)
        throw InputError("lens.type",
                         fmt::format("is \"pinhole\", which forms no image: there is nothing for {} to measure", m.name));
    if (m.needs.panel_picture) require_panel_memory(d);
}

const Measure& measure_named(std::string_view name) {
    std::string names;
    for (const Measure& m : all) {
        if (m.name == name) return m;
        names += fmt::format("{}{}", names.empty() ? "" : ", ", m.name);
    }
    throw InputError("MEASURE", fmt::format("\"{}\" is not a measure; there are: all, {}", name, names));
}

}  // namespace lfdsim
