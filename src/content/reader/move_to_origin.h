// Scenes as Assimp has loaded them, in floats, far from their origins.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <assimp/scene.h>

namespace lfdsim::reader {

/// Moves a scene to the origin before its nodes' transformations are applied in floats, where it lies far from there, and notes
/// what floats have rounded already.
void move_to_origin(aiScene&, NotShown&);

}  // namespace lfdsim::reader
