// F, the number type that the optics is written over: float, double, or N float lanes of a SIMD register (simd.h). Floor 1.
//
// The optics never branches on an F: it uses select(mask, a, b), and any(mask) or none(mask) to skip work that no lane needs.
// Every operation rounds once, as IEEE 754 says, so that all instruction sets agree to the last bit.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "simd/config.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// What belongs to an F: its scalar, its mask of truth values, its 32-bit unsigned integer and its number of lanes. This is that of
/// float and double; simd.h and pair.h specialise it. Free functions of the same names below call its functions.
template <class F>
struct LaneTraits {
    using Scalar = F;
    using Mask = bool;
    using Uint = std::uint32_t;
    static constexpr int width = 1;
    static LFDSIM_FN F from_int(std::uint32_t a) { return F(std::int32_t(a)); }
    static LFDSIM_FN F bits_float(std::uint32_t a) { return F(__builtin_bit_cast(float, a)); }
    template <class T>
    static LFDSIM_FN T load(const T* from) {
        return *from;
    }
    static LFDSIM_FN void store(F a, F* to) { *to = a; }
    /// Returns the first of a pair of numbers for each lane, `pair` being the number of the pair of those that begin at `from`.
    static LFDSIM_FN F gather_pairs(const F* from, std::uint32_t pair) { return from[std::size_t(pair) * 2]; }
    static LFDSIM_FN void load_rows(const F* from, const std::uint32_t* row, F (&to)[4]) {
        for (int k = 0; k < 4; ++k) to[k] = from[std::size_t(row[0]) * 4 + std::size_t(k)];
    }
};
/// The type of one lane of an F.
template <class F>
using Scalar = typename LaneTraits<F>::Scalar;
/// The truth values of an F's lanes: what comparisons return.
template <class F>
using Mask = typename LaneTraits<F>::Mask;
/// A 32-bit unsigned integer for each lane of an F.
template <class F>
using Uint = typename LaneTraits<F>::Uint;

// The functions of an F. Those on float and double are here; simd.h and pair.h have the same for their types.

LFDSIM_FN bool any(bool m) { return m; }
/// Returns a && b, without a branch where they are single values.
LFDSIM_FN bool both(bool a, bool b) { return a & b; }
template <class M>
LFDSIM_FN M both(const M& a, const M& b) {
    return a && b;
}
LFDSIM_FN float select(bool m, float a, float b) { return m ? a : b; }
LFDSIM_FN double select(bool m, double a, double b) { return m ? a : b; }
LFDSIM_FN std::uint32_t select(bool m, std::uint32_t a, std::uint32_t b) { return m ? a : b; }
LFDSIM_FN float sqrt(float a) { return __builtin_sqrtf(a); }
LFDSIM_FN double sqrt(double a) { return __builtin_sqrt(a); }
LFDSIM_FN float floor(float a) { return __builtin_floorf(a); }
LFDSIM_FN double floor(double a) { return __builtin_floor(a); }
LFDSIM_FN float abs(float a) { return __builtin_fabsf(a); }
LFDSIM_FN double abs(double a) { return __builtin_fabs(a); }
// The minimum and maximum are b if either is NaN, as with the SIMD instructions.
LFDSIM_FN float min(float a, float b) { return a < b ? a : b; }
LFDSIM_FN std::uint32_t min(std::uint32_t a, std::uint32_t b) { return a < b ? a : b; }
LFDSIM_FN int min(int a, int b) { return a < b ? a : b; }
LFDSIM_FN double min(double a, double b) { return a < b ? a : b; }
LFDSIM_FN float max(float a, float b) { return a > b ? a : b; }
LFDSIM_FN int max(int a, int b) { return a > b ? a : b; }
LFDSIM_FN double max(double a, double b) { return a > b ? a : b; }

/// Whether threads that run together wait for each other where they branch apart. A short cut for some of them then gains nothing.
#ifdef __CUDA_ARCH__
constexpr bool threads_apart = true;
#else
constexpr bool threads_apart = false;
#endif

/// Returns the number of zeros below the lowest one of a > 0.
LFDSIM_FN int trailing_zeros(std::uint32_t a) {
#ifdef __CUDA_ARCH__
    return __ffs(int(a)) - 1;
#else
    return __builtin_ctz(a);
#endif
}

