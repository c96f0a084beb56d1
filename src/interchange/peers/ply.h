// Triangles in a file format that all the programs read. Floor 2.
#pragma once
#include "interchange/peers/cell.h"

#include <string>

namespace lfdsim::peers {

/// Returns a file in Stanford's PLY, binary, little endian: x y z nx ny nz of each vertex as floats, then for each triangle a byte,
/// 3, and three 32-bit numbers.
std::string ply(const Patch&);

}  // namespace lfdsim::peers
