#include "content/cast.h"
#include "content/pickup.h"

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
        if (apart_) return;
        // (x, y): the middle of the array, where a lens owns the panel.
        const double x = display.array.offset_mm[0] * pickup_.scale, y = display.array.offset_mm[1] * pickup_.scale;
        for (std::int64_t i = 0; i < display.panel.pixels[0]; ++i) {
            const NodalLine line = pickup_.line(pickup_.x_mm(double(i)), y);
            columns_.add(part(line.x, line.mx, 0), line.owned);
        }
        for (std::int64_t j = 0; j < display.panel.pixels[1]; ++j) {
            const NodalLine line = pickup_.line(x, pickup_.y_mm(double(j)));
            rows_.add(part(line.y, line.my, 1), line.owned);
        }
        columns_.pad();
        rows_.pad();
    }

    Beam beam() const { return {width_per_t_, float(rise_)}; }

    void operator()(int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            ray.org_z[k] = float(half_depth_);
            ray.dir_z[k] = -1;
        }
        apart_ ? each_alone(column, row, block) : by_column_and_row(column, row, block);
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

    Part part(double axis, double slope, std::size_t k) const {
        const float origin = float(axis + slope * rise_ - centre_mm_[k]), direction = float(-slope),
                    end = origin + float(2 * half_depth_) * direction;
        // The slack covers the rounding of positions (about 1e-7 of the box) and of the arithmetic here.
        const float h = float(half_mm_[k] * 1.0001 + 1e-6);
        return {origin, direction, std::min(origin, end) <= h && std::max(origin, end) >= -h};
    }

    /// Where the array is not turned against the panel, x depends on the column alone and y on the row.
    void by_column_and_row(int column, int row, RayBlock& block) const {
        constexpr int side = RayBlock::side;
        RTCRay16& ray = block.packet.ray;
        for (int j = 0; j < side; ++j) {
            const auto r = std::size_t(row + j);
            const float origin = rows_.origin[r], direction = rows_.direction[r];
            const int exists = rows_.exists[r], may_hit = rows_.may_hit[r];
            for (int i = 0; i < side; ++i) {
                const auto c = std::size_t(column + i);
                const int k = j * side + i;
                ray.org_x[k] = columns_.origin[c];
                ray.org_y[k] = origin;
                ray.dir_x[k] = columns_.direction[c];
                ray.dir_y[k] = direction;
                block.exists.of[k] = columns_.exists[c] & exists;
                block.may_hit.of[k] = columns_.may_hit[c] & may_hit;
            }
        }
    }

    void each_alone(int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            const NodalLine line = pickup_.line(pickup_.x_mm(column + k % RayBlock::side), pickup_.y_mm(row + k / RayBlock::side));
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
    Shares columns_, rows_;
};

}  // namespace

Picture elemental_images(const Display& display, const Geometry& geometry, const ContentScene& scene, int threads, Job& job) {
    const PickupRays rays(display, geometry, scene);
    const int width = int(display.panel.pixels[0]), height = int(display.panel.pixels[1]);
    return cast(scene.impl(), rays.beam(), {width, height, {0, 0, width, height}}, threads, "elemental images", job, rays);
}

}  // namespace lfdsim
