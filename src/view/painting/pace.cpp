#include "view/painting/pace.h"

#include "engine/scene/traced_display.h"

#include <algorithm>
#include <cmath>

namespace lfdsim::view {

// The constants were measured on displays/desktop-asphere.toml: nanoseconds of one core for a pixel, with blocks of 16, 8 and 4
// pixels.
double render_cost(const Display& d, const Geometry& g, bool rough) {
    constexpr double point_ns = 25, wide_ns = 40, middle_ns = 50, small_ns = 300;
    const double pixels = double(d.camera.resolution[0]) * double(d.camera.resolution[1]), samples = double(samples_of(d));
    if (estimator_of(d) == Estimator::point) return pixels * samples * point_ns * 1e-9;
    const int side =
        block_shape(make_traced_display<float>(d, g), make_ray_origin(d, g), int(std::lround(std::sqrt(samples))), rough).side;
    return pixels * std::max(1., samples / 4) * (side == 16 ? wide_ns : side == 8 ? middle_ns : small_ns) * 1e-9;
}

}  // namespace lfdsim::view
