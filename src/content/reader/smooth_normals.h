// Normals of meshes without any. Assimp's own smoothing takes for granted that no faces share a vertex: a shared one would have the
// normal of the last of them. It also takes twenty times as long.
#pragma once
#include <assimp/scene.h>

namespace lfdsim::reader {

/// Gives meshes that have no normals those of smooth surfaces: at each corner of a face the mean of the normals of all faces about
/// that position that differ from the face's own by less than `crease_deg`. Vertices are copied where the corners at them
/// differ; bones and morph targets, which name vertices, are removed. Faces refer to vertices that exist.
void smooth_normals(aiScene& scene, double crease_deg);

}  // namespace lfdsim::reader
