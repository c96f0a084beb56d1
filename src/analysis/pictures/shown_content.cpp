#include "analysis/pictures/shown_content.h"

#include "analysis/core/subject.h"
#include "analysis/zone/zone.h"
#include "analysis/zone/zone_search.h"

#include <array>
#include <cmath>

namespace lfdsim {

std::vector<EyeBox> inverse_eyes(const Display& display, const Geometry& geometry, int threads, const Job& job) {
    if (std::vector<EyeBox> boxes = eye_boxes(display); !boxes.empty()) return boxes;
    constexpr double half_height_mm = 20;
    AnalysisOptions options;
    options.threads = threads;
    const double made_for = display.content.viewing_distance_mm;
    if (std::isfinite(made_for)) options.viewing_distance_mm = made_for;
    const Subject subject(display, {}, options);
    // The zone by theory, which serves if the search finds none
    const double z = subject.viewing_distance_mm(), eye = z - geometry.rear_principal_mm;
    const ParaxialZone theory = paraxial_zone(subject, 0);
    const std::size_t axis = line_of_eyes(geometry.lattice);
    EyeBox box{{0, 0, z}, {0, 0, z}};
    box.low[axis] = -eye * theory.half_slope(eye);
    box.high[axis] = eye * theory.half_slope(eye);
    if (!is_strips(display.array)) box.low[1] = -half_height_mm, box.high[1] = half_height_mm;
    // The zone by tracing, horizontally, or up and down where strips lie flat: its limits at 1 % wrong rays, else at 50 %
    Subject searched = subject;
    Quiet quiet(job);
    std::array<Interval, 2> limits_of_zone;
    try {
        ZoneSearch search(searched, quiet, zone_steps(searched));
        limits_of_zone = search.sideways(axis, eye * std::min(3 * theory.half_fov, std::tan(1.4))).limits;
    } catch (const Stopped&) {
        return {};
    }
    for (const Interval& limits : limits_of_zone) {
        const double low = limits.low.place(), high = limits.high.place();
        if (limits.empty || !(low < high)) continue;
        box.low[axis] = low;
        box.high[axis] = high;
        break;
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
