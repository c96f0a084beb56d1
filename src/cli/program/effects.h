// The rules for options that have no effect beside another one, or without one. Floor 5.
#pragma once
#include "cli/program/command.h"

namespace lfdsim::cli {

/// Throws InputError for each option given that could change nothing, with the option that is the reason. Keys that --set or the
/// description gives are not checked: they are properties of the display, whatever is done with it.
void check_effects(const Command&);

}  // namespace lfdsim::cli
