// Sample points: a pure function of (seed, pixel, sample, dimension). Floor 1.
//
// sobol: points of a Sobol sequence in Gray-code order (Antonov and Saleev 1979), the same for all pixels, scrambled in each pixel
// and dimension by a random digital shift (exclusive or with 32 random bits), so that every point is uniform: unbiased, and a net.
// random: independent hashes. Numbers are centred: uniform in [-1, 1].
#pragma once
#include "optics/traced_display.h"
#include "simd/lane.h"
#include "simd/pair.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Returns well-mixed bits (the finaliser "lowbias32" by C. Wellons).
template <class U>
LFDSIM_FN U mix(U h) {
    h = h ^ (h >> 16);
    h = h * U(0x7feb352du);
    h = h ^ (h >> 15);
    h = h * U(0x846ca68bu);
    return h ^ (h >> 16);
}

/// Returns the scramble key of a pixel and dimension. `pixel` = row x width + column of the whole frame, modulo 2^32.
template <class F>
LFDSIM_FN Uint<F> pixel_key(std::uint64_t seed, int dimension, Uint<F> pixel) {
    std::uint64_t h = (seed + 1) * 0x9e3779b97f4a7c15u + std::uint64_t(dimension) * 0xd1b54a32d192ed03u;  // splitmix64
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h = h ^ (h >> 31);
    return mix(mix(pixel + Uint<F>(std::uint32_t(h))) ^ Uint<F>(std::uint32_t(h >> 32)));
}

/// The sample points of a packet of pixels, in the order of the samples.
template <class F>
struct Sampler {
    Sampling sampling;
    int dimensions;                                // 0 .. dimensions-1 are in use
    std::uint32_t sample = 0;                      // number of the present sample
    Uint<F> key[sampler_dimensions];               // 32 random bits of each pixel and dimension
    std::uint32_t point[sampler_dimensions] = {};  // of the Sobol sequence, common to all pixels

    LFDSIM_FN Sampler(Sampling kind, int used, std::uint64_t seed, Uint<F> pixel) : sampling(kind), dimensions(used) {
        for (int d = 0; d < sampler_dimensions; ++d)  // a constant count, so that the keys may stay in registers
            key[d] = d < used ? pixel_key<F>(seed, d, pixel) : Uint<F>(0u);
    }
    /// Returns the number of dimension d, in [-1, 1]: 32 bits as two's complement, over 2^31. Only numbers of dimensions in use are
    /// distributed as described above.
    LFDSIM_FN F operator()(int d) const {
        const Uint<F> bits =
            sampling == Sampling::sobol ? key[d] ^ Uint<F>(point[d]) : mix(mix(key[d] + Uint<F>(sample * 0x9e3779b9u)) ^ key[d]);
        return from_int<F>(bits) * F(Scalar<F>(1.0 / 2147483648.0));
    }
    /// Advances to the next sample; in Gray-code order one direction number changes (docs/model.md, "Sampling").
    LFDSIM_FN void next(const DirectionNumbers& directions) {
        ++sample;
        const int bit = trailing_zeros(sample);
        // Without pixel filter and pupil there are only two dimensions. Of the others all are advanced, in use or not.
        point[0] ^= directions.v[0][bit];
        point[1] ^= directions.v[1][bit];
        if (dimensions <= 2) return;
        for (int d = 2; d < sampler_dimensions; ++d) point[d] ^= directions.v[d][bit];
    }
};

/// Two samples of the same pixels.
template <class H>
struct SamplerPair {
    const Sampler<H>&a, &b;
    LFDSIM_FN LanePair<H> operator()(int d) const { return {a(d), b(d)}; }
};

}  // namespace lfdsim::optics::inline LFDSIM_ISA
