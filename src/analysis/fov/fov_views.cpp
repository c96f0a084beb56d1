// Views of the scene and photographs of it over the angle of the view, and the geometric edges. docs/measures.md, "Field of
// view".

#include "analysis/fov/fov_views.h"

#include "analysis/crosstalk/slope_spread.h"
#include "analysis/fov/fov.h"
#include "analysis/pictures/views.h"
#include "base/constants.h"
#include "engine/views/pipelined.h"
#include "geometry/screen.h"
#include "geometry/vec.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

constexpr double wanted_error_deg = 0.05;  // of a geometric edge

double widest_edge_deg(const Subject& s) {
    double widest = 0;
    for (int axis = 0; axis < imaging_axes(s.display().array); ++axis) widest = std::max(widest, theory_edge_deg(s, axis));
    return widest;
}

}  // namespace

double theory_edge_deg(const Subject& s, int axis) { return arc_edge_deg(s.geometry(), s.theory(), s.viewing_distance_mm(), axis); }

double fades_over_deg(const Subject& s, int axis) {
    // Lenses at X across the screen have their edge shifted by X (1/E - 1/M) in slope, M = D' - z_H'.
    const double rear = s.geometry().rear_principal_mm, eye = s.viewing_distance_mm() - rear;
    const double size = screen_size_mm(s.geometry())[std::size_t(axis)];
    const double across = size * std::abs(1 / eye - 1 / (s.display().content.viewing_distance_mm - rear));
    return std::atan(0.5 * (SlopeSpread(s, eye, axis).width() + across)) / degree;
}

std::vector<double> fov_angles_deg(const Subject& s) {
    if (!s.options().angles_deg.empty()) return s.options().angles_deg;
    const double half = widest_edge_deg(s);
    const double most = std::min({80., arc(s.display(), s.geometry(), s.viewing_distance_mm(), 0).most,
                                  half <= 20.5 ? std::min(1.5 * half, 30.) : std::ceil(half) + 10});
    const int side = std::max(30, int(most));
    std::vector<double> angles;
    for (int k = -side; k <= side; ++k) angles.push_back(most * k / side);
    return angles;
}

double fov_depth_mm(const Subject& s) {
    const Geometry& g = s.geometry();
    const double distance = s.viewing_distance_mm(), described = g.content_depth_mm;
    const double edge = std::min(widest_edge_deg(s) + 2, 80.) * degree;
    const double half_screen = 0.5 * std::min({g.array_width_mm, g.array_height_mm, g.panel_width_mm, g.panel_height_mm});
    // What is d behind the lenses is seen through the screen at X d/(d + E), X the eye's distance from the axis.
    const double aside = distance * std::sin(edge), ahead = distance * std::cos(edge) - g.vertex_plane_mm;
    const double behind = aside > half_screen ? half_screen * ahead / (aside - half_screen) : 1e6;
    const double most = half_screen / std::tan(edge);
    return std::clamp(described, -std::max(most, behind), most);
}

double fov_scene_depth_mm(const Subject& s, const std::vector<double>& angles) {
    const double nearest = s.viewing_distance_mm() * std::cos(std::max(-angles.front(), angles.back()) * degree);
    const double most = nearest - s.geometry().vertex_plane_mm - 2 * length(s.scene().half_size_mm());
    const double depth = std::min(fov_depth_mm(s), most), below = s.geometry().base_z_mm - s.geometry().vertex_plane_mm;
    // The centre is never inside the lenses: it goes just behind them if the eyes leave no room in front.
    return depth >= below && depth < 0 && most < 0 ? 1.01 * below : depth;
}

AngleCurves angle_curves(const Subject& subject, const ShownEdge& shown, int axis, const std::vector<double>& angles, Job& job) {
    const EyePath path = arc(subject.display(), subject.geometry(), subject.viewing_distance_mm(), axis);
    const auto seen_at = [&](double angle) { return seen_by(subject.display(), path.eye(angle)); };
    const auto expected_at = [&](double angle) {
        return expected_view(seen_at(angle), subject.geometry(), shown.scene, subject.threads(), job);
    };
    const auto likeness_at = [&](double angle, const ExpectedView& expected) {
        return likeness(expected, seen_at(angle), subject.geometry(), shown.panel, shown.white, subject.rendering(), job);
    };
    AngleCurves curves{{angles, {}}, {angles, {}}, {angles, {}}};
    const auto compare = [&](std::size_t k, const ExpectedView& expected) {
        const Likeness l = likeness_at(angles[k], expected);
        curves.screen.value.push_back(l.screen);
        curves.content.value.push_back(l.content);
        curves.share.value.push_back(l.share);
        job.advance(1);
        return true;
    };
    // The CPU photographs the scene from the next angle while a GPU renders and compares.
    make_ahead(
        angles.size(), renders_on_gpu(subject.rendering()), [&](std::size_t k) { return expected_at(angles[k]); }, compare);
    // The curves' noise is measured where it matters, at the edges by theory and half-way to them, as a root mean square.
    const double edge = std::min(theory_edge_deg(subject, axis), angles.back());
    const double places[] = {-edge, -0.5 * edge, 0.5 * edge, edge};
    for (const double angle : places) {
        const ExpectedView expected = expected_at(angle);
        const Likeness e = likeness_error(likeness_at(angle, expected), expected, seen_at(angle), subject.geometry(), shown.panel,
                                          shown.white, subject.rendering(), job);
        curves.screen.error += e.screen * e.screen / std::size(places);
        curves.content.error += e.content * e.content / std::size(places);
        curves.share.error += e.share * e.share / std::size(places);
        job.advance(2);
    }
    for (Curve* c : {&curves.screen, &curves.content, &curves.share}) c->error = std::sqrt(c->error);
    return curves;
}

std::int64_t geometric_fov_steps(const Subject& s) { return pictures_worth(s, 3'000'000); }

GeometricFov geometric_fov(const Subject& s, Job& job) {
    const Display& d = s.display();
    const OwnLens lenses(d, false), diffused(d, true);
    const double distance = s.viewing_distance_mm(), away = distance - s.geometry().rear_principal_mm;
    const std::uint32_t seed = std::uint32_t(d.render.seed);
    Parts parts(job, s.threads(), (d.diffuser ? 6 : 4) * own_range_parts, geometric_fov_steps(s));
    GeometricFov edges;
    for (int axis = 0; axis < imaging_axes(d.array); ++axis) {
        const auto k = std::size_t(axis);
        const EyePath path = arc(d, s.geometry(), distance, axis);
        edges.lenses[k] = where_own(lenses, path, wanted_error_deg, seed, parts);
        edges.diffused[k] = d.diffuser ? where_own(diffused, path, wanted_error_deg, seed, parts) : edges.lenses[k];
        edges.eyebox[k] = where_own(lenses, across(d, s.geometry(), distance, axis), wanted_error_deg * degree * away, seed, parts);
    }
    edges.whole_images = lenses.whole_images();
    return edges;
}

}  // namespace lfdsim
