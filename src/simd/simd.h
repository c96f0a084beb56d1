// Lane<N>: N floats in a SIMD register, over the vector extensions of GCC and Clang. Floor 1.
//
// The extensions do arithmetic and comparison; intrinsics are used only where these lack an operation (sqrt, floor, min, max) or
// where compilers do not use the mask registers of AVX-512 by themselves.
#pragma once
#include <immintrin.h>

#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The compilers' vectors of N numbers. GCC 12 accepts a vector_size that depends on N only inside a separate struct.
template <int N>
struct Vectors {
    typedef float Float __attribute__((vector_size(4 * N)));
    typedef std::uint32_t Uint __attribute__((vector_size(4 * N)));
    typedef std::int32_t Int __attribute__((vector_size(4 * N)));
};

/// Truth values of N lanes.
template <int N>
struct LaneMask {
    typename Vectors<N>::Int v;  // all bits of a lane are set, or none
    friend LFDSIM_FN LaneMask operator&&(LaneMask a, LaneMask b) { return {a.v & b.v}; }
    friend LFDSIM_FN LaneMask operator||(LaneMask a, LaneMask b) { return {a.v | b.v}; }
    friend LFDSIM_FN LaneMask operator!(LaneMask a) { return {~a.v}; }
};

/// N 32-bit unsigned integers; they wrap.
template <int N>
struct LaneUint {
    typename Vectors<N>::Uint v;
    LaneUint() = default;
    LFDSIM_FN LaneUint(typename Vectors<N>::Uint a) : v(a) {}
    LFDSIM_FN LaneUint(std::uint32_t a) : v(a + typename Vectors<N>::Uint{}) {}
    friend LFDSIM_FN LaneUint operator+(LaneUint a, LaneUint b) { return a.v + b.v; }
    friend LFDSIM_FN LaneUint operator-(LaneUint a, LaneUint b) { return a.v - b.v; }
    friend LFDSIM_FN LaneUint operator*(LaneUint a, LaneUint b) { return a.v * b.v; }
    friend LFDSIM_FN LaneUint operator^(LaneUint a, LaneUint b) { return a.v ^ b.v; }
    friend LFDSIM_FN LaneUint operator&(LaneUint a, LaneUint b) { return a.v & b.v; }
    friend LFDSIM_FN LaneUint operator|(LaneUint a, LaneUint b) { return a.v | b.v; }
    friend LFDSIM_FN LaneUint operator>>(LaneUint a, int s) { return a.v >> s; }
    friend LFDSIM_FN LaneUint operator<<(LaneUint a, int s) { return a.v << s; }
};

/// N floats, an F (lane.h). A comparison with NaN is false.
template <int N>
struct Lane {
    typename Vectors<N>::Float v;
    Lane() = default;
    LFDSIM_FN Lane(typename Vectors<N>::Float a) : v(a) {}
    LFDSIM_FN Lane(float a) : v(a - typename Vectors<N>::Float{}) {}
    friend LFDSIM_FN Lane operator+(Lane a, Lane b) { return a.v + b.v; }
    friend LFDSIM_FN Lane operator-(Lane a, Lane b) { return a.v - b.v; }
    friend LFDSIM_FN Lane operator*(Lane a, Lane b) { return a.v * b.v; }
    friend LFDSIM_FN Lane operator/(Lane a, Lane b) { return a.v / b.v; }
    friend LFDSIM_FN Lane operator-(Lane a) { return -a.v; }
    friend LFDSIM_FN LaneMask<N> operator<(Lane a, Lane b) { return compare<_CMP_LT_OQ>(a, b, a.v < b.v); }
    friend LFDSIM_FN LaneMask<N> operator<=(Lane a, Lane b) { return compare<_CMP_LE_OQ>(a, b, a.v <= b.v); }
    friend LFDSIM_FN LaneMask<N> operator>(Lane a, Lane b) { return compare<_CMP_GT_OQ>(a, b, a.v > b.v); }
    friend LFDSIM_FN LaneMask<N> operator>=(Lane a, Lane b) { return compare<_CMP_GE_OQ>(a, b, a.v >= b.v); }
    friend LFDSIM_FN LaneMask<N> operator==(Lane a, Lane b) { return compare<_CMP_EQ_OQ>(a, b, a.v == b.v); }