#ifdef __CUDA_ARCH__
// Estimates for inverse(), quotient() and root() below.
LFDSIM_FN float reciprocal_estimate(float a) {
    float r;
    asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(r) : "f"(a));
    return r;
}
/// Returns a b + c, rounded once. It is written as an instruction, so that a compiled kernel shows which fused products were meant
/// (tests/cuda/ptx.py).
LFDSIM_FN float fused(float a, float b, float c) {
    float r;
    asm("fma.rn.f32 %0, %1, %2, %3;" : "=f"(r) : "f"(a), "f"(b), "f"(c));
    return r;
}
LFDSIM_FN float inverse_root_estimate(float a) {
    float r;
    asm("rsqrt.approx.ftz.f32 %0, %1;" : "=f"(r) : "f"(a));
    return r;
}
#endif

/// Returns a whole-numbered `a` as 32-bit two's complement; a number out of range or NaN gives 0x80000000.
template <class F>
LFDSIM_FN std::uint32_t to_int(F a) {
    return a >= F(-2147483648.0) && a < F(2147483648.0) ? std::uint32_t(std::int32_t(a)) : 0x80000000u;
}
/// Returns floor(a) as to_int() gives it, except that on a GPU a number that is too large gives 0x7fffffff.
template <class F>
LFDSIM_FN auto floor_to_int(F a) {
#ifdef __CUDA_ARCH__
    if constexpr (std::is_same_v<F, float>) return std::uint32_t(__float2int_rd(fmaxf(a, -2147483648.0f)));
#endif
    return to_int(floor(a));
}

// inverse(), quotient() and root() are 1/b, a/b and the square root of numbers of ordinary size, as rays have: a, b, a/b and the
// root's argument are within 1e-30 .. 1e30, and a may be 0, too. The result for other numbers is arbitrary: the caller must have
// ended such a ray anyway. On a GPU this needs no branch for other numbers. The steps are Newton's, from an estimate, with a
// residual that is exact (Markstein 1990), and give the bits of IEEE 754's operations (tests/cuda/arithmetic.cu).
template <class F>
LFDSIM_FN F inverse(F b) {
#ifdef __CUDA_ARCH__
    if constexpr (std::is_same_v<F, float>) {
        const float about = reciprocal_estimate(b);
        return fused(about, fused(-b, about, 1.0f), about);
    }
#endif
    return F(1) / b;
}
template <class F>
LFDSIM_FN F quotient(F a, F b) {
#ifdef __CUDA_ARCH__
    if constexpr (std::is_same_v<F, float>) {
        const float per = inverse(b), near = __fmul_rn(a, per);
        return fused(per, fused(-b, near, a), near);
    }
#endif
    return a / b;
}
template <class F>
LFDSIM_FN F root(F a) {
#ifdef __CUDA_ARCH__
    if constexpr (std::is_same_v<F, float>) {
        const float inverse = inverse_root_estimate(fmaxf(a, 1e-37f)), near = __fmul_rn(a, inverse);
        return fused(fused(-near, near, a), __fmul_rn(inverse, 0.5f), near);
    }
#endif
    return sqrt(a);
}

/// Returns the bit pattern of `a` as a float, for logarithms and powers.
LFDSIM_FN std::uint32_t float_bits(float a) { return __builtin_bit_cast(std::uint32_t, a); }
LFDSIM_FN std::uint32_t float_bits(double a) { return __builtin_bit_cast(std::uint32_t, float(a)); }
/// Returns `a`, read as two's complement, as a number.
template <class F>
LFDSIM_FN F from_int(Uint<F> a) {
    return LaneTraits<F>::from_int(a);
}
/// Returns the float with the bit pattern `a`.
template <class F>
LFDSIM_FN F bits_float(Uint<F> a) {
    return LaneTraits<F>::bits_float(a);
}
/// Reads F's lanes, or those of its unsigned integer, from consecutive numbers, which need not be aligned.
template <class F>
LFDSIM_FN F load(const Scalar<F>* from) {
    return LaneTraits<F>::template load<F>(from);
}
template <class F>
LFDSIM_FN Uint<F> load(const std::uint32_t* from) {
    return LaneTraits<F>::template load<Uint<F>>(from);
}

/// Writes F's lanes to consecutive numbers.
template <class F>
LFDSIM_FN void store(F a, Scalar<F>* to) {
    LaneTraits<F>::store(a, to);
}

template <class U>
LFDSIM_FN void store(U a, std::uint32_t* to) {
    __builtin_memcpy(to, &a, sizeof a);
}

/// Reads a row of four numbers for each lane l, number row[l] of those that begin at `from`; to[k] receives the k-th of each.
template <class F>
LFDSIM_FN void load_rows(const Scalar<F>* from, const std::uint32_t* row, F (&to)[4]) {
    LaneTraits<F>::load_rows(from, row, to);
}

template <class M>
LFDSIM_FN bool none(M m) {
    return !any(m);
}

}  // namespace lfdsim::optics::inline LFDSIM_ISA
