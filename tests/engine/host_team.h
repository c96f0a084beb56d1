// The threads of a GPU's team (optics/probe_team.h) on the host: what they call to exchange numbers, by fibers that take turns.
#pragma once
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace lfdsim::host_team {

constexpr int threads = 16;

/// Runs work(0), work(1), ... work(threads - 1) as a team, the first as thread number `first` of its thread block.
void run(unsigned first, void (*work)(const void* with, int thread), const void* with);

/// Shows a number to the team. All of it must come to the same place, `what`; a team that parts ends the program.
void show(const char* what, std::uint32_t bits);
/// That of a thread, after all have shown theirs.
std::uint32_t shown_by(int thread);
int own_number();

template <class T>
std::uint32_t bits_of(T value) {
    std::uint32_t bits = 0;
    static_assert(sizeof value <= sizeof bits);
    std::memcpy(&bits, &value, sizeof value);
    return bits;
}
template <class T>
T shown(int thread) {
    const std::uint32_t bits = shown_by(thread);
    T value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

}  // namespace lfdsim::host_team

// CUDA's names.
struct ThreadIndex {
    unsigned x;
};
extern thread_local ThreadIndex threadIdx;

template <class T>
T __shfl_sync(unsigned, T value, int from, int) {
    lfdsim::host_team::show("shfl", lfdsim::host_team::bits_of(value));
    return lfdsim::host_team::shown<T>(from & (lfdsim::host_team::threads - 1));
}
template <class T>
T __shfl_xor_sync(unsigned, T value, int distance, int) {
    lfdsim::host_team::show("shfl_xor", lfdsim::host_team::bits_of(value));
    return lfdsim::host_team::shown<T>(lfdsim::host_team::own_number() ^ distance);
}
inline unsigned __ballot_sync(unsigned, bool value) {
    lfdsim::host_team::show("ballot", value);
    unsigned all = 0;
    for (int k = 0; k < lfdsim::host_team::threads; ++k) all |= lfdsim::host_team::shown_by(k) << k;
    return all << (threadIdx.x & 16u);
}
inline bool __any_sync(unsigned mask, bool value) { return __ballot_sync(mask, value) != 0; }
inline void __syncwarp(unsigned) { lfdsim::host_team::show("syncwarp", 0); }
#define __shared__ static
