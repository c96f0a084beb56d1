// Numbers of a footprint's probes, in arrays of fixed length, which compilers vectorize, and sums over them in a fixed order.
// Floor 2.
#pragma once
#include "simd/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

constexpr int most_probes = 16;  // of a footprint: a multiple of every packet's width

/// Returns the first probe whose flag is set, or the last of all.
LFDSIM_FN int first_probe(const bool (&a)[most_probes]) {
    int p = 0;
    while (p + 1 < most_probes && !a[p]) ++p;
    return p;
}
/// Returns the sum of all numbers, in an order that does not depend on the instruction set.
template <class S>
LFDSIM_FN S sum_of(const S (&a)[most_probes]) {
    static_assert(most_probes == 16);
    S b[8], c[4];
    for (int p = 0; p < 8; ++p) b[p] = a[p] + a[p + 8];
    for (int p = 0; p < 4; ++p) c[p] = b[p] + b[p + 4];
    return (c[0] + c[2]) + (c[1] + c[3]);
}
/// Returns the least of all numbers.
template <class S>
LFDSIM_FN S least_of(const S (&a)[most_probes]) {
    S least = a[0];
    for (int p = 1; p < most_probes; ++p) least = min(least, a[p]);
    return least;
}

/// The numbers of the probes a few steps before or behind each probe.
template <class S>
class Neighbours {
  public:
    LFDSIM_FN explicit Neighbours(const S (&a)[most_probes]) {
        for (int p = 0; p < most_probes; ++p) padded_[pad + p] = a[p];
    }
    /// Returns the neighbours' numbers for F's lanes, from probe p on; anything where there is no such probe.
    template <class F>
    LFDSIM_FN F at(int p, int step) const {
        return load<F>(padded_ + pad + p + step);
    }

  private:
    static constexpr int pad = 4;  // steps at most
    S padded_[most_probes + 2 * pad] = {};
};

/// Weighted sums over the probes, at several nodes, of four numbers of each probe, and the means. The fourth number is 1 for probes
/// that count and 0 for others, so that its sum is that of the weights.
template <class S, int most_nodes>
class NodeSums {
  public:
    LFDSIM_FN void add(int node, const S (&weight)[most_probes], const S (&row)[most_probes][4]) {
        S part[4][4] = {};
        for (int p = 0; p < most_probes; ++p)
            for (int c = 0; c < 4; ++c) part[p % 4][c] = part[p % 4][c] + weight[p] * row[p][c];
        for (int c = 0; c < 4; ++c) sum_[node][c] = sum_[node][c] + ((part[0][c] + part[2][c]) + (part[1][c] + part[3][c]));
    }
    /// Computes the means of the first three numbers at the first `count` nodes; false: at one of them all weights are 0.
    LFDSIM_FN bool means(int count, S (*mean)[4]) const {
        bool empty = false;
        for (int node = 0; node < count; ++node) {
            empty = empty || sum_[node][3] == S(0);
            for (int c = 0; c < 3; ++c) mean[node][c] = sum_[node][c] / sum_[node][3];
        }
        return !empty;
    }

  private:
    S sum_[most_nodes][4] = {};
};

}  // namespace lfdsim::optics::inline LFDSIM_ISA
