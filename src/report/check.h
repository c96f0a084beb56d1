// What follows from a description: for scripts, and what is worth knowing of it. Floor 4.
#pragma once
#include "analysis/result.h"
#include "model/display.h"
#include "model/geometry.h"

#include <string>
#include <vector>

namespace lfdsim {

/// The advice on a display, with what only its content's files say (their size, or that they cannot be read), and doubts of its
/// glasses.
std::vector<std::string> worth_knowing(const Display&, const Geometry&, const Theory&);

/// Every key, every length, the theory, why figures are undefined, and what is worth knowing: what `lfdsim check --json` prints.
/// Names in it are fixed: scripts use them. Throws InputError for a display that is not valid.
Json check_json(const Display&);

}  // namespace lfdsim
