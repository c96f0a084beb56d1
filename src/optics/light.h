// The light that the pixels of a packet receive from the panel: fetched panel pixels (texels) and sums over samples. Floor 1.
//
// Radiance is linear light, 1 = a white panel pixel. A texel is four adjacent floats (R, G, B, 0), 16-byte aligned, so that one
// load fetches it whole.
#pragma once
#include "optics/panel.h"
#include "simd/pair.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

/// The texel that each ray of a packet reaches, and the share of its light that the ray carries: 0 where it reaches none.
template <class F>
struct Fetch {
    static constexpr int shift = LaneTraits<F>::width == 1 ? 0 : 1;
    // The texel's number; of several lanes its offset in pairs of floats, as addresses scale by 8 bytes at most. On a panel with
    // subpixels the number of PanelHit, four times the texel's plus the channel, shifted alike.
    Uint<F> place = Uint<F>(0u);
    F weight = F(0);

    Fetch() = default;
    LFDSIM_FN explicit Fetch(const PanelHit<F>& hit)
        : place(select(hit.lit, hit.pixel, Uint<F>(0u)) << shift), weight(select(hit.lit, hit.weight, F(0))) {}

    /// Returns one colour (0 .. 2) of the texels, times their weights.
    LFDSIM_FN F light_of(const float* texels, int colour) const {
        return LaneTraits<F>::gather_pairs(texels + colour, place << (1 - shift)) * weight;
    }
};

/// The light of subpixels, one of which each ray of a packet meets: R, G, B and an unused number of each lane.
template <class F>
struct SubpixelLight {
    Scalar<F> lane[LaneTraits<F>::width][4];

    LFDSIM_FN SubpixelLight(const float* texels, const Fetch<F>& fetch) {
        // It goes through separate arrays, so that the Fetch of panels without subpixels stays in registers.
        std::uint32_t code[LaneTraits<F>::width];
        Scalar<F> weight[LaneTraits<F>::width];
        store(fetch.place >> Fetch<F>::shift, code);
        store(fetch.weight, weight);
        load_all(texels, code, weight);
    }

  private:
    LFDSIM_APART void load_all(const float* texels, const std::uint32_t* code, const Scalar<F>* weight) {
        for (int k = 0; k < LaneTraits<F>::width; ++k) {
            const float* const texel = texels + std::size_t(code[k] >> 2) * 4;
            const std::uint32_t channel = code[k] & 3;
            for (std::uint32_t c = 0; c < 4; ++c) lane[k][c] = channel == 3 || channel == c ? Scalar<F>(texel[c]) * weight[k] : 0;
        }
    }
};

/// Loads the texels of a Fetch. A register of N lanes holds N/4 whole texels, so its lanes are then colours, four to a pixel,
/// and four registers hold the texels of all N pixels. Offsets are kept in memory, one for each pixel.
template <class F>
class Fetching {
  public:
    LFDSIM_FN explicit Fetching(const Fetch<F>& fetch) : weight_(fetch.weight) {
        __builtin_memcpy(index_, &fetch.place, sizeof index_);
#ifndef __CUDACC__
        // Through memory: compilers tend to extract the offsets from the vector register, which is slower.
        if constexpr (N > 1) asm("" : "+m"(index_));
#endif
    }
    /// Returns the texels of the pixels quarter N/4 .. (quarter + 1) N/4 - 1, times their weights. With one lane: colour `quarter`.
    template <int quarter>
    LFDSIM_FN F light(const float* texels) const {
        if constexpr (N == 1) {
            // The four numbers of a texel are one load.
            const void* const texel = __builtin_assume_aligned(texels + std::size_t(index_[0]) * 4, 16);
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

/// The sum of weight x radiance for each pixel of a packet: R, G, B and an unused number, pixel after pixel, in four registers
/// of F's width. In this layout a texel is added by one load and one product for its three colours.
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
    /// Adds two samples, whose light is summed before it is added: the order of sums decides on their last bits.
    LFDSIM_FN void add(const float* texels, const Fetch<F>& first, const Fetch<F>& second) {
        const Fetching<F> a(first), b(second);
        sum[0] = sum[0] + (a.template light<0>(texels) + b.template light<0>(texels));
        sum[1] = sum[1] + (a.template light<1>(texels) + b.template light<1>(texels));
        sum[2] = sum[2] + (a.template light<2>(texels) + b.template light<2>(texels));
        sum[3] = sum[3] + (a.template light<3>(texels) + b.template light<3>(texels));
    }
    /// Adds a fetched pixel of a panel with or without subpixels.
    LFDSIM_FN void add(const Emission<Scalar<F>>& emission, const float* texels, const Fetch<F>& fetch) {
        if (emission.whole) [[likely]]
            add(texels, fetch);
        else
            add(SubpixelLight<F>(texels, fetch).lane);
    }
    LFDSIM_FN void add(const Emission<Scalar<F>>& emission, const float* texels, const Fetch<F>& first, const Fetch<F>& second) {
        if (emission.whole) [[likely]] {
            add(texels, first, second);
        } else {
            Light both;
            both.add(SubpixelLight<F>(texels, first).lane);
            both.add(SubpixelLight<F>(texels, second).lane);
            add(both);
        }
    }
    /// Adds one channel (0 .. 2) of another sum, or all of them (3).
    LFDSIM_FN void add(const Light& other, int channel) {
        Scalar<F> shown[4 * N];
        for (int k = 0; k < 4 * N; ++k) shown[k] = channel == 3 || channel == k % 4 ? Scalar<F>(1) : Scalar<F>(0);
        for (int r = 0; r < 4; ++r) sum[r] = sum[r] + other.sum[r] * load<F>(shown + r * N);
    }
    LFDSIM_FN void add(const Light& other) {
        for (int r = 0; r < 4; ++r) sum[r] = sum[r] + other.sum[r];
    }
    /// Adds the light of each pixel: R, G, B and an unused number.
    LFDSIM_FN void add(const Scalar<F> (*lanes)[4]) {
        const Scalar<F>* const first = lanes[0];
        for (int r = 0; r < 4; ++r) sum[r] = sum[r] + load<F>(first + r * N);
    }
    /// Writes R, G, B and an unused number of each pixel, 4 N numbers in all.
    LFDSIM_FN void store(Scalar<F>* to) const {
        for (int r = 0; r < 4; ++r) optics::store(sum[r], to + r * N);
    }
    /// Returns colour c (0 .. 2) of pixel k of the packet.
    LFDSIM_FN Scalar<F> operator()(int k, int c) const {
        if constexpr (N == 1)
            return sum[c];
        else
            return sum[k / (N / 4)].v[k % (N / 4) * 4 + c];
    }
};

}  // namespace lfdsim::optics::inline LFDSIM_ISA
