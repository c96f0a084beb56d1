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

}  // namespace

Picture reference_photograph(const Display& display, const Geometry& geometry, const Scene& scene, int threads,
                             std::optional<Rect> crop, Job& job) {
    const Scene::Impl& impl = scene.impl();
    const Camera& camera = display.camera;
    const int width = int(camera.resolution[0]), height = int(camera.resolution[1]);
    const Vec3d towards = minus(camera.target_mm, camera.position_mm), axis = unit(towards);
    const Vec3d right = unit(cross(axis, camera.up)), up = cross(right, axis);
    // Slope of a pixel: directions are axis + slopes, so that t is the depth along the view axis.
    const double pixel = geometry.frame_width_mm / width / std::sqrt(dot(towards, towards));
    const Vec3d dx = times(pixel, right), dy = times(pixel, up);

    // Rays start in the plane that touches the scene's bounding sphere, or at the camera when that plane lies behind it.
    const Vec3d from = minus(camera.position_mm, impl.centre_mm);
    const double radius = 1.0001 * std::sqrt(dot(impl.half_mm, impl.half_mm)) + 1e-3, depth = -dot(from, axis);
    const double start = std::max(0., depth - radius);
    const Beam beam{float(std::max(0., depth + radius - start)), float(pixel), float(-start)};
    const auto fill = [&](int column, int row, RayBlock& rays) {
        for (int k = 0; k < RayBlock::lanes; ++k) {
            const double i = column + k % RayBlock::side + 0.5 - 0.5 * width, j = 0.5 * height - row - k / RayBlock::side - 0.5;
            const double x = axis[0] + i * dx[0] + j * dy[0], y = axis[1] + i * dx[1] + j * dy[1],
                         z = axis[2] + i * dx[2] + j * dy[2];
            rays.x[k] = float(from[0] + start * x);
            rays.y[k] = float(from[1] + start * y);
            rays.z[k] = float(from[2] + start * z);
            rays.dx[k] = float(x);
            rays.dy[k] = float(y);
            rays.dz[k] = float(z);
            rays.exists[k] = true;
        }
    };
    return cast(impl, beam, width, height, crop.value_or(Rect{0, 0, width, height}), threads, "photograph", job, fill);
}

}  // namespace lfdsim
