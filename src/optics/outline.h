// The outline of a lens's cell, and how much of it lies in a box. Floor 1.
#pragma once
#include "optics/lattice.h"
#include "optics/scene.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

constexpr int most_corners = 8;

/// A convex polygon, counter-clockwise to the viewer; mm from the lens's axis, in the display's frame.
template <class S>
struct Outline {
    int corners;
    Place<S> corner[most_corners];
};

/// The outline of a cell. A strip is `half_width` wide to each side of its axis, and `reach` long to each side along it.
template <class S>
LFDSIM_FN Outline<S> outline_of(const Lattice<S>& lattice, S half_width, S reach) {
    Outline<S> of;
    if (lattice.hexagonal) {
        const S x = lattice.half_pitch[0], y = reach_of_cell(lattice);
        const Place<S> corner[6] = {{x, S(-0.5) * y}, {x, S(0.5) * y}, {0, y}, {-x, S(0.5) * y}, {-x, S(-0.5) * y}, {0, -y}};
        of.corners = 6;
        for (int k = 0; k < 6; ++k) of.corner[k] = corner[k];
    } else {
        const S x = lattice.strips ? half_width : lattice.half_pitch[0], y = lattice.strips ? reach : lattice.half_pitch[1];
        const Place<S> corner[4] = {{x, -y}, {x, y}, {-x, y}, {-x, -y}};
        of.corners = 4;
        for (int k = 0; k < 4; ++k) of.corner[k] = corner[k];
    }
    for (int k = 0; k < of.corners; ++k) of.corner[k] = to_display(lattice, of.corner[k].x, of.corner[k].y);
    return of;
}

/// How far light enters beyond a border at these slopes, mm: bilinear, and outside the table as at its end.
template <class S>
LFDSIM_FN S clear_beyond(const ClearBorders<S>& clear, int kind, S towards, S along) {
    constexpr int rows = ClearBorders<S>::towards, columns = ClearBorders<S>::along;
    const auto node = [](S place, int count, int& first) {
        const S within = min(max(place, S(0)), S(count - 1));
        first = min(int(within), count - 2);
        return within - S(first);
    };
    int i, j;
    const S a = node((towards / clear.most + S(1)) * S(0.5 * (rows - 1)), rows, i),
            b = node(along / clear.most * S(columns - 1), columns, j);
    const S(&of)[rows][columns] = clear.beyond[kind];
    const S low = of[i][j] + a * (of[i + 1][j] - of[i][j]), high = of[i][j + 1] + a * (of[i + 1][j + 1] - of[i][j + 1]);
    return low + b * (high - low);
}

/// The outline of a cell between borders that may have moved: those of optics::borders(), then the opposite ones.
template <class S>
LFDSIM_FN Outline<S> outline_between(const Lattice<S>& lattice, const Borders<S> (&edge)[most_corners]) {
    Outline<S> of;
    of.corners = 2 * border_pairs(lattice);
    for (int k = 0; k < of.corners; ++k) {  // where an edge meets the one before it
        const Borders<S>&e = edge[k > 0 ? k - 1 : of.corners - 1], &f = edge[k];
        const S per = S(1) / (e.x * f.y - e.y * f.x);
        of.corner[k] = to_display(lattice, (e.half * f.y - f.half * e.y) * per, (f.half * e.x - e.half * f.x) * per);
    }
    return of;
}

/// That of a circle, as a polygon of its area.
template <class S>
LFDSIM_FN Outline<S> outline_of_circle(S radius) {
    Outline<S> of;
    of.corners = 8;
    const S far = S(1.0538796) * radius, c = S(0.92387953) * far,
            s = S(0.38268343) * far;  // sqrt(pi / (4 sin 45)), at 22.5 degrees
    const Place<S> corner[8] = {{c, s}, {s, c}, {-s, c}, {-c, s}, {-c, -s}, {-s, -c}, {s, -c}, {c, -s}};
    for (int k = 0; k < 8; ++k) of.corner[k] = corner[k];
    return of;
}

/// The corners of a polygon for each lane, in either sense of rotation.
template <class F>
struct Corners {
    int count;
    F x[most_corners], y[most_corners];
};

template <class F>
LFDSIM_FN Mask<F> lies_in(const Corners<F>& of, F x, F y) {
    F least = F(Scalar<F>(1e30)), most = -least;
    for (int k = 0; k < of.count; ++k) {
        const int next = k + 1 < of.count ? k + 1 : 0;
        const F turn = (of.x[next] - of.x[k]) * (y - of.y[k]) - (of.y[next] - of.y[k]) * (x - of.x[k]);
        least = min(least, turn);
        most = max(most, turn);
    }
    return !(least < F(0)) || !(most > F(0));
}