  private:
    template <int code>
    static LFDSIM_FN LaneMask<N> compare(Lane, Lane, typename Vectors<N>::Int result) {
        return {result};
    }
};

template <int N>
struct LaneTraits<Lane<N>> {
    using Scalar = float;
    using Mask = LaneMask<N>;
    using Uint = LaneUint<N>;
    static constexpr int width = N;
    static LFDSIM_FN Lane<N> from_int(Uint a) {
        return __builtin_convertvector((typename Vectors<N>::Int)a.v, typename Vectors<N>::Float);
    }
    static LFDSIM_FN Lane<N> bits_float(Uint a) { return (typename Vectors<N>::Float)a.v; }
    template <class T>
    static LFDSIM_FN T load(const void* from) {
        T value;
        __builtin_memcpy(&value.v, from, sizeof value.v);
        return value;
    }
    static LFDSIM_FN void store(Lane<N> a, float* to) { __builtin_memcpy(to, &a.v, sizeof a.v); }
    static LFDSIM_FN Lane<N> gather_pairs(const float* from, Uint pair) {
#if defined(__AVX512F__)
        return (typename Vectors<N>::Float)_mm512_i32gather_ps((__m512i)pair.v, from, 8);
#elif defined(__AVX2__)
        return (typename Vectors<N>::Float)_mm256_i32gather_ps(from, (__m256i)pair.v, 8);
#else
        Lane<N> to;
        for (int k = 0; k < N; ++k) to.v[k] = from[std::size_t(pair.v[k]) * 2];
        return to;
#endif
    }
    // Four rows, of lanes l .. l + 3, are read into the same four lanes of four registers; then each block of four by four numbers
    // is transposed.
    static LFDSIM_FN void load_rows(const float* from, const std::uint32_t* row, Lane<N> (&to)[4]) {
        typename Vectors<N>::Float rows[4];
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l < N; l += 4) __builtin_memcpy((char*)&rows[k] + 4 * l, from + std::size_t(row[l + k]) * 4, 16);
        const auto low = quarters<0, 4, 1, 5>(rows[0], rows[1]), low2 = quarters<0, 4, 1, 5>(rows[2], rows[3]);
        const auto high = quarters<2, 6, 3, 7>(rows[0], rows[1]), high2 = quarters<2, 6, 3, 7>(rows[2], rows[3]);
        to[0] = quarters<0, 1, 4, 5>(low, low2);
        to[1] = quarters<2, 3, 6, 7>(low, low2);
        to[2] = quarters<0, 1, 4, 5>(high, high2);
        to[3] = quarters<2, 3, 6, 7>(high, high2);
    }

  private:
    template <int...>
    struct Numbers {};
    template <int... of, class V, int... lane>
    static LFDSIM_FN V shuffled(V a, V b, Numbers<lane...>) {
        constexpr int from[4] = {of...};
        return __builtin_shufflevector(a, b, (from[lane % 4] % 4 + lane / 4 * 4 + from[lane % 4] / 4 * N)...);
    }
    /// Returns a register whose blocks of four lanes take the numbers `of` from the same block of a (0 to 3) and b (4 to 7).
    template <int... of, class V>
    static LFDSIM_FN V quarters(V a, V b) {
        if constexpr (N == 4) return shuffled<of...>(a, b, Numbers<0, 1, 2, 3>());
        if constexpr (N == 8) return shuffled<of...>(a, b, Numbers<0, 1, 2, 3, 4, 5, 6, 7>());
        if constexpr (N == 16) return shuffled<of...>(a, b, Numbers<0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15>());
    }
};

// The functions of lane.h, lane by lane. Those that need intrinsics exist for the width of the instruction set compiled for.

