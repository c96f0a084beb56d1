// The camera (docs/model.md, "Camera"): for each pixel the ray through its centre, and how a sample's ray differs from it. Floor 1.
//
// The ray through the pixel's centre is followed in double precision to the first plane of the display (the diffuser, or the top of
// the lens array). The tracer starts there, with coordinates relative to the axis of a lens near that point, so that single
// precision is enough.
#pragma once
#include "optics/lens_array.h"
#include "optics/panel.h"
#include "optics/sampler.h"
#include "optics/traced_display.h"
#include "simd/elementary.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The rays through the centres of a packet of pixels, where they cross the first plane.
template <class F>
struct PixelRays {
    F x, y;         // mm from the axis of the base lens, in the array's frame
    Vec3<F> to;     // unit direction, in the display's frame
    F per_length;   // 1 / distance along the ray from the pinhole to the plane of the frame, 1/mm
    Mask<F> alive;  // the rays that go down, towards the display
    Extent<Scalar<F>> extent;
    PanelBase<Scalar<F>> base;
};

/// A packet's pixels form a block of the frame, row by row, so that its rays reach panel pixels close to each other.
template <class F>
struct Block {
    static constexpr int lanes = LaneTraits<F>::width;
    static constexpr int width = lanes >= 8 ? 4 : lanes >= 4 ? 2 : lanes;
    static constexpr int height = lanes / width;
};

/// The size of the largest block, pixels. Its pixels share their base lens on every kernel, so that positions, and with them bits,
/// do not depend on the width of the kernel's packets.
constexpr std::int32_t shared_width = 4, shared_height = 4;

/// Computes the ray through the point (column, row) of the frame, in pixels: d, its direction in the display's frame, of the length
/// from pinhole to frame, and (x, y), where it crosses the first plane, mm from the array's centre in the array's frame. A ray that
/// goes away from the display does not cross it; it gets some finite point.
LFDSIM_FN void follow_to_first_plane(const RayOrigin& view, double column, double row, double d[3], double& x, double& y) {
    const double sx = (column - 0.5 * view.width) * view.pixel_mm, sy = (0.5 * view.height - row) * view.pixel_mm;
    for (int a = 0; a < 3; ++a) d[a] = view.forward[a] * view.distance + view.right[a] * sx + view.up[a] * sy;
    const double down = d[2] < -1e-9 * view.distance ? d[2] : -view.distance;
    const double t = (view.start_z - view.position[2]) / down;
    const Lattice<double>& lattice = view.lattice;
    const Vec2<double> at =
        to_array(lattice, view.position[0] + d[0] * t - lattice.offset[0], view.position[1] + d[1] * t - lattice.offset[1]);
    x = at.x;
    y = at.y;
}

/// The lens whose axis is the origin of the coordinates of nearby rays.
template <class S>
struct BaseLens {
    double x, y;         // its axis, mm from the array's centre, in the array's frame turned about z alone
    Extent<S> extent;    // the cells around it that hold a lens
    PanelBase<S> panel;  // where its axis meets the panel
};
/// Returns the base lens of the rays near the point (column, row) of the frame: one that exists, near where that ray crosses the
/// first plane.
template <class S>
LFDSIM_FN BaseLens<S> base_lens(const RayOrigin& view, double column, double row) {
    double d[3], x0, y0;
    follow_to_first_plane(view, column, row, d, x0, y0);
    const double nx = view.lattice.count[0], ny = view.lattice.count[1];
    const auto [i, j] = base_cell(view.lattice, lens_at(view.lattice, x0, y0));
    Vec2<double> axis = axis_in_array(view.lattice, Cell<double>{i, j});
    if (view.lattice.strips) axis.y = y0;  // any point of a strip's axis serves
    S raised = 0;
    if (view.wedged) {  // the wedge turns the axis's point in the vertex plane about the array's middle: it is moved and raised
        const auto along = [&](int k) { return view.wedge[k][0] * axis.x + view.wedge[k][1] * axis.y; };
        raised = S(along(2));
        axis = {along(0), along(1)};
    }
    // Panel pixels from the top left corner: u = (x + W/2)/a, v = (H/2 - y)/a
    const Vec2<double> at = in_display(view.lattice, axis);
    const double u = (at.x + 0.5 * view.panel_width) * view.pixels_per_mm,
                 v = (0.5 * view.panel_height - at.y) * view.pixels_per_mm;
    const double whole_u = __builtin_floor(u), whole_v = __builtin_floor(v);
    return {axis.x,
            axis.y,
            {S(-i), S(nx - 1 - i), S(-j), S(ny - 1 - j)},
            {to_int(whole_u), to_int(whole_v), S(u - whole_u), S(v - whole_v), raised}};
}