/// A box for each lane.
template <class F>
struct Box {
    F left, right, low, high;
};

/// Does a polygon hold a whole box?
template <class F>
LFDSIM_FN Mask<F> holds(const Corners<F>& of, const Box<F>& box) {
    const F half = F(Scalar<F>(0.5)), x = half * (box.left + box.right), y = half * (box.low + box.high), wide = box.right - x,
            high = box.high - y;
    F least = F(Scalar<F>(1e30)), most = -least;
    for (int k = 0; k < of.count; ++k) {
        const int next = k + 1 < of.count ? k + 1 : 0;
        const F to_x = of.x[next] - of.x[k], to_y = of.y[next] - of.y[k];
        const F turn = to_x * (y - of.y[k]) - to_y * (x - of.x[k]), reach = abs(to_x) * high + abs(to_y) * wide;
        least = min(least, turn - reach);
        most = max(most, turn + reach);
    }
    return (least > F(0)) || (most < F(0));
}

/// The area of a polygon's part within a box: by Green's theorem the integral over y, along the border of the polygon and up to the
/// box's ends, of x cut to the box.
template <class F>
LFDSIM_FN F area_within(const Corners<F>& of, const Box<F>& box) {
    using S = Scalar<F>;
    const auto cut = [](F value, F low, F high) { return min(max(value, low), high); };
    F area = F(0);
    for (int k = 0; k < of.count; ++k) {
        const int next = k + 1 < of.count ? k + 1 : 0;
        const F x = of.x[k], y = of.y[k], rise = of.y[next] - y, from = cut(y, box.low, box.high),
                to = cut(of.y[next], box.low, box.high);
        const F slope = (of.x[next] - x) / select(rise == F(0), F(1), rise), a = x + (from - y) * slope, b = x + (to - y) * slope;
        // The mean of x cut to the box, as x goes from a to b.
        const F least = min(a, b), most = max(a, b), way = most - least, none = F(0);
        const F left = cut(box.left - least, none, way), right = cut(most - box.right, none, way);
        const F middle = F(S(0.5)) * (cut(least, box.left, box.right) + cut(most, box.left, box.right));
        const Mask<F> leans = way > F(S(1e-6));
        const F mean = middle + (left * (box.left - middle) + right * (box.right - middle)) / select(leans, way, F(1));
        area = area + (to - from) * select(leans, mean, middle);
    }
    return abs(area);
}

/// A part of the plane: its area, its middle, and half the width and height of a rectangle with the same second moments.
template <class F>
struct Moments {
    F area, x, y, half_width, half_height;
};

/// Those of a polygon's part within a box; also by Green's theorem. The integrands are of third degree at most between the points
/// where the border enters and leaves the box, so two points of Gauss's rule there give them exactly.
template <class F>
LFDSIM_FN Moments<F> part_within(const Corners<F>& of, const Box<F>& box) {
    using S = Scalar<F>;
    const auto cut = [](F value, F low, F high) { return min(max(value, low), high); };
    const F zero = F(0), one = F(1), half = F(S(0.5)), middle_x = half * (box.left + box.right),
            middle_y = half * (box.low + box.high), far_x = box.right - middle_x;
    F sum = zero, sum_x = zero, sum_y = zero, sum_xx = zero, sum_yy = zero;
    for (int k = 0; k < of.count; ++k) {
        const int next = k + 1 < of.count ? k + 1 : 0;
        const F x = of.x[k] - middle_x, y = of.y[k], rise = of.y[next] - y, from = cut(y, box.low, box.high),
                way = cut(of.y[next], box.low, box.high) - from;
        if (!any(abs(way) > zero)) continue;
        const F slope = (of.x[next] - of.x[k]) / select(rise == zero, one, rise), start = x + (from - y) * slope, run = way * slope;
        const F per = one / select(run == zero, one, run), enters = cut((zero - far_x - start) * per, zero, one),
                leaves = cut((far_x - start) * per, zero, one);
        const F bend[4] = {zero, min(enters, leaves), max(enters, leaves), one};
        for (int part = 0; part < 3; ++part) {
            const F length = bend[part + 1] - bend[part], centre = half * (bend[part + 1] + bend[part]);
            if (!any(length > zero)) continue;
            for (int side = -1; side <= 1; side += 2) {
                const F t = centre + F(S(side * 0.28867513459481287)) * length;  // 1 / (2 sqrt 3)
                const F at_x = cut(start + t * run, zero - far_x, far_x), at_y = from + t * way - middle_y,
                        weight = half * length * way;
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
    const auto width = [](F spread) { return sqrt(F(S(3)) * max(spread, F(0))); };
    return {abs(sum), middle_x + x, middle_y + y, width(spread_x), width(spread_y)};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
