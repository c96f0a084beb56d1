// The light that a packet of pixels has gathered from the panel. Floor 1.
#pragma once
#include "optics/pair.h"
#include "optics/panel.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The texels that a packet's rays met, and what the rays carry of their light: 0 where a ray met none.
template <class F>
struct Fetch {
    static constexpr int N = LaneTraits<F>::width;
    std::uint32_t index[N] = {};  // in pairs of floats: with a scale of 8 bytes the address needs no shift
    F weight = F(0);

    Fetch() = default;
    LFDSIM_FN explicit Fetch(const PanelHit<F>& hit) : weight(select(hit.lit, hit.weight, F(0))) {
        const Uint<F> pairs = select(hit.lit, hit.pixel, Uint<F>(0u)) << 1;
        __builtin_memcpy(index, &pairs, sizeof index);
        // By way of memory, for compilers like to extract addresses from vectors, which is slower.
        if constexpr (N > 1) asm("" : "+m"(index));
    }
    /// The texels of lanes quarter N/4 .. (quarter + 1) N/4 - 1 side by side, times their weights. One lane: colour `quarter`.
    template <int quarter>
    LFDSIM_FN F light(const float* texels) const {
        if constexpr (N == 1) {
            return F(texels[std::size_t(index[0]) * 2 + quarter]) * weight;
        } else {
            constexpr int first = quarter * (N / 4);
            F texel, repeated;
            for (int k = 0; k < N / 4; ++k) {
                std::size_t i = index[first + k];
                asm("" : "+r"(i));
                __builtin_memcpy((char*)&texel + 16 * k, texels + i * 2, 16);
            }
            for (int k = 0; k < N; ++k) repeated.v[k] = weight.v[first + k / 4];
            return texel * repeated;
        }
    }
};

/// The same of two samples; their light is added up first.
template <class F>
struct FetchPair {
    Fetch<F> a, b;
    FetchPair() = default;
    LFDSIM_FN explicit FetchPair(const PanelHit<Pair<F>>& hit)
        : a({hit.pixel.a, hit.weight.a, hit.lit.a}), b({hit.pixel.b, hit.weight.b, hit.lit.b}) {}
    template <int quarter>
    LFDSIM_FN F light(const float* texels) const {
        return a.template light<quarter>(texels) + b.template light<quarter>(texels);
    }
};

/// Sums of weight x radiance for each lane: R, G, B and an idle number, lane after lane, in four registers of F's width: a texel is
/// then one load, whatever its depth, and one product serves its three colours.
template <class F>
struct Light {
    static constexpr int N = LaneTraits<F>::width;
    F sum[4] = {F(0), F(0), F(0), F(0)};

    template <class Fetched>
    LFDSIM_FN void add(const float* texels, const Fetched& fetch) {
        sum[0] = sum[0] + fetch.template light<0>(texels);
        sum[1] = sum[1] + fetch.template light<1>(texels);
        sum[2] = sum[2] + fetch.template light<2>(texels);
        sum[3] = sum[3] + fetch.template light<3>(texels);
    }
    LFDSIM_FN void add(const Light& other) {
        for (int r = 0; r < 4; ++r) sum[r] = sum[r] + other.sum[r];
    }
    /// Colour c of lane k.
    LFDSIM_FN Scalar<F> operator()(int k, int c) const {
        if constexpr (N == 1)
            return sum[c];
        else
            return sum[k / (N / 4)].v[k % (N / 4) * 4 + c];
    }
};

}  // namespace lfdsim::optics::inline LFDSIM_ISA