/// Returns the rays of the block whose first pixel is (column, row), multiples of the block's size.
template <class F>
LFDSIM_FN PixelRays<F> pixel_rays(const RayOrigin& view, std::int32_t column, std::int32_t row) {
    using S = Scalar<F>;
    constexpr int N = LaneTraits<F>::width;
    const BaseLens<S> lens = base_lens<S>(view, column / shared_width * shared_width + shared_width / 2,
                                          row / shared_height * shared_height + shared_height / 2);
    S x[N], y[N], dx[N], dy[N], dz[N], per_length[N];
    for (int k = 0; k < N; ++k) {  // compilers vectorize this
        double d[3], px, py;
        follow_to_first_plane(view, column + k % Block<F>::width + 0.5, row + k / Block<F>::width + 0.5, d, px, py);
        const double inverse = 1 / __builtin_sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        x[k] = S(px - lens.x);
        y[k] = S(py - lens.y);
        dx[k] = S(d[0] * inverse);
        dy[k] = S(d[1] * inverse);
        dz[k] = S(d[2] * inverse);
        per_length[k] = S(inverse);
    }
    const F z = load<F>(dz);
    return {load<F>(x), load<F>(y), {load<F>(dx), load<F>(dy), z}, load<F>(per_length), z < F(S(-1e-9)), lens.extent, lens.panel};
}

/// Returns a packet's rays twice, side by side, for two samples at once.
template <class H>
LFDSIM_FN PixelRays<LanePair<H>> twice(const PixelRays<H>& p) {
    return {{p.x, p.x},
            {p.y, p.y},
            {{p.to.x, p.to.x}, {p.to.y, p.to.y}, {p.to.z, p.to.z}},
            {p.per_length, p.per_length},
            {p.alive, p.alive},
            p.extent,
            p.base};
}

/// Maps two numbers in [-1, 1] to a point (x, y) of the unit disk, area preserved (Shirley and Chiu 1997): the radius is the one of
/// larger size, r, and the angle pi/4 times the other over r, from the x axis if r is a, else from the y axis.
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

/// Returns the rays, in the first plane, of a sample moved from the pixel's centre by `jitter` (half pixels, right and up), with
/// the pinhole moved by `lens` (radii of the pupil). With the unit direction d through the centre, m = d_xy / d_z and the height H
/// of the plane less that of the camera, a change e of direction moves the ray by H (e_xy - m e_z) / (d_z + e_z): no large numbers
/// cancel. A move o of the pinhole adds o_xy - o_z (d + e)_xy / (d_z + e_z).
template <class F>
LFDSIM_RARE Ray<F> displaced(const RayOrigin& view, const PixelRays<F>& pixels, F jitter_x, F jitter_y, F lens_x, F lens_y) {
    using S = Scalar<F>;
    const F h = F(S(view.start_z - view.position[2])), half = F(S(0.5 * view.pixel_mm)), pupil = F(S(view.pupil_radius));
    auto along = [&](F right, F up, int axis) { return right * F(S(view.right[axis])) + up * F(S(view.up[axis])); };
    // A ray from the pupil's point o meets the one from its centre in the plane in focus. So its direction, of the length from
    // pinhole to frame, differs by -o x (distance of the frame / distance of the focus).
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
    const F c = F(S(view.lattice.cos_turn)), s = F(S(view.lattice.sin_turn));
    const F per = F(1) / sqrt(dot(moved, moved));
    return {{pixels.x + (c * shift_x + s * shift_y), pixels.y + (c * shift_y - s * shift_x), F(0)},
            {moved.x * per, moved.y * per, moved.z * per}};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
