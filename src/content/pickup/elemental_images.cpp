// Elemental images of scenes and of views: rays from panel pixels by the display's pick-up.

#include "content/pickup/lens_mapping.h"
#include "content/pickup/pickup.h"
#include "content/pickup/shown_points.h"
#include "content/pictures/cast.h"
#include "content/pictures/field_picture.h"

#include "base/constants.h"
#include "display/colour.h"
#include "geometry/lens_misalignment.h"

namespace lfdsim {
namespace {

/// Returns whether the colours of a pixel have different rays.
bool by_channel(const Display& d) { return made_by_channel(d) || (d.content.pickup != PickupKind::nodal && disperses(d)); }

/// The rays of the pick-up, a block at a time: of each pixel those of its red, then of green and blue if they differ. They must
/// hit the surface that the viewer sees first along the line: so they start in the plane z = top, just above the scene on the
/// viewer's side, and travel towards the panel and beyond it. Their direction has dz = -1, so that t is the depth below the
/// plane.
class PickupRays {
  public:
    /// Rays of content in the box with this centre and half extents, mm.
    PickupRays(const Display& display, const Geometry& geometry, const Vec3d& centre_mm, const Vec3d& half_mm,
               const std::vector<LensMapping>& mappings)
        : pickup_(display, geometry),
          apart_(geometry.turn_deg != 0 || is_staggered(display.array) || is_strips(display.array) || pickup_.irregular()),
          half_mm_(half_mm),
          centre_mm_(centre_mm),
          half_depth_(half_mm_[2] * 1.0001 + 1e-3),
          rise_(centre_mm_[2] + half_depth_ - pickup_.z_rear),
          rays_(rays_of(display)),
          width_per_t_(float(display.panel.pixel_pitch_mm / (geometry.gap_mm * std::sqrt(double(rays_))))) {
        for (int channel = 0; channel < (by_channel(display) ? 3 : 1); ++channel)
            for (int ray = 0; ray < rays_; ++ray) sets_.push_back(set_of(display, mappings, channel, ray));
    }

    /// Returns the number of rays for each pixel, or for each channel of it.
    static int rays_of(const Display& d) { return d.content.pickup == PickupKind::integrated ? int(d.content.pickup_rays) : 1; }

    /// Returns the rays' width: a panel pixel, projected through the lens, is a/g wide per mm from the lens; N rays of a pixel
    /// share it.
    Beam beam() const { return {width_per_t_, float(rise_)}; }

    /// Sets the rays of the block at (column, row) for block.sample.
    void operator()(int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            ray.org_z[k] = float(half_depth_);
            ray.dir_z[k] = -1;
        }
        const RaySet& set = sets_[std::size_t(block.sample)];
        set.common ? by_column_and_row(set, column, row, block) : each_alone(set, column, row, block);
        if (set.common && set.mapping) shift(set, column, row, block);
        if (set.everywhere) return;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            if (set.points.of(column + k % RayBlock::side, row + k / RayBlock::side)) continue;
            block.exists.of[k] = block.may_hit.of[k] = block.dark.of[k] = 0;
        }
    }

  private:
    struct RayCoordinate {  // a ray's x or y
        float origin, direction;
        bool may_hit;  // it may enter the scene's box, as seen along this axis
    };
    /// What all columns, or all rows, contribute to rays, where x depends on the column only and y on the row.
    struct Shares {
        std::vector<float> origin, direction;
        std::vector<int> exists, may_hit;  // -1 or 0
        std::vector<LensMapping::Between> in_table;
        void add(const RayCoordinate& part, bool owned) {
            origin.push_back(part.origin);
            direction.push_back(part.direction);
            exists.push_back(-int(owned));
            may_hit.push_back(-int(owned && part.may_hit));
        }
        void pad() {  // to whole blocks
            while (origin.size() % RayBlock::side != 0) add({0, 0, false}, false);
            in_table.resize(origin.size());
        }
    };

    /// What the rays of all pixels for one sample of the block have in common.
    struct RaySet {
        ShownPoints points;
        const LensMapping* mapping;  // null: nodal lines
        int ray;                     // number in the mapping; -1: the line on which most light travels
        bool common, everywhere;     // x depends on the column only and y on the row; all pixels have a point
        Shares columns, rows;        // if `common`
    };

