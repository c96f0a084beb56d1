// Long work that Python calls and can interrupt. Floor 5.
#pragma once
#include "base/job.h"

#include <nanobind/nanobind.h>

#include <functional>

namespace lfdsim::python {

/// Does the work on a new thread, with Python's lock released. The calling thread waits for it, and every 50 ms lets Python handle
/// signals and calls progress(stage, done, units), unless that is None. If either raises (Ctrl-C: KeyboardInterrupt) the work is
/// cancelled, and the exception is rethrown after the work has ended. Rethrows what the work throws. The work must not use Python's
/// objects.
void run(const nanobind::object& progress, const std::function<void(Job&)>& work);

}  // namespace lfdsim::python
