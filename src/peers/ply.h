// Triangles in a file that every program reads. Floor 2.
#pragma once
#include "peers/cell.h"

#include <string>

namespace lfdsim::peers {

/// Stanford's PLY, binary, little endian: x y z nx ny nz as floats, then three 32-bit numbers a triangle.
std::string ply(const Patch&);

}  // namespace lfdsim::peers