template <int N>
LFDSIM_FN LaneMask<N> operator<(LaneUint<N> a, LaneUint<N> b) {
    return {a.v < b.v};
}
template <int N>
LFDSIM_FN Lane<N> select(LaneMask<N> m, Lane<N> a, Lane<N> b) {
    return m.v ? a.v : b.v;
}
template <int N>
LFDSIM_FN LaneUint<N> select(LaneMask<N> m, LaneUint<N> a, LaneUint<N> b) {
    return m.v ? a.v : b.v;
}
template <int N>
LFDSIM_FN Lane<N> abs(Lane<N> a) {
    return __builtin_bit_cast(typename Vectors<N>::Float, __builtin_bit_cast(typename Vectors<N>::Uint, a.v) & 0x7fffffffu);
}
template <int N>
LFDSIM_FN LaneUint<N> to_int(Lane<N> a) {  // x86 converts a number out of range to 0x80000000
    return (typename Vectors<N>::Uint) __builtin_convertvector(a.v, typename Vectors<N>::Int);
}
template <int N>
LFDSIM_FN LaneUint<N> float_bits(Lane<N> a) {
    return (typename Vectors<N>::Uint)a.v;
}
#if defined(__AVX512F__)
LFDSIM_FN bool any(LaneMask<16> m) { return _mm512_movepi32_mask((__m512i)m.v) != 0; }
LFDSIM_FN Lane<16> sqrt(Lane<16> a) { return (Vectors<16>::Float)_mm512_sqrt_ps((__m512)a.v); }
LFDSIM_FN Lane<16> floor(Lane<16> a) { return (Vectors<16>::Float)_mm512_roundscale_ps((__m512)a.v, 1); }
LFDSIM_FN Lane<16> min(Lane<16> a, Lane<16> b) { return (Vectors<16>::Float)_mm512_min_ps((__m512)a.v, (__m512)b.v); }
LFDSIM_FN Lane<16> max(Lane<16> a, Lane<16> b) { return (Vectors<16>::Float)_mm512_max_ps((__m512)a.v, (__m512)b.v); }
#elif defined(__AVX2__)
LFDSIM_FN bool any(LaneMask<8> m) { return _mm256_movemask_ps((__m256)m.v) != 0; }
LFDSIM_FN Lane<8> sqrt(Lane<8> a) { return (Vectors<8>::Float)_mm256_sqrt_ps((__m256)a.v); }
LFDSIM_FN Lane<8> floor(Lane<8> a) { return (Vectors<8>::Float)_mm256_floor_ps((__m256)a.v); }
LFDSIM_FN Lane<8> min(Lane<8> a, Lane<8> b) { return (Vectors<8>::Float)_mm256_min_ps((__m256)a.v, (__m256)b.v); }
LFDSIM_FN Lane<8> max(Lane<8> a, Lane<8> b) { return (Vectors<8>::Float)_mm256_max_ps((__m256)a.v, (__m256)b.v); }
#else
LFDSIM_FN bool any(LaneMask<4> m) { return _mm_movemask_ps((__m128)m.v) != 0; }
LFDSIM_FN Lane<4> sqrt(Lane<4> a) { return (Vectors<4>::Float)_mm_sqrt_ps((__m128)a.v); }
LFDSIM_FN Lane<4> min(Lane<4> a, Lane<4> b) { return (Vectors<4>::Float)_mm_min_ps((__m128)a.v, (__m128)b.v); }
LFDSIM_FN Lane<4> max(Lane<4> a, Lane<4> b) { return (Vectors<4>::Float)_mm_max_ps((__m128)a.v, (__m128)b.v); }
LFDSIM_FN Lane<4> floor(Lane<4> a) {  // SSE2 cannot round: it truncates, then corrects; from 2^23 up every float is whole
    const Lane<4> t = from_int<Lane<4>>(to_int(a));
    return select(abs(a) < Lane<4>(8388608.0f), t - select(t > a, Lane<4>(1.0f), Lane<4>(0.0f)), a);
}
#endif

}  // namespace lfdsim::optics::inline LFDSIM_ISA
