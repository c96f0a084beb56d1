#include "engine/screen.h"

#include "engine/scene.h"
#include "model/camera.h"
#include "model/numbers.h"

#include <cmath>

namespace lfdsim {

std::optional<Corners> screen_corners(const Display& display, const Geometry& geometry) {
    const optics::View view = make_view(display, geometry);
    const CameraAxes axes = camera_axes(display.camera);
    const double quarters = std::round(geometry.turn_deg / 90), rest = geometry.turn_deg - 90 * quarters;
    const double c = std::cos(rest * degree), s = std::sin(rest * degree);
    double half_width = geometry.array_width_mm / 2, half_height = geometry.array_height_mm / 2;
    if (std::fmod(quarters, 2) != 0) std::swap(half_width, half_height);

    constexpr double right[] = {-1, 1, 1, -1}, up[] = {1, 1, -1, -1};
    Corners corners;
    for (std::size_t k = 0; k < 4; ++k) {
        const double x = right[k] * half_width, y = up[k] * half_height;
        const Vec3d corner{c * x - s * y + geometry.lattice.offset[0], s * x + c * y + geometry.lattice.offset[1],
                           geometry.vertex_plane_mm};
        const Vec3d to = minus(corner, display.camera.position_mm);
        const double depth = dot(to, axes.forward);
        if (depth <= 1e-9 * view.distance) return {};
        const double pixels = view.distance / depth / view.pixel_mm;  // in the frame, of a millimetre at this depth
        corners[k] = {0.5 * view.width + dot(to, axes.right) * pixels, 0.5 * view.height - dot(to, axes.up) * pixels};
    }
    return corners;
}

}  // namespace lfdsim
