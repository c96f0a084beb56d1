#include "engine/even_parts.h"

#include "engine/scene.h"
#include "model/bell.h"

#include <cmath>

namespace lfdsim {

constexpr int most_boxes = 8;  // along an axis

std::vector<EvenPart> even_parts(const Display& display, bool converges) {
    if (!display.diffuser || display.diffuser->profile == Profile::box || estimator_of(display) == Estimator::point)
        return {{display, 1}};
    // The samples of all parts together are about those wanted: as many along an axis for boxes as for each box's own.
    const double wanted = std::sqrt(double(samples_of(display)));
    if (!(wanted <= most_boxes * most_boxes)) return {{display, 1}};  // which will be refused
    const int boxes = converges ? most_boxes : int(std::ceil(std::sqrt(wanted))), each = int(std::ceil(wanted / boxes));
    std::vector<EvenPart> parts;
    for (const DiffuserBox& box : boxes_of_bell(*display.diffuser, boxes)) {
        parts.push_back({display, float(box.weight)});
        Display& part = parts.back().display;
        part.diffuser->profile = Profile::box;
        part.diffuser->angle_deg = box.angle_deg;
        part.render.samples = each * each;
    }
    return parts;
}

}  // namespace lfdsim
