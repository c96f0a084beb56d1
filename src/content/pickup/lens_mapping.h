// Lines on which a real lens sends the light of the panel points under it: traced once for all lenses, kept as a table. Floor 2.
//
// Panel points are given by their position u from the lens's axis, in the array's frame, mm. Light is described by lines on the
// viewer's side, and these by their difference from the nodal line of the same panel point (content/pickup/pickup.h).
// docs/model.md, "Traced pick-up".
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <array>
#include <cstddef>
#include <vector>

namespace lfdsim {

/// A line less the nodal line, in the array's frame: position in the plane of green light's H', mm, and slope.
struct alignas(16) LineShift {
    float x, y, mx, my;
};

/// The table of a lens in light of one wavelength.
class LensMapping {
  public:
    /// A position in the pixel's emitting area (0, 1) and one in the aperture (2, 3), each number in [0, 1).
    using RayPlace = std::array<double, 4>;

    /// Traces the lens of a valid display, `green` its geometry, at a wavelength. rays > 0: also that many single rays of each
    /// point. 0 threads: one for each processor; the bits do not depend on their number. It takes about a tenth of a second.
    LensMapping(const Display&, const Geometry& green, double wavelength_nm, int rays, int threads);

    /// A position between the table's nodes along one axis: the first of the four nodes around it, and their weights.
    struct Between {
        int first;
        std::array<float, 4> weight;
    };
    /// Returns a position u, mm from the lens's axis, along x' (axis 0) or y' (1); beyond the table that of its end.
    Between between(std::size_t axis, double u) const;

    /// Gives the shift of the line on which most light of u travels (ray -1), equal parts of the aperture counted alike, or that
    /// of one of the single rays. Returns false if none of that light gets through.
    bool shift(int ray, const Between& ux, const Between& uy, LineShift& out) const {
        return (ray < 0 ? lines_ : rays_[std::size_t(ray)]).at(width_, ux, uy, out);
    }
    bool shift(int ray, double ux, double uy, LineShift& out) const { return shift(ray, between(0, ux), between(1, uy), out); }
    /// Returns the position of each single ray in the pixel and in the aperture. There may be fewer rays than requested if the
    /// aperture is small in its bounding box.
    const std::vector<RayPlace>& places() const { return places_; }

    /// Return the table's nodes along x' and y', which extend evenly from -reach to +reach.
    std::array<int, 2> nodes() const { return nodes_; }
    std::array<double, 2> reach_mm() const { return reach_; }
    /// Return a node's line, and its light relative to that of the point on the axis; 0 if none gets through (the line is then
    /// extrapolated).
    const LineShift& node(int i, int j) const { return lines_.shift[at(i, j)]; }
    double share(int i, int j) const { return double(lines_.light[at(i, j)]); }

  private:
    /// A shift for each node, row by row, with one more node on each side.
    struct MappingTable {
        std::vector<LineShift> shift;
        std::vector<float> light;  // share of each node; 0: none gets through
        bool all_lit = true;       // light gets through at all nodes
        bool at(int width, const Between&, const Between&, LineShift& out) const;
    };
    class Tracing;
    std::size_t at(int i, int j) const { return std::size_t((j + 1) * width_ + i + 1); }
    void complete(MappingTable&) const;

    std::array<int, 2> nodes_;
    int width_;                             // of a table's rows: nodes_[0] + 2
    std::array<double, 2> reach_, per_mm_;  // reach_: farthest u, mm; per_mm_: nodes per mm
    MappingTable lines_;
    std::vector<MappingTable> rays_;
    std::vector<RayPlace> places_;
};

/// Returns the mappings of red, green and blue light, or one for all if no glass disperses, with as many single rays as the
/// integrated pick-up takes.
std::vector<LensMapping> lens_mappings(const Display&, const Geometry&, int threads);

}  // namespace lfdsim
