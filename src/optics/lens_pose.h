// The pose of a misaligned lens, and its surfaces, which may be more or less curved than those of others. Floor 1.
//
// The frames of the array and of the lens are those of misaligned.h.
#pragma once
#include "optics/lens.h"
#include "optics/lens_array.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The poses of the lenses that a packet's rays meet, relative to their lattice positions (array frame).
template <class F>
struct LensPose {
    // x', y', z of the viewer-side vertex, mm; the factor 1 + e of the curvatures; cosine and sine of tilt_x and of tilt_y
    F x, y, z, curvature, cos_x, sin_x, cos_y, sin_y;

    /// Transforms a vector of the array's frame to the lens's frame: the transpose of Ry(tilt_y) Rx(tilt_x).
    LFDSIM_FN Vec3<F> turned_in(Vec3<F> v) const {
        const F x1 = v.x * cos_y - v.z * sin_y, z1 = v.x * sin_y + v.z * cos_y;
        return {x1, v.y * cos_x + z1 * sin_x, z1 * cos_x - v.y * sin_x};
    }
    /// Transforms a vector of the lens's frame to the array's: Ry(tilt_y) Rx(tilt_x) v (docs/model.md, "Errors").
    LFDSIM_FN Vec3<F> turned_out(Vec3<F> v) const {
        const F y1 = v.y * cos_x - v.z * sin_x, z1 = v.y * sin_x + v.z * cos_x;
        return {v.x * cos_y + z1 * sin_y, y1, z1 * cos_y - v.x * sin_y};
    }
};

/// Returns the poses of the lenses in these cells; where `there` is false, that of the array's first lens.
template <class F>
LFDSIM_FN LensPose<F> pose_of(const TracedDisplay<Scalar<F>>& display, const Extent<Scalar<F>>& extent, Cell<F> cell,
                              Mask<F> there) {
    using S = Scalar<F>;
    constexpr int N = LaneTraits<F>::width;
    const MisalignedArray<S>& misaligned = display.misaligned;
    const F zero = F(0), one = F(1);
    if (!misaligned.lens) return {zero, zero, zero, one, one, zero, one, zero};
    // Lenses are stored row by row from the lower left one, which is cell (low_i, low_j).
    const F number = (cell.j - F(extent.low_j)) * F(display.lattice.count[0]) + (cell.i - F(extent.low_i));
    std::uint32_t row[N];  // a lens is two rows of four numbers
    store(to_int(select(there, number, zero)) << 1, row);
    F place[4], turn[4];
    load_rows(misaligned.lens->place, row, place);
    if (!misaligned.tilted) return {place[0], place[1], place[2], place[3], one, zero, one, zero};
    load_rows(misaligned.lens->turn, row, turn);
    return {place[0], place[1], place[2], place[3], turn[0], turn[1], turn[2], turn[3]};
}

/// A surface whose curvature differs from lens to lens, in the form that meet() and sag() take: a SurfaceData with its curvature
/// multiplied by 1 + e. Vertices, conic constant and aspheric terms stay (docs/model.md, "Errors").
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
        c_rim = cr2 / (F(1) + sqrt(max(F(1) - cr2, F(0))));  // c sag(r) of a sphere, which alone needs it
    }
};

/// Returns where a ray meets surface k of lenses whose curvature is multiplied by `factor`, as meet() does.
template <Facts facts, class F>
LFDSIM_FN Hit<F> meet_curved(const TracedDisplay<Scalar<F>>& display, int k, const Ray<F>& in_vertex_plane, F factor) {
    const Shape shape = shape_of<facts>(display, k);
    if (!display.misaligned.curved || shape == Shape::plane) return meet<facts>(display, k, in_vertex_plane);
    const CurvedSurface<F> surface(display.surface[k], factor);
    return holds<facts.strips>(display.lattice.strips) ? meet_cylinder(shape, surface, in_vertex_plane)
                                                       : meet(shape, surface, in_vertex_plane);
}

/// Returns z of the highest rim of a lens's surfaces, or of the lowest, mm from the panel; `factor` multiplies its curvatures.
template <class F>
LFDSIM_FN F outmost_rim(const TracedDisplay<Scalar<F>>& display, bool highest, F factor) {
    if (!display.misaligned.curved) return F(highest ? display.zone_top : display.wall_bottom);
    F rim = F(Scalar<F>(highest ? -1e30 : 1e30)), z, d;
    Mask<F> sheet;
    for (int k = 0; k < display.surface_count; ++k) {
        const auto& surface = display.surface[k];
        sag(CurvedSurface<F>(surface, factor), F(surface.semi_aperture) * F(surface.semi_aperture), z, d, sheet);
        z = z + F(surface.z);
        rim = highest ? max(rim, z) : min(rim, z);
    }
    return rim;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
