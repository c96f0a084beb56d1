// A number for each of a bundle's probes, and what is found from all of them. Floor 1.
//
// On the CPU one thread has all probes, in arrays of fixed length, which compilers vectorize. On a GPU a team of as many threads as
// there are probes makes a bundle, and each has its own probe's numbers alone: in arrays of a whole bundle for each thread, what
// runs at once would fill several times the GPU's caches. All of a team must call these functions together; what they return is the
// same for all. Every sum has a fixed order, the same on both.
#pragma once
#include "optics/lane.h"

namespace lfdsim::optics::inline LFDSIM_ISA {

constexpr int most_probes = 16;
#if defined(__CUDA_ARCH__) || defined(LFDSIM_HOST_TEAMS)  // the latter: tests/engine/host_team.h
#define LFDSIM_TEAMS
constexpr int probe_threads = most_probes;
#else
constexpr int probe_threads = 1;
#endif
constexpr int probes_each = most_probes / probe_threads;
constexpr int block_threads = 128;  // of a GPU's thread block, whole teams

#ifdef LFDSIM_TEAMS

/// Which probe a thread's k-th is, k = 0 .. probes_each - 1.
LFDSIM_FN int probe_number(int) { return int(threadIdx.x % most_probes); }

/// The threads of a team among the 32 that run together.
LFDSIM_FN unsigned team_mask() { return 0xffffu << (threadIdx.x & 16u); }

/// Probe p's number.
template <class S>
LFDSIM_FN S of_probe(const S (&a)[probes_each], int p) {
    return __shfl_sync(team_mask(), a[0], p, most_probes);
}
template <class S>
LFDSIM_FN void set_probe(S (&a)[probes_each], int p, S value) {
    if (probe_number(0) == p) a[0] = value;
}
/// The first probe whose flag is set, or the last of all.
LFDSIM_FN int first_probe(const bool (&a)[probes_each]) {
    return trailing_zeros(__ballot_sync(team_mask(), a[0]) >> (threadIdx.x & 16u) | 1u << (most_probes - 1));
}
/// That of the probe whose number is by 1, 2, 4 or 8 larger or smaller, in pairs.
template <class S>
LFDSIM_FN S of_pair(S a, int distance) {
    return __shfl_xor_sync(team_mask(), a, distance, most_probes);
}
template <class S>
LFDSIM_FN S sum_of(const S (&a)[probes_each]) {
    S sum = a[0];
    for (int distance = 8; distance > 0; distance /= 2) sum = sum + of_pair(sum, distance);
    return sum;
}
template <class S>
LFDSIM_FN S least_of(const S (&a)[probes_each]) {
    S least = a[0];
    for (int distance = 8; distance > 0; distance /= 2) least = min(least, of_pair(least, distance));
    return least;
}
/// The numbers of probes a few before or behind each.
template <class S>
class Neighbours {
  public:
    LFDSIM_FN explicit Neighbours(const S (&a)[probes_each]) : own_(a[0]) {}
    /// Of F's lanes, from probe p on; anything where there is no such probe.
    template <class F>
    LFDSIM_FN F at(int, int step) const {
        return __shfl_sync(team_mask(), own_, probe_number(0) + step, most_probes);
    }

  private:
    S own_;
};

/// Sums over the probes of four numbers of each times its weight, at several nodes; and the means, whose weights' sum is the last.
/// The threads of a team are 4 x 4: each has one of the numbers at every fourth node.
template <class S, int most_nodes>
class NodeSums {
  public:
    LFDSIM_FN void add(int node, const S (&weight)[probes_each], const S (&row)[probes_each][4]) {
        // Teams side by side use different banks of the memory.
        __shared__ S all[block_threads / most_probes][most_probes + 4][4];
        S(*const rows)[4] = all[threadIdx.x / most_probes];
        for (int c = 0; c < 4; ++c) rows[probe_number(0)][c] = weight[0] * row[0][c];
        __syncwarp(team_mask());
        S sum = S(0);
        for (int k = 0; k < most_probes; k += 4) sum = sum + rows[first() + k][number()];
        __syncwarp(team_mask());
        sum = sum + of_pair(sum, 8);
        sum = sum + of_pair(sum, 4);
        for (int k = 0; k < each; ++k)
            if (node == 4 * k + first()) sum_[k] = sum_[k] + sum;
    }
    /// Of so many nodes; false: at one of them all weights are 0.
    LFDSIM_FN bool means(int count, S (*mean)[4]) const {
        bool empty = false;
        for (int k = 0; k < each; ++k) {
            const S weight = __shfl_sync(team_mask(), sum_[k], 4 * first() + 3, most_probes);
            const int node = 4 * k + first();
            if (node >= count) continue;
            empty = empty || weight == S(0);
            if (number() < 3) mean[node][number()] = sum_[k] / weight;
        }
        return !__any_sync(team_mask(), empty);
    }

  private:
    static constexpr int each = (most_nodes + 3) / 4;
    LFDSIM_FN static int first() { return probe_number(0) / 4; }
    LFDSIM_FN static int number() { return probe_number(0) % 4; }
    S sum_[each] = {};
};

#else

LFDSIM_FN int probe_number(int k) { return k; }

template <class S>
LFDSIM_FN S of_probe(const S (&a)[probes_each], int p) {
    return a[p];
}
template <class S>
LFDSIM_FN void set_probe(S (&a)[probes_each], int p, S value) {
    a[p] = value;
}
LFDSIM_FN int first_probe(const bool (&a)[probes_each]) {
    int p = 0;
    while (p + 1 < most_probes && !a[p]) ++p;
    return p;
}
template <class S>
LFDSIM_FN S sum_of(const S (&a)[probes_each]) {
    static_assert(most_probes == 16);
    S b[8], c[4];
    for (int p = 0; p < 8; ++p) b[p] = a[p] + a[p + 8];
    for (int p = 0; p < 4; ++p) c[p] = b[p] + b[p + 4];
    return (c[0] + c[2]) + (c[1] + c[3]);
}
template <class S>
LFDSIM_FN S least_of(const S (&a)[probes_each]) {
    S least = a[0];
    for (int p = 1; p < most_probes; ++p) least = min(least, a[p]);
    return least;
}
template <class S>
class Neighbours {
  public:
    LFDSIM_FN explicit Neighbours(const S (&a)[probes_each]) {
        for (int p = 0; p < most_probes; ++p) padded_[pad + p] = a[p];
    }
    template <class F>
    LFDSIM_FN F at(int p, int step) const {
        return load<F>(padded_ + pad + p + step);
    }

  private:
    static constexpr int pad = 4;  // steps at most
    S padded_[most_probes + 2 * pad] = {};
};

template <class S, int most_nodes>
class NodeSums {
  public:
    LFDSIM_FN void add(int node, const S (&weight)[probes_each], const S (&row)[probes_each][4]) {
        S part[4][4] = {};
        for (int p = 0; p < most_probes; ++p)
            for (int c = 0; c < 4; ++c) part[p % 4][c] = part[p % 4][c] + weight[p] * row[p][c];
        for (int c = 0; c < 4; ++c) sum_[node][c] = sum_[node][c] + ((part[0][c] + part[2][c]) + (part[1][c] + part[3][c]));
    }
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

#endif

}  // namespace lfdsim::optics::inline LFDSIM_ISA
