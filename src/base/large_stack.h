// A stack that is large enough, whatever the shell's limit. Floor 0.
#pragma once
#include <functional>

namespace lfdsim {

/// Does the work, where the stack that a process is given (`ulimit -s`) is too small for it on one of its own, and has threads that
/// start later get as much. Throws what the work throws, and std::runtime_error where no such thread can be started.
int on_enough_stack(const std::function<int()>& work);

}  // namespace lfdsim
