#include "engine/estimator/gaussian_parts.h"

#include "engine/devices/kernel.h"
#include "engine/scene/traced_display.h"
#include "geometry/diffuser_profile.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

constexpr int many_boxes = 6;  // along an axis

std::vector<EvenPart> even_parts(const Display& display) {
    if (!display.diffuser || display.diffuser->profile == Profile::box || estimator_of(display) == Estimator::point)
        return {{display, 1}};
    // The samples of all parts together are about those wanted: as many along an axis for boxes as for each box's own, of which
    // more are better spent where there are many.
    const double wanted = std::sqrt(double(samples_of(display)));
    if (!(wanted <= max_strata - more_strata)) return {{display, 1}};  // which will be refused
    const int boxes = std::min(int(std::ceil(std::sqrt(wanted))), many_boxes), each = int(std::ceil(wanted / boxes));
    std::vector<EvenPart> parts;
    for (const DiffuserBox& box : boxes_of_normal_distribution(*display.diffuser, boxes)) {
        const auto number = std::uint64_t(parts.size());
        parts.push_back({display, float(box.weight)});
        Display& part = parts.back().display;
        part.diffuser->profile = Profile::box;
        part.diffuser->angle_deg = box.angle_deg;
        part.render.samples = each * each;
        // The noise of the parts must be independent. The golden ratio makes seeds far from those that users count up.
        part.render.seed = decltype(part.render.seed)(std::uint64_t(display.render.seed) + number * 0x9e3779b97f4a7c15);
    }
    return parts;
}

}  // namespace lfdsim
