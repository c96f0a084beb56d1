#include "geometry/sharp_range.h"

#include "base/constants.h"
#include "checks/depth_words.h"
#include "geometry/resolve.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

// docs/measures.md, "Depth of field".
namespace lfdsim {
namespace {

constexpr DepthSpan no_depths{nan, nan};
constexpr double rounding_mm = 1e-6;  // of an end at the lenses

/// Returns the depths from `low` to `high`, mm from the rear principal plane, as depths from the vertex plane: those in front of
/// the lenses up to the viewer, or those behind them.
DepthSpan cut(const Geometry& g, double low, double high, bool in_front, double eye_mm) {
    const double from_vertex = g.rear_principal_mm - g.vertex_plane_mm, viewer = eye_mm - g.vertex_plane_mm;
    const DepthSpan span{in_front ? std::max(low + from_vertex, 0.) : low + from_vertex,
                         in_front ? std::min(high + from_vertex, viewer) : std::min(high + from_vertex, 0.)};
    return span.empty() || (in_front && span.low >= viewer) ? no_depths : span;
}

}  // namespace

SharpRange range_of_inverse(const Geometry& g, double near, double far, double eye_mm) {
    SharpRange range{no_depths, no_depths};
    if (!(far <= near)) return range;
    // 1/z falls with z, so on each side the nearer end of the depths is the one of the larger |1/z|.
    if (near > 0) range.in_front = cut(g, 1 / near, far > 0 ? 1 / far : infinity, true, eye_mm);
    if (far < 0) range.behind = cut(g, near < 0 ? 1 / near : -infinity, 1 / far, false, eye_mm);
    return range;
}

SharpRange range_between(const Geometry& g, double low, double high, double eye_mm) {
    SharpRange range{no_depths, no_depths};
    const double from_vertex = g.rear_principal_mm - g.vertex_plane_mm;
    if (high + from_vertex >= 0) range.in_front = cut(g, low, high, true, eye_mm);
    if (low + from_vertex < -rounding_mm) range.behind = cut(g, low, high, false, eye_mm);
    return range;
}

SharpRange sharp_by_pixel(const Geometry& g, const Theory& t, double eye_mm) {
    return range_of_inverse(g, t.depth_near_per_mm, t.depth_far_per_mm, eye_mm);
}

std::size_t tighter_axis(const Geometry& g) {
    if (g.lattice.strips) return 0;
    const auto& D = g.clear_aperture_mm;
    const double x = lens_pitch_mm(g, 0) / D[0], y = lens_pitch_mm(g, 1) / D[1];
    constexpr double equal = 1e-12;  // relative: ratios closer than this differ by rounding alone
    return std::abs(x - y) <= equal * x ? (D[1] > D[0] ? 1 : 0) : (y < x ? 1 : 0);
}

SharpRange sharp_by_lens(const Geometry& g, const Theory& t, double eye_mm) {
    const std::size_t axis = tighter_axis(g);
    const double L = t.central_depth_mm, pitches = std::max(lens_pitch_mm(g, axis) / g.clear_aperture_mm[axis], 1.);
    if (std::isnan(L)) return {no_depths, no_depths};
    if (std::isinf(L)) return range_between(g, -infinity, infinity, eye_mm);
    const double one = L * (1 - pitches), other = L * (1 + pitches);  // |1 - z/L| = p/D
    return range_between(g, std::min(one, other), std::max(one, other), eye_mm);
}

std::string depths_in_words(const Geometry& g, const SharpRange& range, double eye_mm) {
    const DepthSpan &behind = range.behind, &front = range.in_front;
    const bool to_viewer = front.high >= eye_mm - g.vertex_plane_mm;
    const std::string before = to_viewer ? "the viewer" : depth_in_words(front.high);
    if (!behind.empty() && !front.empty() && behind.high == 0 && front.low == 0)
        return fmt::format("from {} to {}", std::isinf(behind.low) ? "infinity behind the lenses" : depth_in_words(behind.low),
                           before);
    std::string words;
    if (!behind.empty())
        words = std::isinf(behind.low) ? fmt::format("from {} to infinity", depth_in_words(behind.high))
                                       : fmt::format("from {} to {}", length_in_words(-behind.high), depth_in_words(behind.low));
    if (!front.empty())
        words += fmt::format("{}from {} to {}", words.empty() ? "" : " and ",
                             to_viewer ? depth_in_words(front.low) : length_in_words(front.low), before);
    return words.empty() ? "no depth up to the viewer" : words;
}

double lens_limit_per_mm(const Display& d, const Geometry& g, const Theory& t, double depth, double eye_mm, std::size_t axis) {
    const double to_eye = eye_mm - g.vertex_plane_mm, p = lens_pitch_mm(g, axis), L = t.central_depth_mm;
    const double seen = g.clear_aperture_mm[axis] * g.gap_mm * std::abs(1 / (eye_mm - g.rear_principal_mm) - 1 / L);
    if (!(seen >= d.panel.pixel_pitch_mm)) return to_eye / (2 * p * (to_eye - depth));  // pinholes, too, which have no L
    const double jump = std::abs(1 - (depth + g.vertex_plane_mm - g.rear_principal_mm) / L);
    return jump > 1e-9 ? 1 / (2 * p * jump) : infinity;  // what is less is left by rounding
}

double pixel_limit_per_mm(const Display& d, const Geometry& g, double depth) {
    return g.gap_mm / (2 * d.panel.pixel_pitch_mm * std::abs(depth + g.vertex_plane_mm - g.rear_principal_mm));
}

double cycles_per_degree(const Geometry& g, double per_mm, double depth, double eye_mm) {
    return per_mm * (eye_mm - g.vertex_plane_mm - depth) * degree;
}

}  // namespace lfdsim
