// Options that have no effect: beside another one, or without one. Floor 5.
#pragma once
#include "cli/program/command.h"

namespace lfdsim::cli {

/// Throws InputError for each option given that could change nothing, with the option that is why. What --set and the description
/// say is not looked at: they hold for a display, whatever is done with it.
void check_effects(const Command&);

}  // namespace lfdsim::cli
