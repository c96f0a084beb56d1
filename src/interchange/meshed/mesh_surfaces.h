// Intersections of rays with the triangles of a lens. Floor 2, internal to meshed.
#pragma once
#include "interchange/meshed/lens_mesh.h"
#include "interchange/meshed/render_meshed.h"
#include "optics/opaque_surround.h"

#include <embree3/rtcore.h>

#include <memory>
#include <vector>

namespace lfdsim {

/// The surfaces of one lens as trees of triangles, the viewer's side first, as the tracer counts them.
class MeshSurfaces {
  public:
    MeshSurfaces(const LensMesh&, const Geometry&, LensNormals);

    /// Returns the hit on the first triangle of surface k that the ray's line passes downwards. The ray starts in the surface's
    /// vertex plane; the triangle may lie behind its start. Embree finds the triangle in single precision; point and normal are
    /// computed in double.
    optics::Hit<float> meet(int k, const optics::Ray<float>&) const;

  private:
    struct ReleaseDevice {
        void operator()(RTCDeviceTy* d) const { rtcReleaseDevice(d); }
    };
    struct ReleaseScene {
        void operator()(RTCSceneTy* s) const { rtcReleaseScene(s); }
    };
    struct Triangle {
        const float *corner[3], *normal[3];
    };
    struct MeshSurface {
        std::vector<std::uint32_t> triangles;  // into the lens's vertices; counter-clockwise from the viewer
        std::unique_ptr<RTCSceneTy, ReleaseScene> tree;
        double vertex_z;          // in the mesh's frame
        double middle_z, radius;  // of a ball around it, centred on the axis, in that frame
        bool turned;              // its normals point down in the mesh
        Triangle triangle(const MeshSurfaces&, std::uint32_t number) const;
    };
    MeshSurface surface(std::size_t number, const Geometry&) const;

    LensMesh mesh_;
    LensNormals normals_;
    std::unique_ptr<RTCDeviceTy, ReleaseDevice> device_;
    std::vector<MeshSurface> surfaces_;
};

/// The tracer's input with meshes in place of the surfaces.
struct MeshedScene : optics::TracedDisplay<float> {
    const MeshSurfaces* surfaces;
};

namespace optics {
/// Intersects a ray with the lens's triangles, for trace_opaque<Specialisations::meshed>; the scene must be a MeshedScene.
inline Hit<float> meet_mesh(const TracedDisplay<float>& scene, int k, const Ray<float>& ray) {
    return static_cast<const MeshedScene&>(scene).surfaces->meet(k, ray);
}
}  // namespace optics

}  // namespace lfdsim
