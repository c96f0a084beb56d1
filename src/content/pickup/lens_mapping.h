// Where a real lens sends the light of the panel points under it: traced once for all lenses, kept as a table. Floor 2.
//
// Panel points are given by their place u from the lens's axis, in the array's frame, mm. Light is described by lines on the
// viewer's side, and these by how they differ from the nodal line of the same panel point (content/pickup/pickup.h). docs/model.md,
// "Traced pick-up".
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lfdsim {

/// A line less the nodal line, in the array's frame: at the rear principal point of green light, mm, and in slope.
struct alignas(16) LineShift {
    float x, y, mx, my;
};

class LensMapping {
  public:
    /// A place in the pixel and one in the aperture, each number in [0, 1).
    using RayPlace = std::array<double, 4>;

    /// Traces the lens of a valid display, resolved for green light, in light of this wavelength. rays > 0: so many rays of
    /// each point, too. threads 0: all; the same bits for any number. A tenth of a second.
    LensMapping(const Display&, const Geometry& green, double wavelength_nm, int rays, int threads);

    /// A place between the table's nodes along one axis: the first of four nodes, and how much each of them counts.
    struct Between {
        int first;
        std::array<float, 4> weight;
    };
    Between between(std::size_t axis, double u) const;

    /// The shift of the line on which most light of u travels (-1), every part of the lens's aperture counted alike, or that of
    /// one of the rays. False: none of that light gets through.
    bool shift(int ray, const Between& ux, const Between& uy, LineShift& out) const {
        return (ray < 0 ? lines_ : rays_[std::size_t(ray)]).at(width_, ux, uy, out);
    }
    bool shift(int ray, double ux, double uy, LineShift& out) const { return shift(ray, between(0, ux), between(1, uy), out); }
    /// Which part of a pixel that ray comes from (its last two numbers are spent). As many as were asked for.
    const std::vector<RayPlace>& places() const { return places_; }

    /// The table: nodes along x and y, each row from -reach to +reach.
    std::array<int, 2> nodes() const { return nodes_; }
    std::array<double, 2> reach_mm() const { return reach_; }
    /// The entry of a node: that line, and the share of the light of the point on the axis; 0 where none gets through (there
    /// the line is extrapolated).
    const LineShift& node(int i, int j) const { return lines_.shift[at(i, j)]; }
    double share(int i, int j) const { return double(lines_.light[at(i, j)]); }

  private:
    struct MappingTable {
        std::vector<LineShift> shift;
        std::vector<float> light;  // 0: none gets through
        bool all_lit = true;
        bool at(int width, const Between&, const Between&, LineShift& out) const;
    };
    class Tracing;
    std::size_t at(int i, int j) const { return std::size_t((j + 1) * width_ + i + 1); }
    void complete(MappingTable&) const;

    std::array<int, 2> nodes_;
    int width_;                             // of tables, which have one more node around the others
    std::array<double, 2> reach_, per_mm_;  // per_mm: nodes
    MappingTable lines_;
    std::vector<MappingTable> rays_;
    std::vector<RayPlace> places_;
};

/// The mappings of red, green and blue light, or one for all where no glass disperses; rays as content.pickup asks for.
std::vector<LensMapping> lens_mappings(const Display&, const Geometry&, int threads);

}  // namespace lfdsim
