#include "content/reader/limits.h"

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

// Never above what the system allows already. `grace`: how much more before the limit is hard.
void limit(__rlimit_resource what, rlim_t value, rlim_t grace = 0) {
    rlimit now{};
    getrlimit(what, &now);
    now = {std::min(value, now.rlim_max), std::min(value + grace, now.rlim_max)};
    setrlimit(what, &now);
}

}  // namespace

void confine(std::int64_t bytes, double seconds) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
#ifndef LFDSIM_ASAN
    limit(RLIMIT_AS, rlim_t(bytes));
#else
    (void)bytes;
#endif
    limit(RLIMIT_CPU, rlim_t(std::ceil(seconds)), 1);  // first SIGXCPU, which says why
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_FSIZE, 0);
}

}  // namespace lfdsim::reader
