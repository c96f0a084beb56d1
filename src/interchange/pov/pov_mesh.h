// Triangles as POV-Ray's text. Floor 2.
#pragma once
#include "interchange/peers/cell.h"

#include <string>

namespace lfdsim::peers {

/// A mesh2 without the closing brace, so that a material can be added.
std::string pov_mesh(const Patch&, bool smooth);

}  // namespace lfdsim::peers
