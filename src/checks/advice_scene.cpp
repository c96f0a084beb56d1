// Advice on the scene's position, size and sharpness. docs/model.md, "Advice".

#include "base/constants.h"
#include "checks/advice_parts.h"
#include "checks/depth_words.h"
#include "geometry/resolve.h"
#include "geometry/sharp_range.h"

#include <algorithm>
#include <cmath>

// Depths z count from the vertex plane here, positive towards the viewer; so does the eye's distance.
namespace lfdsim {
namespace {

constexpr double nearest_focus_mm = 100;  // of young eyes

/// Returns a better depth for the scene: a quarter of the way to the eye; for a near-eye display 1.5 m behind the lenses, or the
/// depth nearest to that, in 1/z, within the depth of field by the pixel, but far enough for the eye to focus on.
double better_depth_mm(const Advised& a, double eye) {
    if (eye > 2 * nearest_focus_mm) return eye / 4;
    const double sharp = std::clamp(-1 / 1500., a.theory.depth_far_per_mm, a.theory.depth_near_per_mm);
    const double depth = sharp < 0 ? 1 / sharp + a.geometry.rear_principal_mm - a.geometry.vertex_plane_mm : -1500;
    return std::min(depth, eye - 1.2 * nearest_focus_mm);
}

/// Says if the front or the centre of the scene reaches the eye or lies behind it. Returns whether it does; other advice on the
/// scene then means nothing.
bool advise_behind_eye(Advised& a, double eye) {
    const double z = a.geometry.content_depth_mm, half = a.model_half_size_mm ? (*a.model_half_size_mm)[2] : 0;
    if (z + half < eye) return false;
    a.say(
        "the scene{}, {:.5g} mm in front of the lenses, is behind the eye, which is {:.5g} mm in front of them. Move it away from "
        "the eye (--set content.depth_mm={:.5g}), or make it smaller (--set content.height_mm)",
        z < eye ? "'s front" : "", z < eye ? z + half : z, eye, std::min(better_depth_mm(a, eye), eye / 2 - half));
    return true;
}

/// Says if the scene is nearer to the eye than eyes can focus, as it is by default for a near-eye display (at the lenses).
/// Returns whether it is.
bool advise_near_eye(Advised& a, double eye) {
    const double to_eye = eye - a.geometry.content_depth_mm, depth = better_depth_mm(a, eye);
    if (to_eye > nearest_focus_mm) return false;
    // The suggested height is half of what the eye sees, at that depth, through the screen, or through one lens if that is less.
    const double seen = std::min(std::min(a.geometry.array_height_mm, a.geometry.panel_height_mm) / eye,
                                 2 * std::tan(a.theory.along[1].fov_elemental_deg * degree / 2));
    a.say(
        "the scene is {} and {:.4g} mm from the eye, nearer than eyes can focus. Set its depth and "
        "height (--set content.depth_mm={:.0f} --set content.height_mm={:.0f})",
        depth_in_words(a.geometry.content_depth_mm), to_eye, depth, 0.5 * seen * (eye - depth));
    return true;
}

void advise_on_size(Advised& a, double eye) {
    const Geometry& g = a.geometry;
    if (!a.display.content.objects.empty()) return;  // a wall behind a scene may well be larger
    const double full_height = g.content_height_mm.value();
    // Projected from the eye onto the vertex plane, the plane of the scene's centre is magnified by E_v/(E_v - z).
    const double projected = eye / (eye - g.content_depth_mm), height = full_height * projected,
                 width = a.model_half_size_mm ? 2 * (*a.model_half_size_mm)[0] * projected : 0;
    const double screen_width = std::min(g.array_width_mm, g.panel_width_mm),
                 screen_height = std::min(g.array_height_mm, g.panel_height_mm);
    const double excess = std::max(width / screen_width, height / screen_height);
    if (excess > 1)
        a.say(
            "the scene is larger than the display: from the eye it covers {}{:.5g} mm of the screen's {:.5g} x {:.5g} mm. Make it "
            "smaller (--set content.height_mm={:.3g}), or move it farther from the eye (--set content.depth_mm)",
            width > 0 ? fmt::format("{:.5g} x ", width) : "a height of ", height, screen_width, screen_height,
            0.9 * full_height / excess);
    if (excess < 0.1)
        a.say(
            "the scene is small: from the eye it covers a height of {:.3g} mm of the screen's {:.5g} mm. Make it larger "
            "(--set content.height_mm={:.3g})",
            height, screen_height, 0.5 * full_height / excess);
}

}  // namespace

void advise_on_scene(Advised& a) {
    const Geometry& g = a.geometry;
    const double eye = camera_distance_mm(a.display) - g.vertex_plane_mm;
    if (!(eye > 0) || advise_behind_eye(a, eye) || advise_near_eye(a, eye)) return;
    advise_on_size(a, eye);

    // The scene's depth is from the vertex plane, theory's from the rear principal plane.
    const double from_lens = g.content_depth_mm + g.vertex_plane_mm - g.rear_principal_mm;
    const bool at_lenses = std::abs(from_lens) <= widest_aperture_mm(g);  // where all views agree
    if (a.display.lens.type() == LensType::pinhole || at_lenses || is_sharp(a.theory, from_lens)) return;
    const double from_panel = camera_distance_mm(a.display);
    const SharpRange by_pixel = sharp_by_pixel(g, a.theory, from_panel), by_lens = sharp_by_lens(g, a.theory, from_panel);
    const bool within = by_lens.holds(g.content_depth_mm);
    a.say(
        "the content's centre, {}, is outside the depth of field by the pixel ({}), {} that by the lens ({}): its detail is {} the "
        "lens "
        "pitch",
        depth_in_words(g.content_depth_mm), depths_in_words(g, by_pixel, from_panel), within ? "within" : "and outside",
        depths_in_words(g, by_lens, from_panel), within ? "limited by" : "coarser than");
}

}  // namespace lfdsim
