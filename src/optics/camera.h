// The camera: for each pixel the ray through its centre, and how a sample departs from it. Floor 1.
//
// The ray through the pixel's centre is followed in double precision to the first plane of the display (the diffuser, or the top of
// the lens array); the tracer starts there, from the axis of the lens nearest to that point, so that float is enough.
#pragma once
#include "optics/elementary.h"
#include "optics/lens_array.h"
#include "optics/panel.h"
#include "optics/sampler.h"
#include "optics/scene.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The rays through the centres of a packet of pixels, where they cross the first plane.
template <class F>
struct PixelRays {
    F x, y;         // from the axis of the base lens, in the array's frame
    Vec3<F> to;     // unit, in the display's frame
    F per_length;   // 1 / length of (to scaled to the frame)
    Mask<F> alive;  // looks towards the display
    Extent<F> extent;
    PanelBase<F> base;
};

/// A packet's pixels form a block of the frame, so that its rays see near panel pixels.
template <class F>
struct Block {
    static constexpr int lanes = LaneTraits<F>::width;
    static constexpr int width = lanes >= 16 ? 8 : lanes >= 8 ? 4 : lanes;
    static constexpr int height = lanes / width;
};

/// The rays of the block whose first pixel is (column, row). Written as a loop over lanes that the compiler makes SIMD code of.
template <class F>
LFDSIM_FN PixelRays<F> pixel_rays(const View& view, std::int32_t column, std::int32_t row) {
    using S = Scalar<F>;
    constexpr int N = LaneTraits<F>::width;
    S x[N], y[N], dx[N], dy[N], dz[N], per_length[N], low_i[N], high_i[N], low_j[N], high_j[N], column_rest[N], row_rest[N];
    std::uint32_t base_column[N], base_row[N];
    const double* const o = view.position;
    const double c = view.cos_rotation, s = view.sin_rotation;
    for (int k = 0; k < N; ++k) {
        const double sx = (column + k % Block<F>::width + 0.5 - 0.5 * view.width) * view.pixel_mm;
        const double sy = (0.5 * view.height - (row + k / Block<F>::width + 0.5)) * view.pixel_mm;
        double d[3];
        for (int a = 0; a < 3; ++a) d[a] = view.forward[a] * view.distance + view.right[a] * sx + view.up[a] * sy;
        const double inverse = 1 / __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        // A ray that looks away has no such point; any finite one will do for it.
        const double down = d[2] < -1e-9 * view.distance ? d[2] : -view.distance;
        const double t = (view.start_z - o[2]) / down;
        const double px = o[0] + d[0] * t - view.offset[0], py = o[1] + d[1] * t - view.offset[1];
        const double ax = c * px + s * py, ay = c * py - s * px;  // into the array's frame
        double i = __builtin_floor(ax / view.pitch + 0.5 * view.count[0]),
               j = __builtin_floor(ay / view.pitch + 0.5 * view.count[1]);
        i = i < 0 ? 0 : i > view.count[0] - 1 ? view.count[0] - 1 : i;
        j = j < 0 ? 0 : j > view.count[1] - 1 ? view.count[1] - 1 : j;
        const double cx = (i + 0.5 - 0.5 * view.count[0]) * view.pitch, cy = (j + 0.5 - 0.5 * view.count[1]) * view.pitch;
        const double u = (c * cx - s * cy + view.offset[0] + 0.5 * view.panel_width) * view.pixels_per_mm;
        const double v = (0.5 * view.panel_height - (s * cx + c * cy + view.offset[1])) * view.pixels_per_mm;
        const double whole_u = __builtin_floor(u), whole_v = __builtin_floor(v);
        x[k] = S(ax - cx);
        y[k] = S(ay - cy);
        dx[k] = S(d[0] * inverse);
        dy[k] = S(d[1] * inverse);
        dz[k] = S(d[2] * inverse);
        per_length[k] = S(inverse);
        low_i[k] = S(-i);
        high_i[k] = S(view.count[0] - 1 - i);
        low_j[k] = S(-j);
        high_j[k] = S(view.count[1] - 1 - j);
        column_rest[k] = S(u - whole_u);
        row_rest[k] = S(v - whole_v);
        base_column[k] = std::uint32_t(std::int32_t(whole_u));
        base_row[k] = std::uint32_t(std::int32_t(whole_v));
    }
    const F z = load<F>(dz);
    return {load<F>(x),
            load<F>(y),
            {load<F>(dx), load<F>(dy), z},
            load<F>(per_length),
            z < F(S(-1e-9)),
            {load<F>(low_i), load<F>(high_i), load<F>(low_j), load<F>(high_j)},
            {load<F>(base_column), load<F>(base_row), load<F>(column_rest), load<F>(row_rest)}};
}

/// A point of the unit disk for two numbers in [-1, 1], area preserved (Shirley and Chiu 1997).
template <class F>
LFDSIM_FN void disk(F a, F b, F& x, F& y) {
    using S = Scalar<F>;
    const Mask<F> wide = abs(a) > abs(b);
    const F r = select(wide, a, b), other = select(wide, b, a);
    F sine, cosine;
    sincos(F(S(0.78539816339744831)) * (other / select(r == F(0), F(1), r)), false, sine, cosine);
    x = r * select(wide, cosine, sine);
    y = r * select(wide, sine, cosine);
}

/// Moves a sample from the pixel's centre to `jitter` (half pixels, right and up) and the pinhole to `lens` (half pupils): the
/// rays' place in the first plane and their direction then. With the unit direction d through the centre, m = d_xy / d_z and H the
/// height of the plane above the camera, the change of direction e moves the ray by H (e_xy - m e_z) / (d_z + e_z): no large
/// numbers cancel.
template <class F>
LFDSIM_RARE Ray<F> displaced(const View& view, const PixelRays<F>& pixels, F jitter_x, F jitter_y, F lens_x, F lens_y) {
    using S = Scalar<F>;
    const F h = F(S(view.start_z - view.position[2])), half = F(S(0.5 * view.pixel_mm)), pupil = F(S(view.pupil_radius));
    auto along = [&](F right, F up, int axis) { return right * F(S(view.right[axis])) + up * F(S(view.up[axis])); };
    const F ox = pupil * lens_x, oy = pupil * lens_y;
    const F back = F(S(view.frame_per_focus));
    const F ex = jitter_x * half - ox * back, ey = jitter_y * half - oy * back;
    const F k = pixels.per_length;
    const Vec3<F> to = pixels.to;
    const Vec3<F> e{along(ex, ey, 0) * k, along(ex, ey, 1) * k, along(ex, ey, 2) * k};
    const Vec3<F> moved{to.x + e.x, to.y + e.y, to.z + e.z};
    const Vec3<F> o{along(ox, oy, 0), along(ox, oy, 1), along(ox, oy, 2)};
    const F per_z = F(1) / moved.z, m = F(1) / to.z;
    const F shift_x = o.x + (h * (e.x - to.x * m * e.z) - o.z * moved.x) * per_z;
    const F shift_y = o.y + (h * (e.y - to.y * m * e.z) - o.z * moved.y) * per_z;
    const F c = F(S(view.cos_rotation)), s = F(S(view.sin_rotation));
    const F per = F(1) / sqrt(dot(moved, moved));
    return {{pixels.x + (c * shift_x + s * shift_y), pixels.y + (c * shift_y - s * shift_x), F(0)},
            {moved.x * per, moved.y * per, moved.z * per}};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
