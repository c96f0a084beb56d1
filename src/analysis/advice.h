// What is possible but perhaps not meant: a valid display that may disappoint. Floor 3.
#pragma once
#include "model/display.h"
#include "model/geometry.h"

#include <string>
#include <vector>

namespace lfdsim {

/// A sentence for each. The display must be valid.
std::vector<std::string> advice(const Display&, const Geometry&, const Theory&);

}  // namespace lfdsim
