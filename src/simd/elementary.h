// Sine, logarithm, power and the inverse error function over lanes: polynomials, so that all instruction sets agree. Floor 1.
// The double instance serves as reference and uses the library's functions.
#pragma once
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Computes sine and cosine of |a| <= pi/2, radians, by Taylor's series; `small` promises |a| <= 0.05, where fewer terms suffice.
/// The error is below 1.3e-7 (1e-7 if `small`).
template <class F>
LFDSIM_FN void sincos(F a, bool small, F& sine, F& cosine) {
    if constexpr (LaneTraits<F>::width == 1 && sizeof(F) == 8) {
        sine = __builtin_sin(a);
        cosine = __builtin_cos(a);
        return;
    }
    using S = Scalar<F>;
    const F x = a * a;
    if (small) {
        sine = a - a * (x * F(S(1.0 / 6)));
        cosine = F(1) - x * (F(S(0.5)) - x * F(S(1.0 / 24)));
        return;
    }
    const F s = F(S(-1.0 / 6)) +
                x * (F(S(1.0 / 120)) + x * (F(S(-1.0 / 5040)) +
                                            x * (F(S(1.0 / 362880)) + x * (F(S(-1.0 / 39916800)) + x * F(S(1.0 / 6227020800.0))))));
    const F c =
        F(S(-0.5)) +
        x * (F(S(1.0 / 24)) +
             x * (F(S(-1.0 / 720)) + x * (F(S(1.0 / 40320)) + x * (F(S(-1.0 / 3628800)) +
                                                                   x * (F(S(1.0 / 479001600)) - x * F(S(1.0 / 87178291200.0)))))));
    sine = a + a * (x * s);
    cosine = F(1) + x * c;
}

/// Returns the arc tangent, radians; error below 3e-7 (Abramowitz and Stegun 4.4.49, beyond 1 by atan a = pi/2 - atan(1/a)).
template <class F>
LFDSIM_FN F atan(F a) {
    if constexpr (LaneTraits<F>::width == 1 && sizeof(F) == 8) return __builtin_atan(a);
    using S = Scalar<F>;
    constexpr double c[8] = {0.0028662257, -0.0161657367, 0.0429096138, -0.0752896400,
                             0.1065626393, -0.1420889944, 0.1999355085, -0.3333314528};
    const F size = abs(a);
    const Mask<F> steep = size > F(1);
    const F t = select(steep, F(1) / max(size, F(1)), size), x = t * t;
    F p = F(S(c[0]));
    for (int i = 1; i < 8; ++i) p = p * x + F(S(c[i]));
    p = t + t * x * p;
    p = select(steep, F(S(1.5707963267948966)) - p, p);
    return select(a < F(0), -p, p);
}

/// Returns the base-2 logarithm of a > 0; error below 2e-7 relative to max(1, |result|).
template <class F>
LFDSIM_FN F log2(F a) {
    if constexpr (LaneTraits<F>::width == 1 && sizeof(F) == 8) return __builtin_log2(a);
    using S = Scalar<F>;
    // a = m 2^e, m in [sqrt(1/2), sqrt 2); 0x3f3504f3 is the pattern of sqrt(1/2)
    const Uint<F> bits = float_bits(a) - Uint<F>(0x3f3504f3u);
    const F e = from_int<F>((bits >> 23) - ((bits >> 31) << 9));  // arithmetic shift
    const F m = bits_float<F>((bits & Uint<F>(0x007fffffu)) + Uint<F>(0x3f3504f3u));
    const F y = (m - F(1)) / (m + F(1)), x = y * y;  // ln m = 2 atanh y
    const F series = F(1) + x * (F(S(1.0 / 3)) + x * (F(S(0.2)) + x * (F(S(1.0 / 7)) + x * F(S(1.0 / 9)))));
    return e + y * series * F(S(2.8853900817779268));  // 2 / ln 2
}

/// Returns 2^a for -126 <= a <= 126 (clamped); relative error below 2.5e-7.
template <class F>
LFDSIM_FN F exp2(F a) {
    if constexpr (LaneTraits<F>::width == 1 && sizeof(F) == 8) return __builtin_exp2(a);
    using S = Scalar<F>;
    a = min(max(a, F(S(-126))), F(S(126)));
    const F whole = floor(a + F(S(0.5))), x = (a - whole) * F(S(0.6931471805599453));  // 2^a = 2^whole e^x, |x| <= ln(2)/2
    const F series =
        F(1) +
        x * (F(1) + x * (F(S(0.5)) + x * (F(S(1.0 / 6)) + x * (F(S(1.0 / 24)) + x * (F(S(1.0 / 120)) + x * F(S(1.0 / 720)))))));
    return series * bits_float<F>((to_int(whole) + Uint<F>(127u)) << 23);
}

/// Returns cos^m for 0 < cos <= 1.
template <class F>
LFDSIM_FN F power(F cosine, Scalar<F> m) {
    if (m == Scalar<F>(1)) return cosine;
    if constexpr (LaneTraits<F>::width == 1 && sizeof(F) == 8) return __builtin_pow(cosine, m);
    return exp2(F(m) * log2(max(cosine, F(Scalar<F>(1e-30)))));
}

/// Returns the inverse of the error function on [-1, 1], finite at the ends (|x| is kept at most 1 - 2^-24): M. Giles,
/// "Approximating the erfinv function", GPU Computing Gems Jade Edition, 2011, single precision; error below 1e-6 relative. For
/// double, two steps of Newton's method refine it.
template <class F>
LFDSIM_FN F erfinv(F x) {
    using S = Scalar<F>;
    const F one = F(1);
    x = min(max(x, F(S(-1 + 1.0 / 16777216))), F(S(1 - 1.0 / 16777216)));
    const F w = log2((one - x) * (one + x)) * F(S(-0.6931471805599453));  // -ln(1 - x^2)
    const F u = w - F(S(2.5)), v = sqrt(max(w, F(0))) - F(S(3));
    auto horner = [](F t, const double* c) {
        F sum = F(S(c[0]));
        for (int i = 1; i < 9; ++i) sum = sum * t + F(S(c[i]));
        return sum;
    };
    const double centre[9] = {2.81022636e-08, 3.43273939e-07, -3.5233877e-06, -4.39150654e-06, 0.00021858087,
                              -0.00125372503, -0.00417768164, 0.246640727,    1.50140941};
    const double tail[9] = {-0.000200214257, 0.000100950558, 0.00134934322, -0.00367342844, 0.00573950773,
                            -0.0076224613,   0.00943887047,  1.00167406,    2.83297682};
    F y = x * select(w < F(S(5)), horner(u, centre), horner(v, tail));
    if constexpr (LaneTraits<F>::width == 1 && sizeof(F) == 8) {
        for (int i = 0; i < 2; ++i) y -= (__builtin_erf(y) - x) / (1.1283791670955126 * __builtin_exp(-y * y));
    }
    return y;
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
