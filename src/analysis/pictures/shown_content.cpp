#include "analysis/pictures/shown_content.h"

#include "analysis/core/subject.h"
#include "analysis/zone/zone.h"
#include "analysis/zone/zone_search.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {

constexpr double half_height_mm = 20;  // of the default box of eyes, at most

std::vector<EyeBox> inverse_eyes(const Display& display, const Geometry& geometry, int threads, const Job& job) {
    if (std::vector<EyeBox> boxes = eye_boxes(display); !boxes.empty()) return boxes;
    AnalysisOptions options;
    options.threads = threads;
    const double made_for = display.content.viewing_distance_mm;
    if (std::isfinite(made_for)) options.viewing_distance_mm = made_for;
    const Subject subject(display, {}, options);
    const double z = subject.viewing_distance_mm(), eye = z - geometry.rear_principal_mm;
    Subject searched = subject;
    Quiet quiet(job);
    // Returns the zone along x (0) or y (1): its limits, traced, at 1 % wrong rays, else at 50 %, else those of theory; where
    // there is none, half the field of view of one lens.
    const auto zone_along = [&](std::size_t axis) {
        const ParaxialZone theory = paraxial_zone(subject, is_strips(display.array) ? 0 : axis);
        ZoneSearch search(searched, quiet, zone_steps(searched));
        for (const Interval& limits : search.sideways(axis, eye * std::min(3 * theory.half_fov, std::tan(1.4))).limits) {
            const double low = limits.low.place(), high = limits.high.place();
            if (!limits.empty && low < high) return std::array{low, high};
        }
        const double slope = theory.half_slope(eye) > 0 ? theory.half_slope(eye) : 0.5 * theory.half_fov;
        return std::array{-eye * slope, eye * slope};
    };
    EyeBox box{{0, 0, z}, {0, 0, z}};
    const std::size_t axis = line_of_eyes(geometry.lattice);
    try {
        const auto [left, right] = zone_along(axis);
        box.low[axis] = left;
        box.high[axis] = right;
        if (!is_strips(display.array)) {  // heads move less up and down
            const auto [low, high] = zone_along(1);
            box.low[1] = std::max(low, -half_height_mm);
            box.high[1] = std::min(high, half_height_mm);
        }
    } catch (const Stopped&) {
        return {};
    }
    return {box};
}

ShownContent shown_content(const Display& display, const Geometry& geometry, const ContentScene& scene, int threads, Job& job) {
    if (display.content.pickup != PickupKind::inverse) return {elemental_images(display, geometry, scene, threads, job), {}};
    const std::vector<EyeBox> eyes = inverse_eyes(display, geometry, threads, job);
    if (eyes.empty()) return {{Image(int(display.panel.pixels[0]), int(display.panel.pixels[1])), false}, {}};
    InvertedPanel made = invert(display, geometry, scene, eyes, threads, job);
    return {std::move(made.picture), std::move(made.report)};
}

}  // namespace lfdsim
