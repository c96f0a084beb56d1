// The reference photograph. docs/model.md, "Reference photograph".

#include "content/pictures/cast.h"
#include "geometry/vec.h"
#include "optics/camera.h"
#include "optics/direction_numbers.h"

namespace lfdsim {
namespace {

// Returns the unit vector like normalised(), but with a different rounding, on which the bits of photographs depend.
Vec3d unit(const Vec3d& a) { return times(1 / std::sqrt(dot(a, a)), a); }

/// The camera's axes and pixels. Directions of rays are axis + slopes, so that their t is the depth along the axis.
struct CameraFrame {
    Vec3d axis, right, up;
    int width, height;
    double slope;               // width of a pixel as a slope
    double pupil_mm, focus_mm;  // radius of the pupil, 0: a pinhole; depth of the plane in which a pixel's rays meet

    CameraFrame(const Camera& camera, const Geometry& geometry) {
        const Vec3d towards = minus(camera.target_mm, camera.position_mm);
        axis = unit(towards);
        right = unit(cross(axis, camera.up));
        up = cross(right, axis);
        width = int(camera.resolution[0]);
        height = int(camera.resolution[1]);
        slope = geometry.frame_width_mm / width / std::sqrt(dot(towards, towards));
        pupil_mm = camera.pupil_diameter_mm.value_or(0) / 2;
        focus_mm = geometry.focus_distance_mm;
    }
};

/// Returns the pixels that may show a box, with a margin of two; all pixels if part of it is behind the camera. `corner(n)` is
/// one of its eight corners in the frame (right, up, ahead). Seen from a point o of the pupil a point's image is shifted by o
/// (1/focus - 1/depth).
template <class Corner>
Rect pixels_of_box(const CameraFrame& frame, const Corner& corner) {
    double x0 = frame.width, y0 = frame.height, x1 = 0, y1 = 0;
    for (int n = 0; n < 8; ++n) {
        const Vec3d p = corner(n);
        if (!(p[2] > 0)) return {0, 0, frame.width, frame.height};
        const double x = 0.5 * frame.width + p[0] / (p[2] * frame.slope), y = 0.5 * frame.height - p[1] / (p[2] * frame.slope);
        const double blur = frame.pupil_mm * std::abs(1 / frame.focus_mm - 1 / p[2]) / frame.slope;
        x0 = std::min(x0, x - blur), x1 = std::max(x1, x + blur), y0 = std::min(y0, y - blur), y1 = std::max(y1, y + blur);
    }
    const auto pixel = [](double x, int most) { return int(std::clamp(x, 0., double(most))); };
    return {pixel(x0 - 2, frame.width), pixel(y0 - 2, frame.height), pixel(x1 + 2, frame.width), pixel(y1 + 2, frame.height)};
}

/// The rays of a photograph, a block at a time. They start in the plane that touches the scene's bounding sphere, or at the
/// camera if that plane lies behind it.
class PhotographRays {
  public:
    PhotographRays(const Display& display, const Geometry& geometry, const ContentScene& scene)
        : frame_(display.camera, geometry),
          render_(display.render),
          filtered_(display.camera.pixel_filter == PixelFilter::box),
          from_(minus(display.camera.position_mm, scene.centre_mm())) {
        const Vec3d& half = scene.impl().half_mm;
        const double radius = 1.0001 * std::sqrt(dot(half, half)) + 1e-3, depth = -dot(from_, frame_.axis);
        start_ = std::max(0., depth - radius);
        seen_ = pixels_of_box(frame_, [&](int n) {
            Vec3d corner = times(-1, from_);
            // The slack covers the rounding of positions.
            for (std::size_t k = 0; k < 3; ++k) corner[k] += (n >> k & 1 ? 1.0001 : -1.0001) * half[k];
            return Vec3d{dot(corner, frame_.right), dot(corner, frame_.up), dot(corner, frame_.axis)};
        });
    }

    int width() const { return frame_.width; }
    int height() const { return frame_.height; }
    /// Returns whether a pixel has one ray, through its centre.
    bool one_ray() const { return frame_.pupil_mm == 0 && !filtered_; }
    std::int64_t samples() const { return one_ray() ? 1 : render_.samples.value_or(default_points); }
    /// Returns the rays' width: that of the part of the pixel for which a ray stands, from the camera on.
    Beam beam() const { return {float(filtered_ ? frame_.slope / std::sqrt(double(samples())) : frame_.slope), float(-start_)}; }

