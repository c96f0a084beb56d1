// Triangles in a file format that all the programs read. Floor 2.
#pragma once
#include "interchange/peers/cell.h"

#include <string>

namespace lfdsim::peers {

/// Stanford's PLY, binary, little endian: x y z nx ny nz as floats, then three 32-bit numbers for each triangle.
std::string ply(const Patch&);

}  // namespace lfdsim::peers
