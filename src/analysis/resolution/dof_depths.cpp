#include "analysis/resolution/dof_depths.h"

#include "geometry/sharp_range.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int depths = 31;
constexpr double least_rows = 16, beyond = 1.25;  // rows of the picture; extent of the depths relative to what theory calls sharp

/// The farthest possible depths of the scene's centre behind the lenses and in front of them, mm from the vertex plane.
struct Reach {
    double behind, before;
};

/// Returns where the scene would be least_rows high, and where it would be 9/10 of the way to the eye.
Reach reach(const Subject& s) {
    const Geometry& g = s.geometry();
    const Display& d = s.display();
    const double size = 0.5 * g.content_height_mm.value_or(0);  // absent of objects without a common height; these have a scene
    const Vec3d half = s.has_scene() ? s.scene().half_size_mm() : Vec3d{size, size, size};
    const double from_panel = camera_distance_mm(d), eye = from_panel - g.vertex_plane_mm;
    const double rows_per_mm = double(d.camera.resolution[0]) / g.frame_width_mm;  // in the plane of the camera's target
    // The distance from the eye at which the scene is least_rows high
    const double farthest = 2 * half[1] * rows_per_mm * from_panel / least_rows;
    return {eye - farthest, 0.9 * (eye - half[2])};
}

}  // namespace

DepthRun dof_depths(const Subject& s) {
    if (!s.options().depths_mm.empty()) {
        const std::string asked = "the requested depths end there";
        return {s.options().depths_mm, asked, asked};
    }
    const Geometry& g = s.geometry();
    const double from_panel = camera_distance_mm(s.display()), eye = from_panel - g.vertex_plane_mm;
    // The ranges that theory calls sharp, bounded where they are infinite or reach the viewer, and a quarter more
    double low = 0, high = 0;
    for (const SharpRange& range : {sharp_by_lens(g, s.theory(), from_panel), sharp_by_pixel(g, s.theory(), from_panel)})
        for (const DepthSpan& span : {range.behind, range.in_front})
            if (!span.empty()) {
                low = std::min(low, std::isinf(span.low) ? std::min(2 * span.high, -eye / 4) : span.low);
                high = std::max(high, span.high >= eye ? std::max(2 * span.low, eye / 4) : span.high);
            }
    low *= beyond, high *= beyond;
    if (!(high > low)) return {};
    // They contain the lenses.
    high = std::max(high, g.top_z_mm - g.vertex_plane_mm + 0.1 * g.gap_mm);
    low = std::min(low, 1.01 * (g.base_z_mm - g.vertex_plane_mm) - 0.1 * g.gap_mm);
    const Reach most = reach(s);
    DepthRun run{{}, "the searched range, a quarter beyond what theory calls sharp or less, ends there", {}};
    run.why_high = run.why_low;
    if (low < most.behind) low = most.behind, run.why_low = "beyond it the scene looks too small";
    if (high > most.before) high = most.before, run.why_high = "beyond it the scene reaches the eye";
    if (!(high > low) || low >= 0 || high <= g.top_z_mm - g.vertex_plane_mm) return run;
    // z = c sinh(v) for even steps of v: even steps of z near the lenses, even ratios far from them. c = p' g/a is the depth at
    // which a pixel's image is a pitch wide.
    const double c = s.theory().along[0].elemental_pitch_mm / s.display().panel.pixel_pitch_mm * g.gap_mm;
    const double from = std::asinh(low / c), to = std::asinh(high / c);
    const int behind = std::clamp(int(std::lround((depths - 1) * -from / (to - from))), 1, depths - 3);
    for (int k = -behind; k < depths - behind; ++k) {
        double z = c * std::sinh(k < 0 ? from * -k / behind : to * k / (depths - 1 - behind));
        if (k == 0) z = g.top_z_mm - g.vertex_plane_mm;  // the lenses' plane, and not inside of them
        if (k < 0 && z > g.base_z_mm - g.vertex_plane_mm) continue;
        if (k > 0 && z <= run.depths_mm.back()) continue;
        run.depths_mm.push_back(z);
    }
    return run;
}

}  // namespace lfdsim