    /// Sets the rays of the block at (column, row) for block.sample.
    void operator()(int column, int row, RayBlock& block) const {
        constexpr int side = RayBlock::side;
        const bool may_hit = column < seen_.x1 && column + side > seen_.x0 && row < seen_.y1 && row + side > seen_.y0;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            block.exists.of[k] = -1;
            block.may_hit.of[k] = -int(may_hit);
        }
        if (!may_hit) return;
        one_ray() ? through_centres(column, row, block) : spread(column, row, block);
    }

  private:
    /// Sets rays through pixels' centres: sums of a part for the column and one for the row.
    void through_centres(int column, int row, RayBlock& block) const {
        constexpr int side = RayBlock::side;
        const Vec3d dx = times(frame_.slope, frame_.right), dy = times(frame_.slope, frame_.up);
        RTCRay16& ray = block.packet.ray;
        float* const origin[3] = {ray.org_x, ray.org_y, ray.org_z};
        float* const direction[3] = {ray.dir_x, ray.dir_y, ray.dir_z};
        for (std::size_t c = 0; c < 3; ++c) {
            double of_column[side], of_row[side];
            for (int n = 0; n < side; ++n) {
                of_column[n] = frame_.axis[c] + (column + n + 0.5 - 0.5 * frame_.width) * dx[c];
                of_row[n] = (0.5 * frame_.height - row - n - 0.5) * dy[c];
            }
            for (int k = 0; k < RayBlock::lanes; ++k) {
                const double slope = of_column[k % side] + of_row[k / side];
                origin[c][k] = float(from_[c] + start_ * slope);
                direction[c][k] = float(slope);
            }
        }
    }

    /// Sets rays spread over pixel and pupil as in a rendering (optics/camera.h), with the same sample numbers: 2, 3 for the
    /// pixel, 4, 5 for the pupil.
    void spread(int column, int row, RayBlock& block) const {
        constexpr int side = RayBlock::side;
        if (block.sample == 0) {
            block.points.clear();
            for (int k = 0; k < RayBlock::lanes; ++k)
                block.points.emplace_back(
                    render_.sampling, optics::sampler_dimensions, std::uint64_t(render_.seed),
                    std::uint32_t(row + k / side) * std::uint32_t(frame_.width) + std::uint32_t(column + k % side));
        }
        static constexpr optics::DirectionNumbers directions = optics::sobol_directions();
        RTCRay16& ray = block.packet.ray;
        float* const origin[3] = {ray.org_x, ray.org_y, ray.org_z};
        float* const direction[3] = {ray.dir_x, ray.dir_y, ray.dir_z};
        for (int k = 0; k < RayBlock::lanes; ++k) {
            optics::Sampler<float>& point = block.points[std::size_t(k)];
            float pupil_x = 0, pupil_y = 0;
            if (frame_.pupil_mm > 0) optics::disk(point(4), point(5), pupil_x, pupil_y);
            const double jitter_x = filtered_ ? 0.5 * double(point(2)) : 0, jitter_y = filtered_ ? 0.5 * double(point(3)) : 0;
            const double x = (column + k % side + 0.5 - 0.5 * frame_.width + jitter_x) * frame_.slope;
            const double y = (0.5 * frame_.height - row - k / side - 0.5 + jitter_y) * frame_.slope;
            const double right = frame_.pupil_mm * double(pupil_x), up = frame_.pupil_mm * double(pupil_y);
            for (std::size_t c = 0; c < 3; ++c) {
                // A ray from the point o of the pupil meets the pixel's other rays at the depth of the focus: its slope is less
                // by o/focus.
                const double aside = frame_.right[c] * right + frame_.up[c] * up;
                const double slope = frame_.axis[c] + x * frame_.right[c] + y * frame_.up[c] - aside / frame_.focus_mm;
                origin[c][k] = float(from_[c] + aside + start_ * slope);
                direction[c][k] = float(slope);
            }
            point.next(directions);
        }
    }

    CameraFrame frame_;
    Render render_;
    bool filtered_;
    Vec3d from_;    // camera's position from the scene's centre
    double start_;  // depth of the plane in which rays start
    Rect seen_;     // pixels that may show the scene
};

}  // namespace

Picture reference_photograph(const Display& display, const Geometry& geometry, const ContentScene& scene, int threads,
                             std::optional<Rect> crop, Job& job) {
    const PhotographRays rays(display, geometry, scene);
    const RayRequest wanted{rays.width(), rays.height(), crop.value_or(Rect{0, 0, rays.width(), rays.height()}), rays.samples()};
    return cast(SceneLight{scene.impl(), rays.beam()}, wanted, threads, "photograph", job, rays);
}

}  // namespace lfdsim
