// Scenes that Assimp has loaded in floats, far from their origins.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <assimp/scene.h>

namespace lfdsim::reader {

/// Moves a scene that lies far from its origin there, before its nodes' transformations are applied in floats, and notes what
/// floats have already rounded.
void move_to_origin(aiScene&, NotShown&);

}  // namespace lfdsim::reader
