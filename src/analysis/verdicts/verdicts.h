// Verdicts on a valid display that cannot serve its purpose, by tracing. docs/model.md, "Advice". Floor 3.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <string>
#include <vector>

namespace lfdsim {

/// Returns a text for each design flaw that a few rays reveal, with figures, cause and remedy: views that do not separate, lenses
/// that blur, colours that stay apart. It takes milliseconds.
std::vector<std::string> verdicts(const Display&, const Geometry&, const Theory&);

}  // namespace lfdsim
