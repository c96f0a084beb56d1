#include "view/answers/plots.h"

#include "analysis/core/elemental_panel.h"
#include "analysis/core/eye_rays.h"
#include "analysis/fov/fov.h"
#include "analysis/pictures/views.h"
#include "analysis/spots/ray_fan.h"
#include "base/constants.h"
#include "geometry/vec.h"

#include <fmt/format.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

namespace lfdsim::view {
namespace {

constexpr std::int64_t picture_width = 320, most_panel_pixels = std::int64_t(7680) * 4320;
constexpr int angles_each_side = 12, spot_depths = 161, spot_rays = 301;

/// Returns the display with a camera at the same distance on the axis, whose small pictures have the default frame.
Display small(Display d) {
    const double distance = length(d.camera.position_mm);
    d.camera = {};
    d.camera.position_mm = {0, 0, distance};
    d.camera.resolution = {picture_width, picture_width * 9 / 16};
    return d;
}

}  // namespace

Plot fov_plot(const Display& display, const ContentScene& shown_there, const std::string& device, const Job& job) {
    if (const auto [columns, rows] = display.panel.pixels; columns * rows > most_panel_pixels)
        throw InputError("panel.pixels",
                         fmt::format("{} x {} are too many for this plot, which is limited to 7680 x 4320; use lfdsim analyze fov",
                                     columns, rows));
    // One plot at a time is made for all visitors: each takes all processors and up to two gigabytes.
    static std::timed_mutex mutex;
    std::unique_lock lock(mutex, std::defer_lock);
    while (!lock.try_lock_for(std::chrono::milliseconds(20)))
        if (job.cancelled()) throw Stopped{};
    // The angles go to 1.35 times the theoretical edge and 2 degrees more, but only as far as the eye is in front of the
    // display.
    const Display d = small(display);
    const Geometry g = resolve(d);
    AnalysisOptions options;
    options.device = device;
    Subject subject(d, shown_there.before(g), options);
    const double edge = 0.5 * subject.theory(0).fov_elemental_deg, depth = fov_depth_mm(subject);
    const double highest =
        std::acos(std::min(1.2 * nearest_eye_mm(g) / d.camera.position_mm[2], 1.)) / degree;  // still in front of the display
    const double most = std::min({80., highest, 1.35 * edge + 2});
    const ContentScene scene = subject.scene().at_depth(depth);
    const double white = subject.white_field(job);
    const auto shown = elemental_panel(d, g, scene, 0, job);

    // The views and their likeness.
    Series of_content{"content", {}, {}}, of_screen{"whole screen", {}, {}};
    for (int k = -angles_each_side; k <= angles_each_side; ++k) {
        const double angle = most * k / angles_each_side;
        const Display seen = seen_from(d, angle, 0);
        const Likeness l =
            likeness(expected_view(seen, g, scene, 0, job), seen, g, shown->summed(), white, subject.rendering(), job);
        for (Series* of : {&of_content, &of_screen}) of->x.push_back(angle);
        of_content.y.push_back(l.content);
        of_screen.y.push_back(l.screen);
    }
    Plot plot{"fov", "Likeness of the simulated view to the scene", "horizontal angle of the view, degrees", "SSIM", {}};
    plot.series = {std::move(of_content), std::move(of_screen)};
    for (const double side : {-edge, edge})
        if (std::abs(side) <= most) plot.marks.push_back({"2 atan(p' / 2g)", side});
    plot.marks.push_back({"eye", std::atan2(display.camera.position_mm[0], display.camera.position_mm[2]) / degree});
    return plot;
}

Plot spot_plot(const Display& d) {
    const Geometry g = resolve(d);
    const Theory t = theory(d, g);
    const double L = t.central_depth_mm, from_vertex = g.rear_principal_mm - g.vertex_plane_mm;
    const std::vector<FanRay> fan = fans(LensTrace(d, g), {0, 0}, spot_rays).meridional;
    // Depths go to one and a half times the depth of field about L; where L is infinite, to twice the viewer's distance.
    const bool finite = std::abs(L) < 1e6;
    const double reach = finite ? std::clamp(0.75 * t.depth_of_field_mm, 0.2 * std::abs(L), 0.95 * std::abs(L)) : 0;
    const double low = finite ? L - reach : 0, high = finite ? L + reach : 2 * d.camera.position_mm[2];
    Series traced{"traced spot", {}, {}}, diffuse{"with the diffuser", {}, {}}, pixel{"a panel pixel's image", {}, {}};
    const std::vector<FanRay> after =
        d.diffuser ? diffused(fan, *g.diffuser_z_mm - g.rear_principal_mm, diffuser_angle(d, g, {1, 0})) : std::vector<FanRay>{};
    for (int k = 0; k < spot_depths; ++k) {
        const double z = low + (high - low) * k / (spot_depths - 1);
        for (Series* s : {&traced, &diffuse, &pixel}) s->x.push_back(z + from_vertex);
        traced.y.push_back(fan.empty() ? NAN : width_at(fan, z).mm);
        diffuse.y.push_back(after.empty() ? NAN : width_at(after, z).mm);
        pixel.y.push_back(d.panel.pixel_pitch_mm * std::abs(z) / g.gap_mm);
    }
    Plot plot{"spot", "Spot of a panel point on the lens's axis", "depth in front of the lenses, mm", "width, mm", {}};
    plot.series = {std::move(traced)};
    if (d.diffuser) plot.series.push_back(std::move(diffuse));
    plot.series.push_back(std::move(pixel));
    if (finite) plot.marks.push_back({"central depth plane, paraxial", L + from_vertex});
    return plot;
}

}  // namespace lfdsim::view
