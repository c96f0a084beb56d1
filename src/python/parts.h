// The parts of the module lfdsim._core, each in a separate file. Floor 5.
#pragma once
#include "base/input_error.h"

#include <nanobind/nanobind.h>

namespace lfdsim::python {

/// Faults of a display's description, which Python gets as lfdsim.DisplayError; any other InputError becomes lfdsim.InputError.
struct DisplayFault : InputError {
    using InputError::InputError;
};

void add_display(nanobind::module_&);
void add_pictures(nanobind::module_&);
void add_photographs(nanobind::module_&);
void add_analyze(nanobind::module_&);

}  // namespace lfdsim::python
