#include "content/reader/limits/limits.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <algorithm>
#include <cmath>
#include <csignal>

#if defined(__SANITIZE_ADDRESS__)
#define LFDSIM_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define LFDSIM_ASAN 1
#endif
#endif

namespace lfdsim::reader {
namespace {

// Sets a limit, never above what the system allows already. `grace`: how far the hard limit lies above it.
void limit(__rlimit_resource what, rlim_t value, rlim_t grace = 0) {
    rlimit now{};
    getrlimit(what, &now);
    now = {std::min(value, now.rlim_max), std::min(value + grace, now.rlim_max)};
    setrlimit(what, &now);
}

// The slowest loaders take 1 to 2 microseconds for a byte of a good file, and packed formats hold ten to twenty times as much.
#ifdef LFDSIM_ASAN
constexpr double least_seconds = 30, seconds_per_byte = 2e-4;
#else
constexpr double least_seconds = 2, seconds_per_byte = 2e-5;
#endif

double most_seconds = 0, file_bytes = 0;

}  // namespace

void allow_for(const std::filesystem::path& file) {
    if (most_seconds == 0) return;
    std::error_code none;
    if (const auto bytes = std::filesystem::file_size(file, none); !none) file_bytes += double(bytes);
    // At the soft limit the process gets SIGXCPU, which tells the parent the reason.
    limit(RLIMIT_CPU, rlim_t(std::min(std::ceil(most_seconds), std::floor(least_seconds + seconds_per_byte * file_bytes))),
          rlim_t(1 << 20));
}

void confine(std::int64_t bytes, double seconds) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
#ifndef LFDSIM_ASAN
    limit(RLIMIT_AS, rlim_t(bytes));
#else
    (void)bytes;
#endif
    most_seconds = seconds;
    limit(RLIMIT_CPU, rlim_t(std::ceil(seconds)), 1);
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
}

}  // namespace lfdsim::reader
