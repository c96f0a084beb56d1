#include "analysis/dof_depths.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr int depths = 31;
constexpr double least_rows = 16;
constexpr double least_mm = 1e-6;  // of a depth, where the lenses have no thickness

/// An interval of 1/z, 1/mm from the rear principal plane.
struct DepthRange {
    double low, high;
    double length() const { return std::max(high - low, 0.); }
};

/// Where the scene's centre can be seen behind the lenses, and in front of them.
struct Reach {
    DepthRange behind, before;
};

Reach reach(const Subject& s) {
    const Geometry& g = s.geometry();
    const Display& d = s.display();
    const double size = 0.5 * g.content_height_mm.value_or(0);  // objects without a common height are in a scene
    const Vec3d half = s.has_scene() ? s.scene().half_size_mm() : Vec3d{size, size, size};
    const double rear = g.rear_principal_mm, from_panel = eye_distance_mm(d), eye = from_panel - rear;
    const double rows_per_mm = double(d.camera.resolution[0]) / g.frame_width_mm;  // in the plane of the camera's target
    const double farthest = 2 * half[1] * rows_per_mm * from_panel / least_rows;   // from the eye
    const double below = std::min(1.01 * (g.base_z_mm - rear), -least_mm), above = std::max(1.01 * (g.top_z_mm - rear), least_mm);
    const double nearest = 0.9 * (eye - half[2]);
    Reach r{{1, 0}, {1, 0}};
    if (eye - farthest < below) r.behind = {1 / below, 1 / (eye - farthest)};
    if (nearest > above) r.before = {1 / nearest, 1 / above};
    return r;
}

}  // namespace

std::vector<DepthRun> dof_depths(const Subject& s) {
    if (!s.options().depths_mm.empty()) {
        const std::string asked = "the requested depths end there";
        return {{s.options().depths_mm, asked, asked}};
    }
    const Theory& t = s.theory();
    const double middle = 0.5 * (t.depth_near_per_mm + t.depth_far_per_mm), half = t.depth_near_per_mm - t.depth_far_per_mm;
    const DepthRange wanted{middle - half, middle + half};  // twice as wide
    const auto cut = [&](const DepthRange& r) { return DepthRange{std::max(wanted.low, r.low), std::min(wanted.high, r.high)}; };
    const Reach reachable = reach(s);
    const DepthRange behind = cut(reachable.behind), before = cut(reachable.before);
    const double from_vertex = s.geometry().rear_principal_mm - s.geometry().vertex_plane_mm;
    const std::string twice = "twice theory's depth of field ends there", lenses = "the lenses stand there";
    std::vector<DepthRun> runs;
    const auto add = [&](const DepthRange& r, const std::string& beyond_low, const std::string& beyond_high) {
        const int count = int(std::lround(depths * r.length() / (behind.length() + before.length())));
        if (!(r.length() > 0) || count < 3) return;
        DepthRun run{{}, r.high < wanted.high ? beyond_low : twice, r.low > wanted.low ? beyond_high : twice};
        for (int k = 0; k < count; ++k) run.depths_mm.push_back(1 / (r.high + (r.low - r.high) * k / (count - 1)) + from_vertex);
        runs.push_back(std::move(run));
    };
    add(behind, "beyond it the scene looks too small", lenses);
    add(before, lenses, "beyond it the scene reaches the eye");
    return runs;
}

}  // namespace lfdsim
