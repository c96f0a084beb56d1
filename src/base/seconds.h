// Durations of work. Floor 0.
#pragma once
#include <chrono>

namespace lfdsim {

/// Returns the seconds that have passed since a time.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace lfdsim
