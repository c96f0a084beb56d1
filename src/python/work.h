// Long work, called from Python. Floor 5.
#pragma once
#include "base/job.h"

#include <nanobind/nanobind.h>

#include <functional>

namespace lfdsim::python {

/// Does the work on a thread of its own, with Python's lock released. This thread waits for it, and every 50 ms lets Python handle
/// signals and calls progress(stage, done, units), unless that is None. If either raises (Ctrl-C: KeyboardInterrupt) the work is
/// cancelled, and the exception goes on once it has ended. Rethrows what the work throws.
void run(const nanobind::object& progress, const std::function<void(Job&)>& work);

}  // namespace lfdsim::python
