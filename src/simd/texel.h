// A pixel's light, and sums of light, as four numbers in one register: R, G, B and an unused one. Floor 1.
#pragma once
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

// In code for GPUs the types are structs, else vectors of the compiler.
#ifdef __CUDACC__
struct alignas(16) Texel {
    float v[4];
    LFDSIM_FN friend Texel operator*(Texel a, float b) { return {{a.v[0] * b, a.v[1] * b, a.v[2] * b, a.v[3] * b}}; }
    LFDSIM_FN void operator+=(Texel b) {
        for (int c = 0; c < 4; ++c) v[c] += b.v[c];
    }
};
LFDSIM_FN void store_texel(Texel texel, float (&to)[4]) {
    for (int c = 0; c < 4; ++c) to[c] = texel.v[c];
}

struct alignas(16) LightSums {
    std::uint32_t v[4];
    LFDSIM_FN friend LightSums operator-(LightSums a, LightSums b) {
        return {{a.v[0] - b.v[0], a.v[1] - b.v[1], a.v[2] - b.v[2], a.v[3] - b.v[3]}};
    }
};
// This is one load of 16 bytes; a copy by memcpy would be 16 loads of one byte.
LFDSIM_FN LightSums load_sums(const std::uint32_t* from) {
    const uint4 v = *reinterpret_cast<const uint4*>(from);
    return {{v.x, v.y, v.z, v.w}};
}
LFDSIM_FN Texel texel_of(LightSums a) {
    return {{float(std::int32_t(a.v[0])), float(std::int32_t(a.v[1])), float(std::int32_t(a.v[2])), float(std::int32_t(a.v[3]))}};
}
#else
typedef float Texel __attribute__((vector_size(16)));
LFDSIM_FN void store_texel(Texel texel, float (&to)[4]) { __builtin_memcpy(to, &texel, sizeof texel); }

/// Entries of a summed-area table, or their differences, in its units.
typedef std::uint32_t LightSums __attribute__((vector_size(16)));  // each modulo 2^32
LFDSIM_FN LightSums load_sums(const std::uint32_t* from) {
    LightSums sums;
    __builtin_memcpy(&sums, from, sizeof sums);
    return sums;
}
/// Returns sums of light that are differences modulo 2^32 as floats, in the table's units: read as two's complement, they are right
/// while the true sum is below 2^31.
LFDSIM_FN Texel texel_of(LightSums a) {
    typedef std::int32_t Signed __attribute__((vector_size(16)));
    return __builtin_convertvector((Signed)a, Texel);
}
#endif

}  // namespace lfdsim::optics::inline LFDSIM_ISA