    RaySet set_of(const Display& display, const std::vector<LensMapping>& mappings, int channel, int ray) const {
        const LensMapping* const mapping = mappings.empty() ? nullptr : &mappings[mappings.size() > 1 ? std::size_t(channel) : 0];
        const bool one_of_many = display.content.pickup == PickupKind::integrated && !mapping->places().empty();
        // If fewer rays than requested were found in a small aperture, they serve several times.
        const int of_mapping = one_of_many ? ray % int(mapping->places().size()) : -1;
        std::optional<ShownPoints::Point> place;
        if (one_of_many) place = {mapping->places()[std::size_t(of_mapping)][0], mapping->places()[std::size_t(of_mapping)][1]};
        const ShownPoints points(display.panel, made_by_channel(display), channel, place);
        const std::optional<ShownPoints::Point> shown = points.common();
        RaySet rays{points, mapping, of_mapping, !apart_ && shown, points.everywhere(), {}, {}};
        if (!rays.common) return rays;
        // Columns are computed for a row, and rows for a column, through the middle of the array, where a lens owns the panel.
        const double x = pickup_.lattice().offset[0] * pickup_.scale, y = pickup_.lattice().offset[1] * pickup_.scale;
        for (std::int64_t i = 0; i < display.panel.pixels[0]; ++i) {
            const NodalLine line = pickup_.line(pickup_.x_mm(double(i) + (*shown)[0]), y);
            rays.columns.add(part(line.x, line.mx, 0), line.owned);
            if (mapping) rays.columns.in_table.push_back(mapping->between(0, pickup_.x_mm(double(i) + (*shown)[0]) - line.x));
        }
        for (std::int64_t j = 0; j < display.panel.pixels[1]; ++j) {
            const NodalLine line = pickup_.line(x, pickup_.y_mm(double(j) + (*shown)[1]));
            rays.rows.add(part(line.y, line.my, 1), line.owned);
            if (mapping) rays.rows.in_table.push_back(mapping->between(1, pickup_.y_mm(double(j) + (*shown)[1]) - line.y));
        }
        rays.columns.pad();
        rays.rows.pad();
        return rays;
    }

    /// Returns half the scene's box along an axis. The slack covers the rounding of positions (about 1e-7 of the box) and of the
    /// rays' arithmetic.
    float reach(std::size_t k) const { return float(half_mm_[k] * 1.0001 + 1e-6); }

    /// Returns a ray's coordinate: the line is at axis + slope rise in the first plane, and ends 2 half_depth further down.
    RayCoordinate part(double axis, double slope, std::size_t k) const {
        const float origin = float(axis + slope * rise_ - centre_mm_[k]), direction = float(-slope),
                    end = origin + float(2 * half_depth_) * direction;
        const float h = reach(k);
        return {origin, direction, std::min(origin, end) <= h && std::max(origin, end) >= -h};
    }

    /// Sets a block's rays from the shares of its columns and rows, in a loop without branches.
    static void by_column_and_row(const RaySet& of, int column, int row, RayBlock& block) {
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

    /// Shifts a block's nodal lines by the mapping's table, and tests anew which may hit.
    void shift(const RaySet& of, int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        const float rise = float(rise_), depth = float(2 * half_depth_), half_x = reach(0), half_y = reach(1);
        const auto enters = [](float from, float to, float half) {
            return std::min(from, to) <= half && std::max(from, to) >= -half;
        };
        for (int k = 0; k < RayBlock::lanes; ++k) {
            LineShift line;
            const bool lit = of.mapping->shift(of.ray, of.columns.in_table[std::size_t(column + k % RayBlock::side)],
                                               of.rows.in_table[std::size_t(row + k / RayBlock::side)], line);
            ray.org_x[k] += line.x + line.mx * rise;
            ray.org_y[k] += line.y + line.my * rise;
            ray.dir_x[k] -= line.mx;
            ray.dir_y[k] -= line.my;
            block.dark.of[k] = block.exists.of[k] & -int(!lit);
            block.exists.of[k] &= -int(lit);
        }
        for (int k = 0; k < RayBlock::lanes; ++k)
            block.may_hit.of[k] = block.exists.of[k] & -(int(enters(ray.org_x[k], ray.org_x[k] + depth * ray.dir_x[k], half_x)) &
                                                         int(enters(ray.org_y[k], ray.org_y[k] + depth * ray.dir_y[k], half_y)));
    }

    /// Returns the line of a panel point, shifted by the mapping if there is one.
    NodalLine line(const RaySet& set, double x, double y) const {
        if (!set.mapping) return pickup_.line(x, y);
        return pickup_.line(x, y, [&](double ux, double uy, Pickup::Shift& out) {
            LineShift shift;
            const bool lit = set.mapping->shift(set.ray, ux, uy, shift);
            out = {double(shift.x), double(shift.y), double(shift.mx), double(shift.my)};
            return lit;
        });
    }

    /// Sets a block's rays one by one, for arrays whose columns and rows have nothing in common.
    void each_alone(const RaySet& set, int column, int row, RayBlock& block) const {
        RTCRay16& ray = block.packet.ray;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            const int i = column + k % RayBlock::side, j = row + k / RayBlock::side;
            const ShownPoints::Point shown = set.points.of(i, j).value_or(ShownPoints::Point{});
            const NodalLine l = line(set, pickup_.x_mm(i + shown[0]), pickup_.y_mm(j + shown[1]));
            const RayCoordinate x = part(l.x, l.mx, 0), y = part(l.y, l.my, 1);
            ray.org_x[k] = x.origin;
            ray.org_y[k] = y.origin;
            ray.dir_x[k] = x.direction;
            ray.dir_y[k] = y.direction;
            block.dark.of[k] = -(int(l.owned) & int(l.dark));
            block.exists.of[k] = -(int(l.owned) & int(!l.dark));
            block.may_hit.of[k] = block.exists.of[k] & -(int(x.may_hit) & int(y.may_hit));
        }
    }

