#include "content/cast.h"
#include "content/pickup.h"

namespace lfdsim {

Picture elemental_images(const Display& display, const Geometry& geometry, const Scene& scene, int threads, Job& job) {
    const Scene::Impl& impl = scene.impl();
    const Pickup pickup(display, geometry);
    // The viewer's first surface along the line: rays start in the plane z = top, just above the scene on the viewer's side,
    // and travel towards the panel and beyond it. Their direction has dz = -1, so that t is the depth below the plane.
    const double half = impl.half_mm[2] * 1.0001 + 1e-3, top = impl.centre_mm[2] + half;
    const Beam beam{float(2 * half), float(display.panel.pixel_pitch_mm / geometry.gap_mm), float(top - pickup.z_rear)};
    const auto fill = [&](int column, int row, RayBlock& rays) {
        for (int k = 0; k < RayBlock::lanes; ++k) {
            const NodalLine line = pickup.line(pickup.x_mm(column + k % RayBlock::side), pickup.y_mm(row + k / RayBlock::side));
            rays.x[k] = float(line.x + line.mx * (top - pickup.z_rear) - impl.centre_mm[0]);
            rays.y[k] = float(line.y + line.my * (top - pickup.z_rear) - impl.centre_mm[1]);
            rays.z[k] = float(half);
            rays.dx[k] = float(-line.mx);
            rays.dy[k] = float(-line.my);
            rays.dz[k] = -1;
            rays.exists[k] = line.owned;
        }
    };
    const int width = int(display.panel.pixels[0]), height = int(display.panel.pixels[1]);
    return cast(impl, beam, width, height, {0, 0, width, height}, threads, "elemental images", job, fill);
}

}  // namespace lfdsim
