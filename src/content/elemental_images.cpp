#include "content/cast.h"
#include "content/pickup.h"
#include "content/shown_points.h"

namespace lfdsim {
namespace {

/// The rays of the nodal pick-up, a block at a time. They must hit the surface that the viewer sees first along the line: they
/// start in the plane z = top, just above the scene on the viewer's side, and travel towards the panel and beyond it. Their
/// direction has dz = -1, so that t is the depth below the plane.
class PickupRays {
  public:
    PickupRays(const Display& display, const Geometry& geometry, const ContentScene& scene)
        : pickup_(display, geometry),
          apart_(display.array.turn_deg() != 0 || is_staggered(display.array) || is_strips(display.array)),
          half_mm_(scene.impl().half_mm),
          centre_mm_(scene.centre_mm()),
          half_depth_(half_mm_[2] * 1.0001 + 1e-3),
          rise_(centre_mm_[2] + half_depth_ - pickup_.z_rear),
          width_per_t_(float(display.panel.pixel_pitch_mm / geometry.gap_mm)) {
        for (const ShownPoints& points : shown_points(display)) channels_.push_back(channel_of(display, points));
    }

    Beam beam() const { return {width_per_t_, float(rise_)}; }

    void operator()(int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            ray.org_z[k] = float(half_depth_);
            ray.dir_z[k] = -1;
        }
        const ChannelRays& channel = channels_[channels_.size() > 1 ? std::size_t(block.sample) : 0];
        channel.common ? by_column_and_row(channel, column, row, block) : each_alone(channel.points, column, row, block);
        if (channel.everywhere) return;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            if (channel.points.of(column + k % RayBlock::side, row + k / RayBlock::side)) continue;
            block.exists.of[k] = block.may_hit.of[k] = 0;
        }
    }

  private:
    struct Part {  // a ray's x or its y
        float origin, direction;
        bool may_hit;  // it may enter the scene's box before its end, behind the scene
    };
    /// What all columns, or all rows, contribute to rays.
    struct Shares {
        std::vector<float> origin, direction;
        std::vector<int> exists, may_hit;  // -1 or 0
        void add(const Part& part, bool owned) {
            origin.push_back(part.origin);
            direction.push_back(part.direction);
            exists.push_back(-int(owned));
            may_hit.push_back(-int(owned && part.may_hit));
        }
        void pad() {  // to whole blocks
            while (origin.size() % RayBlock::side != 0) add({0, 0, false}, false);
        }
    };

    struct ChannelRays {
        ShownPoints points;
        bool common, everywhere;  // x depends on the column alone and y on the row; all pixels have a point
        Shares columns, rows;     // where they do
    };

    ChannelRays channel_of(const Display& display, const ShownPoints& points) const {
        const std::optional<ShownPoints::Point> shown = points.common();
        ChannelRays rays{points, !apart_ && shown, points.everywhere(), {}, {}};
        if (!rays.common) return rays;
        // (x, y): the middle of the array, where a lens owns the panel.
        const double x = display.array.offset_mm[0] * pickup_.scale, y = display.array.offset_mm[1] * pickup_.scale;
        for (std::int64_t i = 0; i < display.panel.pixels[0]; ++i) {
            const NodalLine line = pickup_.line(pickup_.x_mm(double(i) + (*shown)[0]), y);
            rays.columns.add(part(line.x, line.mx, 0), line.owned);
        }
        for (std::int64_t j = 0; j < display.panel.pixels[1]; ++j) {
            const NodalLine line = pickup_.line(x, pickup_.y_mm(double(j) + (*shown)[1]));
            rays.rows.add(part(line.y, line.my, 1), line.owned);
        }
        rays.columns.pad();
        rays.rows.pad();
        return rays;
    }

    Part part(double axis, double slope, std::size_t k) const {
        const float origin = float(axis + slope * rise_ - centre_mm_[k]), direction = float(-slope),
                    end = origin + float(2 * half_depth_) * direction;
        // The slack covers the rounding of positions (about 1e-7 of the box) and of the arithmetic here.
        const float h = float(half_mm_[k] * 1.0001 + 1e-6);
        return {origin, direction, std::min(origin, end) <= h && std::max(origin, end) >= -h};
    }

    /// Where the array is not turned against the panel, x depends on the column alone and y on the row.
    static void by_column_and_row(const ChannelRays& of, int column, int row, RayBlock& block) {
        constexpr int side = RayBlock::side;
        RTCRay16& ray = block.packet.ray;
        for (int j = 0; j < side; ++j) {
            const auto r = std::size_t(row + j);
            const float origin = of.rows.origin[r], direction = of.rows.direction[r];
            const int exists = of.rows.exists[r], may_hit = of.rows.may_hit[r];
            for (int i = 0; i < side; ++i) {
                const auto c = std::size_t(column + i);
                const int k = j * side + i;
                ray.org_x[k] = of.columns.origin[c];
                ray.org_y[k] = origin;
                ray.dir_x[k] = of.columns.direction[c];
                ray.dir_y[k] = direction;
                block.exists.of[k] = of.columns.exists[c] & exists;
                block.may_hit.of[k] = of.columns.may_hit[c] & may_hit;
            }
        }
    }

    void each_alone(const ShownPoints& points, int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            const int i = column + k % RayBlock::side, j = row + k / RayBlock::side;
            const ShownPoints::Point shown = points.of(i, j).value_or(ShownPoints::Point{});
            const NodalLine line = pickup_.line(pickup_.x_mm(i + shown[0]), pickup_.y_mm(j + shown[1]));
            const Part x = part(line.x, line.mx, 0), y = part(line.y, line.my, 1);
            ray.org_x[k] = x.origin;
            ray.org_y[k] = y.origin;
            ray.dir_x[k] = x.direction;
            ray.dir_y[k] = y.direction;
            block.exists.of[k] = -int(line.owned);
            block.may_hit.of[k] = -(int(line.owned) & int(x.may_hit) & int(y.may_hit));
        }
    }

    Pickup pickup_;
    bool apart_;                 // no row or column has anything in common
    Vec3d half_mm_, centre_mm_;  // of the scene's box
    double half_depth_, rise_;   // rise: of the rays' first plane over the rear nodal points
    float width_per_t_;
    std::vector<ChannelRays> channels_;
};

}  // namespace

Picture elemental_images(const Display& display, const Geometry& geometry, const ContentScene& scene, int threads, Job& job) {
    const PickupRays rays(display, geometry, scene);
    const int width = int(display.panel.pixels[0]), height = int(display.panel.pixels[1]);
    const Wanted panel{width, height, {0, 0, width, height}, 1, made_by_channel(display)};
    return cast(scene.impl(), rays.beam(), panel, threads, "elemental images", job, rays);
}

}  // namespace lfdsim
