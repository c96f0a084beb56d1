// Scenes that Assimp has loaded in floats, far from their origins or of extreme sizes.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <assimp/scene.h>

namespace lfdsim::reader {

/// Moves a scene that lies far from its origin there, before its nodes' transformations are applied in floats, and notes what
/// floats have already rounded. Multiplies all positions by a power of two, by BoxMiddle::exponent() of what is shown, and returns
/// its exponent.
int fit_to_floats(aiScene&, NotShown&);

}  // namespace lfdsim::reader
