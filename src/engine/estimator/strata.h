// Strata of the filtered estimator: the sample domain of the diffuser's angles, cut at the borders of the lenses. Floor 2.
//
// A pixel's light is a mean over the domain [-1, 1]^2 of the diffuser's two coordinates u, v. The domain is cut into columns and
// rows; a cut near the border between two lenses is moved onto it, so that a stratum looks through one lens. The share of a stratum
// that a round lens covers has a closed form. (docs/model.md, "Filtered estimator".)
#pragma once
#include "optics/diffuser.h"
#include "optics/traced_display.h"
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The position along one axis at which a ray meets the plane of the lenses' holes, when the diffuser turns it by the angle a about
/// the other axis (its second turn is neglected): its slope, lateral mm per mm of descent, is tan(phi + a) or tan(phi - a), with
/// phi before the turn. Angles are given by their tangents: tan(phi + a) = (tan phi + tan a)/(1 - tan phi tan a).
template <class F>
struct Sweep {
    F at;                     // mm from the axis of the base lens: where the ray meets the diffuser
    F slope;                  // before the turn: tan(phi)
    Scalar<F> height, sense;  // mm, of the diffuser above the holes; +1 or -1: what a positive angle does to the slope

    /// Returns the slope after a turn by the angle of this tangent.
    LFDSIM_FN F turned(F tangent) const {
        const F t = F(sense) * tangent;
        return (slope + t) / (F(1) - slope * t);
    }
    LFDSIM_FN F place(F tangent) const { return at + F(height) * turned(tangent); }
    /// Returns the tangent of the angle that sends the ray to `place`.
    LFDSIM_FN F tangent(F place) const {
        const F to = (place - at) * F(Scalar<F>(1) / height);
        return F(sense) * ((to - slope) / (F(1) + slope * to));
    }
};
/// Returns Sweep::sense of an axis: a turn about y by a positive angle sends a ray towards -x; one about x, towards +y.
LFDSIM_FN int sense(int axis) { return axis == 0 ? -1 : 1; }
/// Returns half the area of the unit circle between x = 0 and t: (t sqrt(1 - t^2) + asin t) / 2, odd; |t| is cut to 1. The arc sine
/// is Abramowitz and Stegun's 4.4.46: error 2e-8.
template <class F>
LFDSIM_FN F circle_integral(F t) {
    using S = Scalar<F>;
    constexpr double c[8] = {-0.0012624911, 0.0066700901, -0.0170881256, 0.0308918810,
                             -0.0501743046, 0.0889789874, -0.2145988016, 1.5707963050};
    const F size = min(abs(t), F(1)), root = sqrt(F(1) - size);
    F p = F(S(c[0]));
    for (int i = 1; i < 8; ++i) p = p * size + F(S(c[i]));
    const F part = F(S(0.5)) * (size * root * sqrt(F(1) + size) + (F(S(1.5707963267948966)) - root * p));
    return select(t < F(0), -part, part);
}

/// A stratum along one axis: its share of the axis and its ends within the cell of its lens, in units of the hole's radius from the
/// lens's axis.
template <class F>
struct Span {
    F share;
    F from, to;                    // from <= to
    F integral_from, integral_to;  // circle_integral of them
};

/// Returns the area of {0 < X < x, 0 < Y < y} within the unit circle, odd in x and y: x y if the corner (x, y) lies in the circle,
/// else I(x) + I(y) - pi/4 with the circle_integral I. Both |x| and |y| may exceed 1.
template <class F>
LFDSIM_FN F corner_in_circle(F x, F integral_x, F y, F integral_y) {
    using S = Scalar<F>;
    const F quarter = F(S(0.78539816339744831));
    const F rest = abs(integral_x) + abs(integral_y) - quarter;
    const F signed_rest = select(x * y < F(0), -rest, rest);
    return select(x * x + y * y <= F(1), x * y, signed_rest);
}

/// Returns the share of a stratum's rectangle that a round hole covers; 0 where an end has passed the other. For a small rectangle,
/// where the difference of areas would lose its digits, the hole's edge is taken as straight.
template <class F>
LFDSIM_FN F hole_coverage(const Span<F>& a, const Span<F>& b) {
    using S = Scalar<F>;
    const F width = a.to - a.from, height = b.to - b.from, whole = width * height, least = F(S(1e-4));
    const F area = corner_in_circle(a.to, a.integral_to, b.to, b.integral_to) -
                   corner_in_circle(a.from, a.integral_from, b.to, b.integral_to) -
                   corner_in_circle(a.to, a.integral_to, b.from, b.integral_from) +
                   corner_in_circle(a.from, a.integral_from, b.from, b.integral_from);
    F cover = area / max(whole, least);
    const Mask<F> small = whole < least;
    if (any(small)) {
        const F x = F(S(0.5)) * (a.to + a.from), y = F(S(0.5)) * (b.to + b.from), rho = max(sqrt(x * x + y * y), F(S(1e-6)));
        const F reach = max(abs(x) * width + abs(y) * height, F(S(1e-12)));  // rho times the rectangle's extent across the edge
        cover = select(small, F(S(0.5)) + (F(1) - rho) * rho / reach, cover);
        // In a long, thin rectangle the edge is not straight: the part within the chord of the circle along it counts.
        auto chord = [](F along_from, F along_to, F across) {
            const F c = sqrt(max(F(1) - across * across, F(0)));
            return max(min(along_to, c) - max(along_from, -c), F(0)) / max(along_to - along_from, F(S(1e-6)));
        };
        const F longest = F(S(0.1));
        cover = select(small && (width > longest), chord(a.from, a.to, y), cover);
        cover = select(small && (height > longest), chord(b.from, b.to, x), cover);
    }
    // A rectangle without width or height counts, too: the diffuser may not turn rays along that axis.
    return select((width >= F(0)) && (height >= F(0)), min(max(cover, F(0)), F(1)), F(0));
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
