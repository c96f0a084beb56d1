#include "analysis/pictures/views.h"

#include "base/constants.h"
#include "base/input_error.h"
#include "engine/scene/traced_display.h"
#include "engine/views/screen.h"
#include "geometry/camera.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace lfdsim {
namespace {

/// Projects points in front of the display into the camera's frame, in pixels from its upper left corner.
class Projection {
  public:
    Projection(const Camera& c, const Geometry& g)
        : position_(c.position_mm),
          axes_(camera_axes(c)),
          width_(double(c.resolution[0])),
          height_(double(c.resolution[1])),
          per_slope_(width_ / g.frame_width_mm * axes_.distance_mm) {}
    /// Projects a point, mm in the display's frame. Returns whether it lies in front of the camera.
    bool operator()(const Vec3d& point, std::array<double, 2>& at) const {
        const Vec3d p = minus(point, position_);
        const double depth = dot(p, axes_.forward);
        if (!(depth > 0)) return false;
        at = {0.5 * width_ + dot(p, axes_.right) / depth * per_slope_, 0.5 * height_ - dot(p, axes_.up) / depth * per_slope_};
        return true;
    }

  private:
    Vec3d position_;
    CameraAxes axes_;
    double width_, height_, per_slope_;
};

}  // namespace

Display seen_by(const Display& display, const Vec3d& eye) {
    Display d = display;
    d.camera.position_mm = eye;
    d.camera.target_mm = {0, 0, 0};
    d.camera.up = {0, 1, 0};
    return d;
}

Display seen_from(const Display& display, double horizontal_deg, double vertical_deg) {
    const double distance = camera_distance_mm(display), h = horizontal_deg * degree, v = vertical_deg * degree;
    return seen_by(display, {distance * std::sin(h) * std::cos(v), distance * std::sin(v), distance * std::cos(h) * std::cos(v)});
}

Region seen_screen(const Display& d, const Geometry& g) {
    if (d.camera.position_mm[2] <= g.vertex_plane_mm) return {};  // it looks from behind
    return screen_region(d, g).value_or(Region{});
}

Region content_region(const Display& d, const Geometry& g, const ContentScene& scene) {
    const Vec3d centre = scene.centre_mm(), half = scene.half_size_mm();
    const Projection project(d.camera, g);
    const int width = int(d.camera.resolution[0]), height = int(d.camera.resolution[1]);
    // The bounding rectangle of the projected corners
    double x0 = width, y0 = height, x1 = 0, y1 = 0;
    for (unsigned n = 0; n < 8; ++n) {
        Vec3d corner = centre;
        for (unsigned k = 0; k < 3; ++k) corner[k] += (n >> k & 1 ? 1 : -1) * half[k];
        std::array<double, 2> at;
        if (!project(corner, at)) return {};
        x0 = std::min(x0, at[0]), x1 = std::max(x1, at[0]), y0 = std::min(y0, at[1]), y1 = std::max(y1, at[1]);
    }
    const auto pixel = [](double x, int most) { return int(std::clamp(x, 0., double(most))); };
    const Rect box{pixel(std::floor(x0), width), pixel(std::floor(y0), height), pixel(std::ceil(x1), width),
                   pixel(std::ceil(y1), height)};
    return Region::of(box).intersected(seen_screen(d, g));
}

void refuse_depth_in_lenses(const Geometry& g, double depth_mm, const std::string& where) {
    const double bottom = g.base_z_mm - g.vertex_plane_mm, top = g.top_z_mm - g.vertex_plane_mm;
    if (depth_mm < bottom || depth_mm >= top) return;  // content at the top of the lenses is in front of them
    throw InputError(where, fmt::format("{} puts the model's centre inside the lenses, which extend from {:.4g} to {:.4g} mm; give "
                                        "a depth in front of or behind them",
                                        depth_mm, bottom, top));
}

Rect screen_box(const Region& screen) {
    const Rect box = screen.bounds();
    if (box.x0 >= box.x1) throw InputError("camera", "no pixel of the camera sees the lens array; move it or widen its frame");
    return box;
}

float exposure(double white) { return float(1 / white); }

void expose(Image& image, double white) {
    const float gain = exposure(white);
    for (float& light : image.rgb) light *= gain;
}

ExpectedView expected_view(const Display& seen, const Geometry& geometry, const ContentScene& scene, int threads, const Job& job) {
    const Region screen = seen_screen(seen, geometry);
    const Rect box = screen_box(screen);
    Quiet quiet(job);
    Picture photograph = reference_photograph(seen, geometry, scene, threads, box, quiet);
    if (!photograph.complete) throw Stopped{};
    return {box,
            {std::move(photograph.image), screen.shifted(-box.x0, -box.y0),
             content_region(seen, geometry, scene).shifted(-box.x0, -box.y0)}};
}

Likeness likeness(const ExpectedView& view, const Display& seen, const Geometry& geometry, const SummedPanel& panel, double white,
                  RenderOptions how, const Job& job) {
    Quiet quiet(job);
    how.crop = view.box;
    const ComparedView compared = compare_view(seen, geometry, panel, view.expected, exposure(white), how, quiet);
    if (!compared.complete) throw Stopped{};
    return compared.likeness;
}

// With points, another rendering with as many samples has as large an error as the first, independent of it: the difference is
// sqrt(2) times either. With filtered light, four times the samples (3844 = 62 x 62 strata at most) have a much smaller error
// than the first.
Likeness likeness_error(const Likeness& first, const ExpectedView& view, const Display& seen, const Geometry& geometry,
                        const SummedPanel& panel, double white, const RenderOptions& how, const Job& job) {
    Display again = seen;
    const bool filtered = estimator_of(seen) == Estimator::filtered;
    if (filtered)
        again.render.samples = std::min<std::int64_t>(4 * samples_of(seen), 3844);
    else
        again.render.seed = seen.render.seed ^ 1;
    const Likeness other = likeness(view, again, geometry, panel, white, how, job);
    const double share = filtered ? 1 : std::sqrt(0.5);
    return {share * std::abs(other.screen - first.screen), share * std::abs(other.content - first.content),
            share * std::abs(other.share - first.share)};
}

}  // namespace lfdsim
