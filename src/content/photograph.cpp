#include "content/cast.h"

namespace lfdsim {
namespace {

Vec3d minus(const Vec3d& a, const Vec3d& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vec3d& a, const Vec3d& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec3d cross(const Vec3d& a, const Vec3d& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec3d times(double s, const Vec3d& a) { return {s * a[0], s * a[1], s * a[2]}; }
Vec3d unit(const Vec3d& a) { return times(1 / std::sqrt(dot(a, a)), a); }

/// The pixels that may show a box, two of slack around it; all of them where some of it is behind the camera. `corner(n)` is one of
/// its eight corners in the frame (right, up, ahead) of the camera, whose pixels are `slope` wide and high.
template <class Corner>
Rect pixels_of_box(int width, int height, double slope, const Corner& corner) {
    double x0 = width, y0 = height, x1 = 0, y1 = 0;
    for (int n = 0; n < 8; ++n) {
        const Vec3d p = corner(n);
        if (!(p[2] > 0)) return {0, 0, width, height};
        const double x = 0.5 * width + p[0] / (p[2] * slope), y = 0.5 * height - p[1] / (p[2] * slope);
        x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
    }
    const auto pixel = [](double x, int most) { return int(std::clamp(x, 0., double(most))); };
    return {pixel(x0 - 2, width), pixel(y0 - 2, height), pixel(x1 + 2, width), pixel(y1 + 2, height)};
}

}  // namespace

Picture reference_photograph(const Display& display, const Geometry& geometry, const Scene& scene, int threads,
                             std::optional<Rect> crop, Job& job) {
    const Scene::Impl& impl = scene.impl();
    const Vec3d centre = scene.centre_mm();
    const Camera& camera = display.camera;
    const int width = int(camera.resolution[0]), height = int(camera.resolution[1]);
    const Vec3d towards = minus(camera.target_mm, camera.position_mm), axis = unit(towards);
    const Vec3d right = unit(cross(axis, camera.up)), up = cross(right, axis);
    // Slope of a pixel: directions are axis + slopes, so that t is the depth along the view axis.
    const double pixel = geometry.frame_width_mm / width / std::sqrt(dot(towards, towards));
    const Vec3d dx = times(pixel, right), dy = times(pixel, up);

    // Rays start in the plane that touches the scene's bounding sphere, or at the camera when that plane lies behind it.
    const Vec3d from = minus(camera.position_mm, centre);
    const double radius = 1.0001 * std::sqrt(dot(impl.half_mm, impl.half_mm)) + 1e-3, depth = -dot(from, axis);
    const double start = std::max(0., depth - radius);
    const Beam beam{float(pixel), float(-start)};
    const Rect seen = pixels_of_box(width, height, pixel, [&](int n) {
        Vec3d corner = times(-1, from);
        // The slack covers the rounding of positions.
        for (std::size_t k = 0; k < 3; ++k) corner[k] += (n >> k & 1 ? 1.0001 : -1.0001) * impl.half_mm[k];
        return Vec3d{dot(corner, right), dot(corner, up), dot(corner, axis)};
    });
    const auto fill = [&](int column, int row, RayBlock& block) {
        constexpr int side = RayBlock::side;
        const bool may_hit = column < seen.x1 && column + side > seen.x0 && row < seen.y1 && row + side > seen.y0;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            block.exists.of[k] = -1;
            block.may_hit.of[k] = -int(may_hit);
        }
        if (!may_hit) return;
        // A ray is the sum of what its column and its row give.
        RTCRay16& ray = block.packet.ray;
        float* const origin[3] = {ray.org_x, ray.org_y, ray.org_z};
        float* const direction[3] = {ray.dir_x, ray.dir_y, ray.dir_z};
        for (std::size_t c = 0; c < 3; ++c) {
            double of_column[side], of_row[side];
            for (int n = 0; n < side; ++n) {
                of_column[n] = axis[c] + (column + n + 0.5 - 0.5 * width) * dx[c];
                of_row[n] = (0.5 * height - row - n - 0.5) * dy[c];
            }
            for (int k = 0; k < RayBlock::lanes; ++k) {
                const double slope = of_column[k % side] + of_row[k / side];
                origin[c][k] = float(from[c] + start * slope);
                direction[c][k] = float(slope);
            }
        }
    };
    return cast(impl, beam, width, height, crop.value_or(Rect{0, 0, width, height}), threads, "photograph", job, fill);
}

}  // namespace lfdsim
