// The outlines of lenses' cells as polygons, and the moments of their parts within boxes. Floor 2.
#pragma once
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

constexpr int most_corners = 8;  // of an outline

/// The outline of a lens for each lane: the corners of a polygon, in either sense of rotation.
template <class F>
struct LensOutline {
    int count;
    F x[most_corners], y[most_corners];
};

/// A box for each lane: left <= x <= right, low <= y <= high.
template <class F>
struct Box {
    F left, right, low, high;
};

/// Returns whether a convex polygon contains a whole box: whether all its corners lie on the same side of each edge.
template <class F>
LFDSIM_FN Mask<F> contains(const LensOutline<F>& of, const Box<F>& box) {
    const F half = F(Scalar<F>(0.5)), x = half * (box.left + box.right), y = half * (box.low + box.high), wide = box.right - x,
            high = box.high - y;
    F least = F(Scalar<F>(1e30)), most = -least;
    for (int k = 0; k < of.count; ++k) {
        const int next = k + 1 < of.count ? k + 1 : 0;
        const F to_x = of.x[next] - of.x[k], to_y = of.y[next] - of.y[k];
        // The cross product of the edge with the way to the box's middle, and how much it differs at the corners at most
        const F turn = to_x * (y - of.y[k]) - to_y * (x - of.x[k]), reach = abs(to_x) * high + abs(to_y) * wide;
        least = min(least, turn - reach);
        most = max(most, turn + reach);
    }
    return (least > F(0)) || (most < F(0));
}

/// A part of the plane: its area, its middle, and half the width and height of a rectangle with the same second moments.
template <class F>
struct Moments {
    F area, x, y, half_width, half_height;
};

/// Returns the moments of a polygon's part within a box, by Green's theorem: with x and y from the box's middle the area is the
/// integral of x dy along the border, those of x and y over the area are the integrals of x^2/2 dy and x y dy, those of x^2 and y^2
/// are the integrals of x^3/3 dy and x y^2 dy. Cutting the coordinates of the polygon's border to the box gives the border of the
/// part: what is moved onto the upper or lower side has dy = 0. The integrands are of third degree at most between the points where
/// the border enters and leaves the box, so two points of Gauss's rule there give them exactly.
template <class F>
LFDSIM_FN Moments<F> part_within(const LensOutline<F>& of, const Box<F>& box) {
    using S = Scalar<F>;
    const auto cut = [](F value, F low, F high) { return min(max(value, low), high); };
    const F zero = F(0), one = F(1), half = F(S(0.5)), middle_x = half * (box.left + box.right),
            middle_y = half * (box.low + box.high), far_x = box.right - middle_x;
    F sum = zero, sum_x = zero, sum_y = zero, sum_xx = zero, sum_yy = zero;
    for (int k = 0; k < of.count; ++k) {
        const int next = k + 1 < of.count ? k + 1 : 0;
        // An edge, cut to the box's heights: from (start, from) by (run, cut_rise)
        const F x = of.x[k] - middle_x, y = of.y[k], rise = of.y[next] - y, from = cut(y, box.low, box.high),
                cut_rise = cut(of.y[next], box.low, box.high) - from;
        if (!any(abs(cut_rise) > zero)) continue;
        const F slope = (of.x[next] - of.x[k]) / select(rise == zero, one, rise), start = x + (from - y) * slope,
                run = cut_rise * slope;
        const F per = one / select(run == zero, one, run), enters = cut((zero - far_x - start) * per, zero, one),
                leaves = cut((far_x - start) * per, zero, one);
        // The shares of the edge at which it enters and leaves the box's width divide it into three parts.
        const F bend[4] = {zero, min(enters, leaves), max(enters, leaves), one};
        for (int part = 0; part < 3; ++part) {
            const F length = bend[part + 1] - bend[part], centre = half * (bend[part + 1] + bend[part]);
            if (!any(length > zero)) continue;
            for (int side = -1; side <= 1; side += 2) {
                const F t = centre + F(S(side * 0.28867513459481287)) * length;  // 1 / (2 sqrt 3)
                const F at_x = cut(start + t * run, zero - far_x, far_x), at_y = from + t * cut_rise - middle_y,
                        weight = half * length * cut_rise;
                sum = sum + weight * at_x;
                sum_y = sum_y + weight * at_x * at_y;
                sum_yy = sum_yy + weight * at_x * at_y * at_y;
                sum_x = sum_x + weight * at_x * at_x;
                sum_xx = sum_xx + weight * at_x * at_x * at_x;
            }
        }
    }
    const F per = one / select(sum == zero, one, sum), x = half * sum_x * per, y = sum_y * per;
    const F spread_x = F(S(1.0 / 3)) * sum_xx * per - x * x, spread_y = sum_yy * per - y * y;
    const auto width = [](F spread) { return sqrt(F(S(3)) * max(spread, F(0))); };  // a box of half width h has the variance h^2/3
    return {abs(sum), middle_x + x, middle_y + y, width(spread_x), width(spread_y)};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
