// The parts of the module lfdsim._core, each in a file of its own. Floor 5.
#pragma once
#include "base/input_error.h"

#include <nanobind/nanobind.h>

namespace lfdsim::python {

/// What is wrong with a display's description: lfdsim.DisplayError. Any other InputError is lfdsim.InputError.
struct DisplayFault : InputError {
    using InputError::InputError;
};

void add_display(nanobind::module_&);
void add_pictures(nanobind::module_&);
void add_photographs(nanobind::module_&);
void add_analyze(nanobind::module_&);

}  // namespace lfdsim::python
