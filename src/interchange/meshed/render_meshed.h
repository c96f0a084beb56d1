// Pictures of a display whose lenses are made of triangles. Floor 2.
#pragma once
#include "engine/render.h"

#include <cstdint>
#include <memory>

namespace lfdsim {

/// The normals at a triangle's points: that of its plane, or those of the true surface at its corners, interpolated.
enum class LensNormals { flat, smooth };

class MeshSurfaces;

/// A lens as mesh_lens() makes it, ready for rays of any camera.
class MeshedLens {
  public:
    /// Throws InputError as mesh_lens() does, for surrounds other than opaque, for lattices other than rows and columns, for
    /// dispersion, layers and glued lenses, and for errors of single lenses, a bow or a wedge.
    MeshedLens(const Display&, const Geometry&, std::int64_t triangles, LensNormals);
    std::int64_t triangles() const { return triangles_; }  // their number, in all its parts
    const MeshSurfaces& surfaces() const { return *surfaces_; }

  private:
    std::int64_t triangles_;
    std::shared_ptr<const MeshSurfaces> surfaces_;
};

/// Renders like render() with the estimator "point", sample by sample: the same rays and rules, but with triangles in place of
/// the surfaces. The lens is that of the display. The bits are the same with any number of threads and any crop; the choice of
/// kernel has no effect.
Rendering render_meshed(const Display&, const Geometry&, const Texels& panel, const MeshedLens&, const RenderOptions&, Job&);

}  // namespace lfdsim
