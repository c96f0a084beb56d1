// How a lens of an array with errors stands, and its surfaces, which may be more or less curved than those of others. Floor 1.
//
// The array's frame and the lens's own are those of misaligned.h.
#pragma once
#include "optics/lens.h"
#include "optics/lens_array.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// How the lenses of a packet's rays stand.
template <class F>
struct Stand {
    F x, y, z, curvature, cos_x, sin_x, cos_y, sin_y;

    /// A vector of the array's frame in the lens's, and back.
    LFDSIM_FN Vec3<F> turned_in(Vec3<F> v) const {
        const F x1 = v.x * cos_y - v.z * sin_y, z1 = v.x * sin_y + v.z * cos_y;
        return {x1, v.y * cos_x + z1 * sin_x, z1 * cos_x - v.y * sin_x};
    }
    LFDSIM_FN Vec3<F> turned_out(Vec3<F> v) const {
        const F y1 = v.y * cos_x - v.z * sin_x, z1 = v.y * sin_x + v.z * cos_x;
        return {v.x * cos_y + z1 * sin_y, y1, z1 * cos_y - v.x * sin_y};
    }
};

/// Those of lenses in these cells; where `there` is false, of any.
template <class F>
LFDSIM_FN Stand<F> stand_of(const Scene<Scalar<F>>& scene, const Extent<Scalar<F>>& extent, Cell<F> cell, Mask<F> there) {
    using S = Scalar<F>;
    constexpr int N = LaneTraits<F>::width;
    const Placement<S>& placement = scene.placement;
    const F zero = F(0), one = F(1);
    if (!placement.lens) return {zero, zero, zero, one, one, zero, one, zero};
    const F number = (cell.j - F(extent.low_j)) * F(scene.lattice.count[0]) + (cell.i - F(extent.low_i));
    std::uint32_t row[N];  // a lens is two rows of four numbers
    store(to_int(select(there, number, zero)) << 1, row);
    F place[4], turn[4];
    load_rows(placement.lens->place, row, place);
    if (!placement.tilted) return {place[0], place[1], place[2], place[3], one, zero, one, zero};
    load_rows(placement.lens->turn, row, turn);
    return {place[0], place[1], place[2], place[3], turn[0], turn[1], turn[2], turn[3]};
}

/// A surface whose curvature differs from lens to lens, as meet() and sag() take it.
template <class F>
struct CurvedSurface {
    Shape shape;
    std::int32_t terms;
    F curvature;
    Scalar<F> conic;
    const Scalar<F>* asphere;
    Scalar<F> semi_aperture, low, high;
    F c_rim;

    LFDSIM_FN CurvedSurface(const SurfaceData<Scalar<F>>& from, F factor)
        : shape(from.shape),
          terms(from.terms),
          curvature(F(from.curvature) * factor),
          conic(from.conic),
          asphere(from.asphere),
          semi_aperture(from.semi_aperture),
          low(from.low),
          high(from.high) {
        const F cr = curvature * F(from.semi_aperture), cr2 = cr * cr;
        c_rim = cr2 / (F(1) + sqrt(max(F(1) - cr2, F(0))));  // of a sphere, which alone asks for it
    }
};

/// Where a ray meets surface k of lenses that stand like this.
template <Facts facts, class F>
LFDSIM_FN Hit<F> meet_curved(const Scene<Scalar<F>>& scene, int k, const Ray<F>& in_vertex_plane, F factor) {
    const Shape shape = shape_of<facts>(scene, k);
    if (!scene.placement.curved || shape == Shape::plane) return meet<facts>(scene, k, in_vertex_plane);
    const CurvedSurface<F> surface(scene.surface[k], factor);
    return holds<facts.strips>(scene.lattice.strips) ? meet_cylinder(shape, surface, in_vertex_plane)
                                                     : meet(shape, surface, in_vertex_plane);
}

/// z of the highest rim of a lens's surfaces, or of the lowest.
template <class F>
LFDSIM_FN F outmost_rim(const Scene<Scalar<F>>& scene, bool highest, F factor) {
    if (!scene.placement.curved) return F(highest ? scene.zone_top : scene.wall_bottom);
    F rim = F(Scalar<F>(highest ? -1e30 : 1e30)), z, d;
    Mask<F> sheet;
    for (int k = 0; k < scene.surface_count; ++k) {
        const auto& surface = scene.surface[k];
        sag(CurvedSurface<F>(surface, factor), F(surface.semi_aperture) * F(surface.semi_aperture), z, d, sheet);
        z = z + F(surface.z);
        rim = highest ? max(rim, z) : min(rim, z);
    }
    return rim;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
