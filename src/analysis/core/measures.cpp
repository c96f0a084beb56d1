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

#include <fmt/format.h>

namespace lfdsim {
namespace {

constexpr MeasureNeeds scene{.scene = true}, point_images{.point_images = true},
    scene_and_images{.scene = true, .point_images = true};

constexpr Measure all[] = {
    {"components", "Components", "What each part of the display does to a picture, and what they show together.",
     "the component tests of the 2019 paper", components_steps, measure_components, scene},
    {"directions", "Views from around", "What the display shows from the side and from above, beside the scene itself.",
     "pictures by ray tracing; photographs of the scene by the same camera", directions_steps, measure_directions, scene},
    {"fov", "Field of view", "From which angles the display shows the scene as it is, horizontally and vertically.",
     "SSIM thresholds of the 2019 paper; Wang et al. 2004 for SSIM; theory 2 atan(p / 2g)", fov_steps, measure_fov, scene},
    {"dof", "Depth of field", "At which depths from the lenses a scene is shown sharply.",
     "SSIM thresholds of the 2019 paper; spot sizes by ray tracing; paraxial theory", dof_steps, measure_dof, scene_and_images},
    {"zone", "Viewing zone", "From where all of the screen shows its own views, and not those of neighbouring lenses.",
     "Rays traced from viewers' positions; paraxial theory", zone_steps, measure_zone},
    {"crosstalk", "Crosstalk", "How much light of other views, and of what the other eye should see, an eye sees.",
     "Woods 2012, IEC 62629-22-1, IDMS: 100 (leak - black) / (signal - black)", crosstalk_steps, measure_crosstalk},
    {"mtf", "Resolution", "How fine a detail the display shows at which depth, seen from which angle.",
     "Slanted edges after ISO 12233; theory: image of a panel pixel, paraxial spot and diffuser", mtf_steps, measure_mtf,
     point_images},
    {"uniformity", "Uniformity and light",
     "How even a white screen is, over its area and over viewing angle, and how much light it passes.",
     "100 Lmin / Lmax; Michelson contrast; radiance theorem", uniformity_steps, measure_uniformity},
    {"moire", "Moire", "The pattern that the lens lattice and the panel's pixels make on a white screen.",
     "beats of the two lattices; contrast sensitivity by Mannos and Sakrison 1974", moire_steps, measure_moire},
    {"spot", "Spots and distortion", "How one lens images points of the panel over field and depth, and how truly it places them.",
     "ray tracing by Snell's law; Welford 1986; paraxial theory D |z - L| / |L|", spot_steps, measure_spot, point_images},
};

}  // namespace

std::span<const Measure> measures() { return all; }

std::optional<Problem> refusal(const Measure& m, const Display& d) {
    if (m.needs.point_images && d.lens.type() == LensType::pinhole)
        return Problem{"lens.type",
                       fmt::format("is \"pinhole\", which images no point: there is nothing for {} to measure", m.name)};
    return {};
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
