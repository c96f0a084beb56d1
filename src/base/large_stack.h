// A stack that is large enough, whatever the shell's limit. Floor 0.
#pragma once
#include <functional>

namespace lfdsim {

/// Does the work and returns its result. Where the stack limit (`ulimit -s`) is below 1 MiB, it runs on a new thread with a
/// larger stack, and threads that are started later get as much. Throws what the work throws, and std::runtime_error if no such
/// thread can be started.
int on_enough_stack(const std::function<int()>& work);

}  // namespace lfdsim
