// Advice on the eye's position, and on the position for which elemental images are made. docs/model.md, "Advice".

#include "base/constants.h"
#include "checks/advice_parts.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

void advise_on_eye(Advised& a) {
    const Display& d = a.display;
    const Geometry& g = a.geometry;
    const double eye = camera_distance_mm(d), made_for = d.content.viewing_distance_mm, nearest = nearest_eye_mm(g);
    if (!(eye > nearest))
        a.say(
            "the camera, {:.5g} mm from the panel, is inside the display, which ends {:.5g} mm from the panel: move it farther "
            "away (--set 'camera.position_mm=[0, 0, {:.5g}]')",
            eye, nearest, 20 * nearest);
    if (!(made_for > nearest))
        a.say(
            "content.viewing_distance_mm = {:.5g} puts the viewer of the elemental images inside the display, which ends {:.5g} mm "
            "from the panel. The usual value is the camera's distance (--set content.viewing_distance_mm={:.5g})",
            made_for, nearest, eye);
    if (!(eye > nearest && made_for > nearest)) return;

    // Beyond the elemental image's edge a lens shows that of its neighbour: the picture repeats.
    const auto [x, y, z] = d.camera.position_mm;
    const auto half_fov = [&](std::size_t k) { return a.theory.along[k].fov_elemental_deg / 2; };
    const double off_axis[] = {std::atan(std::abs(x) / z) / degree, std::atan(std::abs(y) / z) / degree};
    const std::size_t far = off_axis[0] / half_fov(0) >= off_axis[1] / half_fov(1) ? 0 : 1;
    if (off_axis[far] > half_fov(far))
        a.say(
            "the camera is {:.1f} degrees off axis, outside the field of view of +-{:.1f} degrees: it sees neighbouring elemental "
            "images",
            off_axis[far], half_fov(far));

    // The zone from which the whole screen is correct is compared with that of content made for the eye's distance, along the
    // axis where it is the smaller part.
    Display matched = d;
    matched.content.viewing_distance_mm = eye;
    const Theory with_it = theory(matched, g);
    const auto zone_of = [](const Theory& t, std::size_t k) { return t.along[k].viewing_zone_deg; };
    const std::size_t worse = zone_of(a.theory, 1) * zone_of(with_it, 0) < zone_of(a.theory, 0) * zone_of(with_it, 1) ? 1 : 0;
    const double zone = zone_of(a.theory, worse), best = zone_of(with_it, worse);
    if (zone < 0.8 * best)
        a.say(
            "the elemental images are for a viewer {} (content.viewing_distance_mm = {:.5g}), but the camera is {:.5g} mm from the "
            "panel: {}; images for that distance would be correct within +-{:.1f} degrees (--set "
            "content.viewing_distance_mm={:.5g})",
            std::isinf(made_for) ? "at infinity" : fmt::format("{:.5g} mm from the panel", made_for), made_for, eye,
            zone > 0 ? fmt::format("from there the whole screen is correct only within +-{:.1f} degrees", zone / 2)
                     : "from there the whole screen is correct at no angle",
            best / 2, eye);
}

}  // namespace lfdsim
