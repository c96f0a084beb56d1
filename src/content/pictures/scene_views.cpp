// Views and depth maps of scenes by the cameras of a grid.

#include "content/pictures/cast.h"
#include "content/pictures/field_picture.h"

namespace lfdsim {
namespace {

/// Returns Van der Corput's sequence: with i/n it spreads n points evenly over a pixel.
double bits_reversed(std::int64_t i) {
    double value = 0, digit = 0.5;
    for (; i > 0; i >>= 1, digit /= 2) value += digit * double(i & 1);
    return value;
}

/// Rays from a camera of a grid through the pixels of the focus, a block at a time. Their direction has dz = -1, so that t is the
/// depth below the plane in which they start: that of the scene's top, or the camera's if that is lower.
class GridViewRays {
  public:
    GridViewRays(const ContentScene& scene, const Geometry& geometry, const ViewGrid& grid, int column, int row,
                 const ViewMaking& making)
        : grid_(grid), camera_(grid.camera(column, row)), making_(making) {
        centre_ = scene.centre_mm();
        const double focus_z = geometry.vertex_plane_mm + grid.depth_mm, top = scene.impl().half_mm[2] * 1.0001 + 1e-3;
        camera_z_ = focus_z + grid.distance_mm - centre_[2];
        start_z_ = std::min(camera_z_, top);
    }

    /// Returns the rays' width: a pixel of the focus, seen from the camera; N rays of a pixel share it.
    Beam beam() const {
        const double pixel = std::max(grid_.width_mm / making_.width, grid_.height_mm / making_.height);
        return {float(pixel / grid_.distance_mm / std::sqrt(double(making_.samples))), float(start_z_ - camera_z_)};
    }
    /// Returns the depth of the plane in which rays start below the camera, mm.
    float below_camera() const { return float(camera_z_ - start_z_); }

    /// Sets the rays of the block at (column, row) for block.sample.
    void operator()(int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        const double x_share = (double(block.sample) + 0.5) / double(making_.samples),
                     y_share = bits_reversed(block.sample) + 0.5 / double(making_.samples);
        for (int k = 0; k < RayBlock::lanes; ++k) {
            const double x = ((column + k % RayBlock::side + x_share) / making_.width - 0.5) * grid_.width_mm,
                         y = (0.5 - (row + k / RayBlock::side + y_share) / making_.height) * grid_.height_mm;
            const double mx = (x - camera_[0]) / grid_.distance_mm, my = (y - camera_[1]) / grid_.distance_mm;
            ray.org_x[k] = float(camera_[0] + mx * (camera_z_ - start_z_) - centre_[0]);
            ray.org_y[k] = float(camera_[1] + my * (camera_z_ - start_z_) - centre_[1]);
            ray.org_z[k] = float(start_z_);
            ray.dir_x[k] = float(mx);
            ray.dir_y[k] = float(my);
            ray.dir_z[k] = -1;
            block.exists.of[k] = block.may_hit.of[k] = -1;
        }
    }

  private:
    const ViewGrid& grid_;
    std::array<double, 2> camera_;
    ViewMaking making_;
    Vec3d centre_;
    double camera_z_, start_z_;  // relative to the scene's centre
};

/// The depth below the camera, mm, in place of light.
struct DepthLight {
    const ContentScene::Impl& scene;
    float below_camera;

    bool operator()(RayBlock& block) const {
        RTCRayHit16& packet = block.packet;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (int k = 0; k < RayBlock::lanes; ++k) {
            packet.ray.tfar[k] = INFINITY;
            packet.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(block.may_hit.of, scene.tree.get(), &context, &packet);
        for (int k = 0; k < RayBlock::lanes; ++k) {
            block.hit.of[k] = block.may_hit.of[k] & -int(packet.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID);
            for (Lanes& light : block.light) light.of[k] = below_camera + packet.ray.tfar[k];
        }
        return block.hit.any();
    }
};

}  // namespace

Picture scene_view(const ContentScene& scene, const Geometry& geometry, const ViewGrid& grid, int column, int row,
                   const ViewMaking& making, Job& job) {
    const GridViewRays rays(scene, geometry, grid, column, row, making);
    const RayRequest wanted{making.width, making.height, {0, 0, making.width, making.height}, making.samples};
    return cast(SceneLight{scene.impl(), rays.beam()}, wanted, making.threads, "view", job, rays);
}

Picture scene_view_depth(const ContentScene& scene, const Geometry& geometry, const ViewGrid& grid, int column, int row,
                         const ViewMaking& making, Job& job) {
    const ViewMaking middles{making.width, making.height, 1, making.threads};
    const GridViewRays rays(scene, geometry, grid, column, row, middles);
    const RayRequest wanted{making.width, making.height, {0, 0, making.width, making.height}};
    return cast(DepthLight{scene.impl(), rays.below_camera()}, wanted, making.threads, "depth of view", job, rays);
}

}  // namespace lfdsim
