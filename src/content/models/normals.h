// New normals for models. Floor 2, internal to content.
#pragma once
#include "content/models/model.h"

namespace lfdsim {

/// Gives each triangle separate vertices with the triangle's normal; triangles without area get (0, 0, 0).
void make_flat(Model&);

/// Gives vertices at the same position, whatever their texture coordinates and colours, the mean normal of the triangles about
/// them, weighted by the angles there: the result does not depend on how a face is cut into triangles.
void make_smooth(Model&);

}  // namespace lfdsim
