// Checks of the resolved geometry: parts must not collide, and lengths must be within bounds.

#include <cmath>

#include "checks/findings.h"
#include "display/keys.h"
#include "geometry/lens_misalignment.h"
#include "geometry/prescription.h"

namespace lfdsim {
namespace {

// The lens must lie in front of the panel and its layers, and the planes that theory measures from must be at finite positions.
void check_heights(const Display& d, const Geometry& g, Findings& findings) {
    const char* given = d.array.gap_mm ? "array.gap_mm" : "array.base_z_mm";
    if (!positive_length.contains(g.gap_mm))
        findings.add(given, "puts the lens's panel-side principal plane {:.6g} mm in front of the panel, allowed is {}", g.gap_mm,
                     positive_length.text());
    else if (const double into = g.layers_top_mm - g.base_z_mm; !(into <= rounding_mm)) {
        const double value = d.array.gap_mm ? g.gap_mm : g.base_z_mm;
        findings.add(given, "{} mm puts the lens's lowest point {:.6g} mm into the {}; give at least {:.6g} mm", value, into,
                     d.panel.layers.empty() ? "panel" : "panel's layers", value + into);
    } else if (!(g.top_z_mm <= longest_mm && std::abs(g.rear_principal_mm) <= longest_mm))
        findings.add(given, "puts the lens's top at {:.6g} mm and its viewer-side principal plane at {:.6g} mm, allowed is {}",
                     g.top_z_mm, g.rear_principal_mm, any_length.text());
}

void check_size(const char* where, double width, double height, Findings& findings) {
    if (std::max(width, height) > longest_mm)
        findings.add(where, "makes {:.6g} x {:.6g} mm, allowed is {} mm", width, height, longest_mm);
}

void check_camera(const Display& d, const Geometry& g, Findings& findings) {
    const Vec3d &eye = d.camera.position_mm, &target = d.camera.target_mm;
    const double across = std::hypot(target[0] - eye[0], target[1] - eye[1]), distance = std::hypot(across, target[2] - eye[2]);
    const double top = std::max(g.top_z_mm, g.diffuser_z_mm.value_or(0));
    // A pupil is perpendicular to the line of sight: when the camera looks sideways, by the angle theta from the normal, its rim
    // reaches lower than its centre by A/2 sin(theta).
    const double rim = eye[2] - d.camera.pupil_diameter_mm.value_or(0) / 2 * across / distance;
    if (!(eye[2] > top))
        findings.add("camera.position_mm", "z = {} mm is inside the display, whose {} {:.6g} mm from the panel; give a larger z",
                     eye[2], g.diffuser_z_mm ? "diffuser stands" : "lenses end", top);
    else if (!(rim > top))
        findings.add("camera.pupil_diameter_mm",
                     "{} mm lowers the pupil's rim to z = {:.6g} mm, into the display, which ends {:.6g} mm from the panel; take a "
                     "smaller pupil, or a camera further away",
                     *d.camera.pupil_diameter_mm, rim, top);
    if (findings.sound("panel.") && !positive_length.contains(g.frame_width_mm))
        findings.add("camera.fov_deg", "{} degrees at {:.6g} mm from the target make a frame {:.6g} mm wide, allowed is {}",
                     d.camera.fov_deg.value_or(0), distance, g.frame_width_mm, positive_length.text());
}

}  // namespace

void validate_layout(const Display& d, Findings& findings) {
    if (findings.sound("panel."))
        check_size("panel.pixels", double(d.panel.pixels[0]) * d.panel.pixel_pitch_mm,
                   double(d.panel.pixels[1]) * d.panel.pixel_pitch_mm, findings);
    // A lens that cannot be made has no position, nor has one on layers that cannot.
    for (const char* needed : {"lens.", "array.", "panel.layer", "panel.wavelengths_nm"})
        if (!findings.sound(needed)) return;
    const Geometry g = resolve_unchecked(without_errors(d));
    check_heights(d, g, findings);
    check_size("array.count", g.array_width_mm, g.array_height_mm, findings);
    if (d.diffuser && findings.sound("diffuser.") && !(*g.diffuser_z_mm > g.top_z_mm))
        findings.add(
            "diffuser.distance_mm",
            "{} mm puts the diffuser inside the lenses, which extend {:.6g} mm above the vertex plane; give more than that",
            d.diffuser->distance_mm, g.top_z_mm - g.vertex_plane_mm);
    // A misplaced diffuser might put the camera below it: one fault is reported, not two.
    if (findings.sound("camera.") && findings.sound("diffuser.")) check_camera(d, g, findings);
    if (findings.sound("content.") && !(d.content.viewing_distance_mm > g.top_z_mm))
        findings.add("content.viewing_distance_mm",
                     "{} mm is inside the display, whose lenses end {:.6g} mm from the panel; give more than that, or inf",
                     d.content.viewing_distance_mm, g.top_z_mm);
}

}  // namespace lfdsim
