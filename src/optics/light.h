// The light that a packet of pixels has gathered from the panel. Floor 1.
#pragma once
#include "optics/pair.h"
#include "optics/panel.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The texels that a packet's rays met, and what the rays carry of their light: 0 where a ray met none.
template <class F>
struct Fetch {
    Uint<F> pairs = Uint<F>(0u);  // the texel's place, in pairs of floats: with a scale of 8 bytes the address needs no shift
    F weight = F(0);

    Fetch() = default;
    LFDSIM_FN explicit Fetch(const PanelHit<F>& hit)
        : pairs(select(hit.lit, hit.pixel, Uint<F>(0u)) << 1), weight(select(hit.lit, hit.weight, F(0))) {}
};

/// A fetch under way: the places lie in memory, lane by lane. A texel is four floats side by side (R, G, B, 0), so what is loaded
/// has colours beside one another where F has lanes; N/4 texels fill a register, and four registers hold those of all lanes.
template <class F>
class Fetching {
  public:
    LFDSIM_FN explicit Fetching(const Fetch<F>& fetch) : weight_(fetch.weight) {
        __builtin_memcpy(index_, &fetch.pairs, sizeof index_);
#ifndef __CUDACC__
        // By way of memory, for compilers like to extract addresses from vectors, which is slower.
        if constexpr (N > 1) asm("" : "+m"(index_));
#endif
    }
    /// The texels of lanes quarter N/4 .. (quarter + 1) N/4 - 1 side by side, times their weights. One lane: colour `quarter`.
    template <int quarter>
    LFDSIM_FN F light(const float* texels) const {
        if constexpr (N == 1) {
            // All four are one load.
            const void* const texel = __builtin_assume_aligned(texels + std::size_t(index_[0]) * 2, 16);
            return F(static_cast<const float*>(texel)[quarter]) * weight_;
        } else {
            constexpr int first = quarter * (N / 4);
            F texel, repeated;
            for (int k = 0; k < N / 4; ++k) {
                std::size_t i = index_[first + k];
#ifndef __CUDACC__
                asm("" : "+r"(i));
#endif
                __builtin_memcpy((char*)&texel + 16 * k, texels + i * 2, 16);
            }
            for (int k = 0; k < N; ++k) repeated.v[k] = weight_.v[first + k / 4];
            return texel * repeated;
        }
    }

  private:
    static constexpr int N = LaneTraits<F>::width;
    std::uint32_t index_[N];
    F weight_;
};

/// Sums of weight x radiance for each lane: R, G, B and an idle number, lane after lane, in four registers of F's width: a texel is
/// then one load, whatever its depth, and one product serves its three colours.
template <class F>
struct Light {
    static constexpr int N = LaneTraits<F>::width;
    F sum[4] = {F(0), F(0), F(0), F(0)};

    LFDSIM_FN void add(const float* texels, const Fetch<F>& fetch) {
        const Fetching<F> a(fetch);
        sum[0] = sum[0] + a.template light<0>(texels);
        sum[1] = sum[1] + a.template light<1>(texels);
        sum[2] = sum[2] + a.template light<2>(texels);
        sum[3] = sum[3] + a.template light<3>(texels);
    }
    /// Two samples: their light is added up first.
    LFDSIM_FN void add(const float* texels, const Fetch<F>& first, const Fetch<F>& second) {
        const Fetching<F> a(first), b(second);
        sum[0] = sum[0] + (a.template light<0>(texels) + b.template light<0>(texels));
        sum[1] = sum[1] + (a.template light<1>(texels) + b.template light<1>(texels));
        sum[2] = sum[2] + (a.template light<2>(texels) + b.template light<2>(texels));
        sum[3] = sum[3] + (a.template light<3>(texels) + b.template light<3>(texels));
    }
    LFDSIM_FN void add(const Light& other) {
        for (int r = 0; r < 4; ++r) sum[r] = sum[r] + other.sum[r];
    }
    /// Light of each lane: R, G, B and an idle number.
    LFDSIM_FN void add(const Scalar<F> (*lanes)[4]) {
        const Scalar<F>* const first = lanes[0];
        for (int r = 0; r < 4; ++r) sum[r] = sum[r] + load<F>(first + r * N);
    }
    /// R, G, B and an idle number of each lane.
    LFDSIM_FN void store(Scalar<F>* to) const {
        for (int r = 0; r < 4; ++r) optics::store(sum[r], to + r * N);
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
