// LanePair<H>: two numbers H side by side, which the tracer uses for two samples of the same pixels. Floor 1.
//
// A sample is one long chain of dependent operations. Two independent chains hide each other's latency, and share what their pixels
// have in common (docs/performance.md).
#pragma once
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The truth values of a pair.
template <class M>
struct PairMask {
    M a, b;
    friend LFDSIM_FN PairMask operator&&(PairMask x, PairMask y) { return {x.a && y.a, x.b && y.b}; }
    friend LFDSIM_FN PairMask operator||(PairMask x, PairMask y) { return {x.a || y.a, x.b || y.b}; }
    friend LFDSIM_FN PairMask operator!(PairMask x) { return {!x.a, !x.b}; }
};

/// The 32-bit unsigned integers of a pair; they wrap.
template <class U>
struct PairUint {
    U a, b;
    PairUint() = default;
    LFDSIM_FN PairUint(U x, U y) : a(x), b(y) {}
    LFDSIM_FN PairUint(std::uint32_t x) : a(x), b(x) {}
    friend LFDSIM_FN PairUint operator+(PairUint x, PairUint y) { return {x.a + y.a, x.b + y.b}; }
    friend LFDSIM_FN PairUint operator-(PairUint x, PairUint y) { return {x.a - y.a, x.b - y.b}; }
    friend LFDSIM_FN PairUint operator*(PairUint x, PairUint y) { return {x.a * y.a, x.b * y.b}; }
    friend LFDSIM_FN PairUint operator^(PairUint x, PairUint y) { return {x.a ^ y.a, x.b ^ y.b}; }
    friend LFDSIM_FN PairUint operator&(PairUint x, PairUint y) { return {x.a & y.a, x.b & y.b}; }
    friend LFDSIM_FN PairUint operator|(PairUint x, PairUint y) { return {x.a | y.a, x.b | y.b}; }
    friend LFDSIM_FN PairUint operator>>(PairUint x, int s) { return {x.a >> s, x.b >> s}; }
    friend LFDSIM_FN PairUint operator<<(PairUint x, int s) { return {x.a << s, x.b << s}; }
};

/// An F (lane.h) of twice as many lanes: those of `a`, then those of `b`.
template <class H>
struct LanePair {
    H a, b;
    LanePair() = default;
    LFDSIM_FN LanePair(H x, H y) : a(x), b(y) {}
    LFDSIM_FN LanePair(float x) : a(x), b(x) {}
    friend LFDSIM_FN LanePair operator+(LanePair x, LanePair y) { return {x.a + y.a, x.b + y.b}; }
    friend LFDSIM_FN LanePair operator-(LanePair x, LanePair y) { return {x.a - y.a, x.b - y.b}; }
    friend LFDSIM_FN LanePair operator*(LanePair x, LanePair y) { return {x.a * y.a, x.b * y.b}; }
    friend LFDSIM_FN LanePair operator/(LanePair x, LanePair y) { return {x.a / y.a, x.b / y.b}; }
    friend LFDSIM_FN LanePair operator-(LanePair x) { return {-x.a, -x.b}; }
    friend LFDSIM_FN PairMask<Mask<H>> operator<(LanePair x, LanePair y) { return {x.a < y.a, x.b < y.b}; }
    friend LFDSIM_FN PairMask<Mask<H>> operator<=(LanePair x, LanePair y) { return {x.a <= y.a, x.b <= y.b}; }
    friend LFDSIM_FN PairMask<Mask<H>> operator>(LanePair x, LanePair y) { return {x.a > y.a, x.b > y.b}; }
    friend LFDSIM_FN PairMask<Mask<H>> operator>=(LanePair x, LanePair y) { return {x.a >= y.a, x.b >= y.b}; }
    friend LFDSIM_FN PairMask<Mask<H>> operator==(LanePair x, LanePair y) { return {x.a == y.a, x.b == y.b}; }
};

template <class H>
struct LaneTraits<LanePair<H>> {
    using Scalar = optics::Scalar<H>;
    using Mask = PairMask<optics::Mask<H>>;
    using Uint = PairUint<optics::Uint<H>>;
    static constexpr int width = 2 * LaneTraits<H>::width;
    static LFDSIM_FN LanePair<H> from_int(Uint x) { return {optics::from_int<H>(x.a), optics::from_int<H>(x.b)}; }
    static LFDSIM_FN LanePair<H> bits_float(Uint x) { return {optics::bits_float<H>(x.a), optics::bits_float<H>(x.b)}; }
    template <class T, class S>
    static LFDSIM_FN T load(const S* from) {
        return {optics::load<H>(from), optics::load<H>(from + width / 2)};
    }
    static LFDSIM_FN void load_rows(const Scalar* from, const std::uint32_t* row, LanePair<H> (&to)[4]) {
        H a[4], b[4];
        optics::load_rows<H>(from, row, a);
        optics::load_rows<H>(from, row + width / 2, b);
        for (int k = 0; k < 4; ++k) to[k] = {a[k], b[k]};
    }
};

// The functions of lane.h, on both numbers of a pair.

template <class M>
LFDSIM_FN bool any(PairMask<M> m) {
    return any(m.a || m.b);
}
template <class U>
LFDSIM_FN auto operator<(PairUint<U> x, PairUint<U> y) -> PairMask<decltype(x.a < y.a)> {
    return {x.a < y.a, x.b < y.b};
}
template <class M, class H>
LFDSIM_FN LanePair<H> select(PairMask<M> m, LanePair<H> x, LanePair<H> y) {
    return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
template <class M, class U>
LFDSIM_FN PairUint<U> select(PairMask<M> m, PairUint<U> x, PairUint<U> y) {
    return {select(m.a, x.a, y.a), select(m.b, x.b, y.b)};
}
template <class H>
LFDSIM_FN LanePair<H> sqrt(LanePair<H> x) {
    return {sqrt(x.a), sqrt(x.b)};
}
template <class H>
LFDSIM_FN LanePair<H> floor(LanePair<H> x) {
    return {floor(x.a), floor(x.b)};
}
template <class H>
LFDSIM_FN LanePair<H> abs(LanePair<H> x) {
    return {abs(x.a), abs(x.b)};
}
template <class H>
LFDSIM_FN LanePair<H> min(LanePair<H> x, LanePair<H> y) {
    return {min(x.a, y.a), min(x.b, y.b)};
}
template <class H>
LFDSIM_FN LanePair<H> max(LanePair<H> x, LanePair<H> y) {
    return {max(x.a, y.a), max(x.b, y.b)};
}
template <class H>
LFDSIM_FN PairUint<Uint<H>> to_int(LanePair<H> x) {
    return {to_int(x.a), to_int(x.b)};
}
template <class H>
LFDSIM_FN PairUint<Uint<H>> float_bits(LanePair<H> x) {
    return {float_bits(x.a), float_bits(x.b)};
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
