#include "base/large_stack.h"

#include <fmt/format.h>

#include <pthread.h>
#include <sys/resource.h>
#include <csignal>
#include <exception>
#include <stdexcept>

namespace lfdsim {
namespace {

constexpr rlim_t enough_bytes = 1 << 20;    // every kernel is tested on as much
constexpr std::size_t own_bytes = 4 << 20;  // of the thread that takes the place of a stack with less than that

/// Work and its result, handed through pthread_create().
struct StackWork {
    const std::function<int()>& run;
    int result = 0;
    std::exception_ptr thrown = nullptr;
};

}  // namespace

int on_enough_stack(const std::function<int()>& work) {
    rlimit stack{};
    if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur == RLIM_INFINITY || stack.rlim_cur >= enough_bytes) return work();
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, own_bytes);
    // Threads that are started later get as much, too.
    pthread_setattr_default_np(&attributes);
    StackWork all{work};
    pthread_t thread{};
    const auto start = [](void* to) -> void* {
        StackWork& w = *static_cast<StackWork*>(to);
        try {
            w.result = w.run();
        } catch (...) {
            w.thrown = std::current_exception();
        }
        return nullptr;
    };
    const int error = pthread_create(&thread, &attributes, start, &all);
    pthread_attr_destroy(&attributes);
    if (error != 0)
        throw std::runtime_error(
            fmt::format("the stack is limited to {} kB (ulimit -s), which is too little, and no thread with more can be started; "
                        "raise that limit to 1024",
                        stack.rlim_cur >> 10));
    // Signals are handled by the thread that works, since they end what it waits for: this thread blocks them.
    sigset_t every;
    sigfillset(&every);
    pthread_sigmask(SIG_BLOCK, &every, nullptr);
    pthread_join(thread, nullptr);
    if (all.thrown) std::rethrow_exception(all.thrown);
    return all.result;
}

}  // namespace lfdsim
