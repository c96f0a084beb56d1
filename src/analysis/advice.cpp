#include "analysis/advice.h"

#include "content/content.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace lfdsim {

std::vector<std::string> advice(const Display& d, const Geometry& g, const Theory& t) {
    std::vector<std::string> all;
    const double pi = std::acos(-1.0);
    const auto add = [&]<class... Values>(fmt::format_string<Values...> text, Values&&... values) {
        all.push_back(fmt::format(text, std::forward<Values>(values)...));
    };

    // Beyond a hundred panels' heights an image plane is as good as at infinity for any scene.
    if (!(std::abs(t.central_depth_mm) < 100 * g.panel_height_mm))
        add("the gap is about the focal length ({:.6g} and {:.6g} mm): the central depth plane is at infinity", g.gap_mm,
            g.focal_length_mm);
    if (g.focal_length_mm < 0) add("the lens is a diverging one: it has no real image of the panel at any gap");

    // Lens k begins k N pixels from the first; a fraction of a pixel in N moves the views of the last lens against those of the
    // first.
    const double drift = std::abs(t.views - std::round(t.views)) * double(std::max(d.array.count[0], d.array.count[1]));
    if (drift > 0.5)
        add("a lens covers {:.4f} panel pixels, not a whole number: across the array this adds up to {:.2g} pixels", t.views,
            drift);
    if (g.array_width_mm > g.panel_width_mm + d.panel.pixel_pitch_mm ||
        g.array_height_mm > g.panel_height_mm + d.panel.pixel_pitch_mm)
        add("the lens array ({:.5g} x {:.5g} mm) is larger than the panel ({:.5g} x {:.5g} mm): its outer lenses have dark or "
            "missing images",
            g.array_width_mm, g.array_height_mm, g.panel_width_mm, g.panel_height_mm);
    if (g.array_width_mm < 0.9 * g.panel_width_mm || g.array_height_mm < 0.9 * g.panel_height_mm)
        add("the lens array ({:.5g} x {:.5g} mm) leaves more than a tenth of the panel ({:.5g} x {:.5g} mm) unused",
            g.array_width_mm, g.array_height_mm, g.panel_width_mm, g.panel_height_mm);

    // Gaps close where the diffuser spreads a lens's light as wide as the pitch, seen from L: omega = 2 atan(p/2L).
    if (d.diffuser && std::min(d.diffuser->angle_deg[0], d.diffuser->angle_deg[1]) < 0.9 * t.gap_closing_diffuser_deg)
        add("the diffuser ({:.4g} x {:.4g} degrees) is weaker than the {:.4g} degrees that close the gaps between lenses at the "
            "central "
            "depth plane: expect dots",
            d.diffuser->angle_deg[0], d.diffuser->angle_deg[1], t.gap_closing_diffuser_deg);
    if (!d.diffuser)
        add("no diffuser closes the gaps between lenses ({:.4g} degrees at the central depth plane would): expect dots",
            t.gap_closing_diffuser_deg);

    // Beyond atan(p/2g) a lens shows the elemental image of its neighbour: the picture repeats.
    const auto [x, y, z] = d.camera.position_mm;
    const double off_axis = std::atan(std::max(std::abs(x), std::abs(y)) / z) * 180 / pi;
    if (off_axis > t.fov_elemental_deg / 2)
        add("the camera stands {:.1f} degrees off axis, outside the field of view of +-{:.1f} degrees: it sees neighbouring images",
            off_axis, t.fov_elemental_deg / 2);

    // Depths count from the vertex plane, the theory's from the rear principal plane.
    const double from_lens = g.content_depth_mm + g.vertex_plane_mm - g.rear_principal_mm;
    if (!is_sharp(t, from_lens))
        add("the content's centre, {:.4g} mm from the lenses, is outside the depth of field, whose ends are at {:.4g} and {:.4g} "
            "mm",
            from_lens, depth_mm(t.depth_near_per_mm), depth_mm(t.depth_far_per_mm));
    const std::string& model = d.content.model;
    if (std::error_code error; !model.empty() && model != built_in_spheres && !std::filesystem::exists(model, error))
        add("content.model, {}, does not exist", model);
    return all;
}

}  // namespace lfdsim
