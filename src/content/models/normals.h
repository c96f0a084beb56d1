// New normals for models. Floor 2, internal to content.
#pragma once
#include "content/models/model.h"

namespace lfdsim {

/// Each triangle gets vertices of its own, with the triangle's normal. Triangles without area get none (0, 0, 0).
void make_flat(Model&);

/// Vertices at the same place, whatever their texture coordinates and colours, share the mean normal of the triangles about them,
/// weighted by the angles there, which makes it the same however a face is cut into triangles.
void make_smooth(Model&);

}  // namespace lfdsim
