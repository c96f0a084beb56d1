// Triangles as POV-Ray's text. Floor 2.
#pragma once
#include "interchange/peers/cell.h"

#include <string>

namespace lfdsim::peers {

/// Returns a mesh2 without the closing brace, so that a material can be added; `smooth`: with normals at the vertices.
std::string pov_mesh(const Patch&, bool smooth);

}  // namespace lfdsim::peers