    Pickup pickup_;
    bool apart_;                 // pixels of a row or column have nothing in common
    Vec3d half_mm_, centre_mm_;  // of the scene's box
    double half_depth_, rise_;   // half_depth_: of the scene's box; rise_: height of the rays' first plane over H'
    int rays_;
    float width_per_t_;
    std::vector<RaySet> sets_;  // for each sample of a block
};

/// The light of views along a block's rays. Heights z over the focus: rays start at org_z, and are narrowest at org_z -
/// beam.waist_t.
struct FieldLight {
    const LightField& field;
    Beam beam;
    std::atomic<std::int64_t>& beside_cameras;
    std::atomic<std::int64_t>& beside_focus;

    bool operator()(RayBlock& block) const {
        if (!block.exists.any()) return false;
        const RTCRay16& ray = block.packet.ray;
        const auto distance = float(field.grid().distance_mm);
        int cameras = 0, focus = 0;
        for (int k = 0; k < RayBlock::lanes; ++k) {
            block.hit.of[k] = 0;
            if (!block.exists.of[k]) continue;
            // The line meets the focus where z = 0, and the cameras' plane at the height `distance`.
            const float top = ray.org_z[k], x = ray.org_x[k] + top * ray.dir_x[k], y = ray.org_y[k] + top * ray.dir_y[k];
            const LightField::FieldLine line{x, y, x - distance * ray.dir_x[k], y - distance * ray.dir_y[k]};
            float light[3];
            const LightField::Answer answer = field.light(line, {beam.width_per_t, top - beam.waist_t}, light);
            cameras += answer == LightField::Answer::beside_cameras;
            focus += answer == LightField::Answer::beside_focus;
            block.hit.of[k] = -int(answer == LightField::Answer::seen);
            for (int c = 0; c < 3; ++c) block.light[c].of[k] = light[c];
        }
        if (cameras > 0) beside_cameras += cameras;
        if (focus > 0) beside_focus += focus;
        return true;
    }
};

std::vector<LensMapping> mappings_for(const Display& display, const Geometry& geometry, int threads) {
    return display.content.pickup == PickupKind::nodal ? std::vector<LensMapping>() : lens_mappings(display, geometry, threads);
}

RayRequest whole_panel(const Display& display) {
    const int width = int(display.panel.pixels[0]), height = int(display.panel.pixels[1]);
    return {width, height, {0, 0, width, height}, PickupRays::rays_of(display), by_channel(display)};
}

}  // namespace

Picture elemental_images(const Display& display, const Geometry& geometry, const ContentScene& scene, int threads, Job& job) {
    if (display.content.pickup == PickupKind::inverse) throw std::logic_error("the inverse pick-up is that of inverse/inverse.h");
    // Content for the display as described is that of the display without its errors.
    if (knows_no_errors(display)) {
        const Display meant = without_errors(display);
        return elemental_images(meant, resolve(meant), scene, threads, job);
    }
    const std::vector<LensMapping> mappings = mappings_for(display, geometry, threads);
    const PickupRays rays(display, geometry, scene.centre_mm(), scene.impl().half_mm, mappings);
    return cast(SceneLight{scene.impl(), rays.beam()}, whole_panel(display), threads, "elemental images", job, rays);
}

FieldPicture elemental_images(const Display& display, const Geometry& geometry, const LightField& field, int threads, Job& job) {
    if (knows_no_errors(display)) {
        const Display meant = without_errors(display);
        return elemental_images(meant, resolve(meant), field, threads, job);
    }
    const std::vector<LensMapping> mappings = mappings_for(display, geometry, threads);
    const PickupRays rays(display, geometry, {0, 0, geometry.vertex_plane_mm + field.grid().depth_mm}, {infinity, infinity, 0},
                          mappings);
    std::atomic<std::int64_t> beside_cameras{0}, beside_focus{0};
    const FieldLight light{field, rays.beam(), beside_cameras, beside_focus};
    Picture picture = cast(light, whole_panel(display), threads, "elemental images", job, rays);
    return {std::move(picture), beside_cameras, beside_focus};
}

}  // namespace lfdsim
