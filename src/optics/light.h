// The light that a packet of pixels has gathered from the panel. Floor 1.
#pragma once
#include "optics/pair.h"
#include "optics/panel.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// Sums of weight x radiance for each lane: R, G, B and an idle number, lane after lane, in four registers of F's width: a texel is
/// then one load, whatever its depth, and one product serves its three colours.
template <class F>
struct Light {
    static constexpr int N = LaneTraits<F>::width;
    F sum[4] = {F(0), F(0), F(0), F(0)};

    LFDSIM_FN void add(const float* texels, const PanelHit<F>& hit) {
        if constexpr (N == 1) {
            if (!hit.lit) return;
            const float* const texel = texels + std::size_t(hit.pixel) * 4;
            for (int c = 0; c < 3; ++c) sum[c] = sum[c] + F(texel[c]) * hit.weight;
        } else {
            add_lanes(texels, select(hit.lit, hit.pixel, Uint<F>(0u)), select(hit.lit, hit.weight, F(0)));
        }
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

  private:
    LFDSIM_FN void add_lanes(const float* texels, Uint<F> pixel, F weight) {
        std::uint32_t index[N];
        __builtin_memcpy(index, &pixel, sizeof index);
        asm(""
            : "+m"(
                index));  // indices and addresses go by way of memory: compilers like to extract them from vectors, which is slower
        add_quarter<0>(texels, index, weight);
        add_quarter<1>(texels, index, weight);
        add_quarter<2>(texels, index, weight);
        add_quarter<3>(texels, index, weight);
    }
    template <int quarter>
    LFDSIM_FN void add_quarter(const float* texels, const std::uint32_t* index, F weight) {
        constexpr int first = quarter * (N / 4);
        F texel, repeated;  // the texels of N / 4 lanes side by side; their weights, each four times
        for (int k = 0; k < N / 4; ++k) {
            std::size_t i = index[first + k];
            asm("" : "+r"(i));
            __builtin_memcpy((char*)&texel + 16 * k, texels + i * 4, 16);
        }
        for (int k = 0; k < N; ++k) repeated.v[k] = weight.v[first + k / 4];
        sum[quarter] = sum[quarter] + texel * repeated;
    }
};

template <class H>
struct Light<Pair<H>> {
    Light<H> a, b;

    LFDSIM_FN void add(const float* texels, const PanelHit<Pair<H>>& hit) {
        a.add(texels, {hit.pixel.a, hit.weight.a, hit.lit.a});
        b.add(texels, {hit.pixel.b, hit.weight.b, hit.lit.b});
    }
    LFDSIM_FN void add(const Light& other) {
        a.add(other.a);
        b.add(other.b);
    }
    LFDSIM_FN Scalar<H> operator()(int k, int c) const { return k < Light<H>::N ? a(k, c) : b(k - Light<H>::N, c); }
};

}  // namespace lfdsim::optics::inline LFDSIM_ISA
