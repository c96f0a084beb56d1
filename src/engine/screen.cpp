#include "engine/screen.h"

#include "engine/scene.h"
#include "model/camera.h"
#include "model/numbers.h"

#include <array>
#include <cmath>

namespace lfdsim {

namespace {

/// Where the camera sees points in front of it, pixels from its picture's upper left corner.
class CameraPoints {
  public:
    CameraPoints(const Display& display, const Geometry& geometry)
        : position_(display.camera.position_mm), axes_(camera_axes(display.camera)), view_(make_view(display, geometry)) {}
    std::optional<std::array<double, 2>> of(const Vec3d& point) const {
        const Vec3d to = minus(point, position_);
        const double depth = dot(to, axes_.forward);
        if (depth <= 1e-9 * view_.distance) return {};
        const double pixels = view_.distance / depth / view_.pixel_mm;  // in the frame, of a millimetre at this depth
        return std::array{0.5 * view_.width + dot(to, axes_.right) * pixels, 0.5 * view_.height - dot(to, axes_.up) * pixels};
    }
    /// Of a rectangle's corners from the top left on, clockwise.
    template <class Corner>
    std::optional<Corners> of_corners(const Corner& corner) const {
        constexpr double right[] = {-1, 1, 1, -1}, up[] = {1, 1, -1, -1};
        Corners corners;
        for (std::size_t k = 0; k < 4; ++k) {
            const auto at = of(corner(right[k], up[k]));
            if (!at) return {};
            corners[k] = *at;
        }
        return corners;
    }

  private:
    Vec3d position_;
    CameraAxes axes_;
    optics::View view_;
};

}  // namespace

std::optional<Corners> screen_corners(const Display& display, const Geometry& geometry) {
    const double quarters = std::round(geometry.turn_deg / 90), rest = geometry.turn_deg - 90 * quarters;
    const double c = std::cos(rest * degree), s = std::sin(rest * degree);
    double half_width = geometry.array_width_mm / 2, half_height = geometry.array_height_mm / 2;
    if (std::fmod(quarters, 2) != 0) std::swap(half_width, half_height);
    return CameraPoints(display, geometry).of_corners([&](double right, double up) {
        const double x = right * half_width, y = up * half_height;
        return Vec3d{c * x - s * y + geometry.lattice.offset[0], s * x + c * y + geometry.lattice.offset[1],
                     geometry.vertex_plane_mm};
    });
}

std::optional<Region> screen_region(const Display& display, const Geometry& geometry) {
    const auto array = screen_corners(display, geometry);
    const auto panel = CameraPoints(display, geometry).of_corners([&](double right, double up) {
        return Vec3d{right * geometry.panel_width_mm / 2, up * geometry.panel_height_mm / 2, 0};
    });
    if (!array || !panel) return {};
    const int width = int(display.camera.resolution[0]), height = int(display.camera.resolution[1]);
    return Region::polygon(*array, width, height).intersected(Region::polygon(*panel, width, height));
}

}  // namespace lfdsim
