// On a GPU: are inverse(), root() and quotient() of simd/lane.h what IEEE 754 says, for numbers as rays have them? All
// floats from 1e-30 to 1e30 for the first two; for the third 2^36 pairs from 2^-30 to 2^30, each also with a numerator whose
// quotient lies next to the middle between two floats.
//
//     nvcc -std=c++20 -arch=native --fmad=false -DLFDSIM_ISA=cuda -Isrc tests/cuda/arithmetic.cu -o arithmetic && ./arithmetic
#include "simd/lane.h"

#include <cstdio>

namespace {

namespace optics = lfdsim::optics;

__device__ unsigned long long wrong[4];

__device__ std::uint32_t mixed(std::uint64_t n) {
    n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
    n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
    return std::uint32_t((n ^ (n >> 31)) >> 16);
}

__device__ void count(int which, float a, float b) {
    if (__float_as_uint(a) != __float_as_uint(b)) atomicAdd(&wrong[which], 1ull);
}

/// A float of either sign, within 2^-range .. 2^range.
__device__ float ordinary(std::uint32_t bits, int range) {
    const std::uint32_t exponent = 127 - std::uint32_t(range) + (bits >> 23 & 0xff) % std::uint32_t(2 * range);
    return __uint_as_float((bits & 0x807fffffu) | exponent << 23);
}

__global__ void try_all(float least, float most, std::uint64_t pairs) {
    const std::uint64_t first = std::uint64_t(blockIdx.x) * blockDim.x + threadIdx.x, step = std::uint64_t(gridDim.x) * blockDim.x;
    for (std::uint64_t n = __float_as_uint(least) + first; n <= __float_as_uint(most); n += step) {
        const float a = __uint_as_float(std::uint32_t(n));
        count(0, optics::inverse(a), __frcp_rn(a));
        count(0, optics::inverse(-a), __frcp_rn(-a));
        count(1, optics::root(a), __fsqrt_rn(a));
    }
    for (std::uint64_t n = first; n < pairs; n += step) {
        const float a = ordinary(mixed(2 * n + 1), 30), b = ordinary(mixed(2 * n + 2), 30);
        count(2, optics::quotient(a, b), __fdiv_rn(a, b));
        // A numerator whose quotient by b lies as near as can be to the middle between two floats.
        const float hard = __fmaf_rn(b, a, 0.5f * __uint_as_float((__float_as_uint(a) & 0x7f800000u) - (23u << 23)) * b);
        count(3, optics::quotient(hard, b), __fdiv_rn(hard, b));
    }
    if (first == 0) {
        count(1, optics::root(0.0f), 0.0f);
        count(2, optics::quotient(0.0f, 1.5f), 0.0f);
        count(2, optics::quotient(0.0f, -1.5f), -0.0f);
        count(2, optics::quotient(-0.0f, -1.5f), 0.0f);
    }
}

}  // namespace

int main() {
    try_all<<<4096, 256>>>(1e-30f, 1e30f, std::uint64_t(1) << 36);
    unsigned long long found[4];
    const cudaError_t done = cudaMemcpyFromSymbol(found, wrong, sizeof found);
    if (done != cudaSuccess) return std::printf("%s\n", cudaGetErrorString(done)), 2;
    std::printf("wrong: %llu inverses, %llu roots, %llu quotients, %llu quotients near a middle\n", found[0], found[1], found[2],
                found[3]);
    return found[0] + found[1] + found[2] + found[3] == 0 ? 0 : 1;
}
