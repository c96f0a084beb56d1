#include "interchange/meshed/mesh_surfaces.h"

#include "base/free_memory.h"
#include "geometry/vec.h"

#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace lfdsim {
namespace {

Vec3d from_to(const float* a, const float* b) { return {double(b[0]) - a[0], double(b[1]) - a[1], double(b[2]) - a[2]}; }

void check(RTCDevice device) {
    if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
        throw std::runtime_error(error == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory for the ray-tracing structure of the lens"
                                                                  : "Embree cannot build the ray-tracing structure of the lens");
}

}  // namespace

MeshSurfaces::MeshSurfaces(const LensMesh& mesh, const Geometry& geometry, LensNormals normals)
    : mesh_(mesh), normals_(normals), device_(rtcNewDevice(nullptr)) {
    if (!device_) throw std::runtime_error("Embree cannot start; " + free_text(free_memory()));
    mesh_.vertices_mm.push_back(0);  // Embree needs the buffer to be one number longer than the vertices
    for (std::size_t k = geometry.surfaces.size(); k-- > 0;) surfaces_.push_back(surface(k, geometry));
}

MeshSurfaces::MeshSurface MeshSurfaces::surface(std::size_t number, const Geometry& geometry) const {
    MeshSurface s;
    double low = INFINITY, high = -INFINITY, widest2 = 0;
    for (std::size_t t = 0; t < mesh_.count(); ++t) {
        if (mesh_.surface_of[t] != std::int32_t(number)) continue;
        for (std::size_t i = 3 * t; i < 3 * t + 3; ++i) {
            s.triangles.push_back(mesh_.triangles[i]);
            const float* p = &mesh_.vertices_mm[3 * std::size_t(mesh_.triangles[i])];
            low = std::min(low, double(p[2]));
            high = std::max(high, double(p[2]));
            widest2 = std::max(widest2, double(p[0]) * p[0] + double(p[1]) * p[1]);
        }
    }
    s.turned = geometry.surfaces[number].index_below == 1;
    if (s.turned)
        for (std::size_t i = 0; i < s.triangles.size(); i += 3) std::swap(s.triangles[i + 1], s.triangles[i + 2]);
    s.vertex_z = geometry.surfaces[number].z_mm - geometry.base_z_mm;
    s.middle_z = (low + high) / 2;
    s.radius = 1.001 * std::sqrt(widest2 + (high - low) * (high - low) / 4);

    s.tree.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(s.tree.get(), RTC_SCENE_FLAG_ROBUST);  // rays must not fall between triangles with a common edge
    RTCGeometry triangles = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh_.vertices_mm.data(), 0, 12,
                               mesh_.normals.size() / 3);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, s.triangles.data(), 0, 12,
                               s.triangles.size() / 3);
    rtcCommitGeometry(triangles);
    rtcAttachGeometry(s.tree.get(), triangles);
    rtcReleaseGeometry(triangles);
    // One thread builds the tree: with several, the order of its leaves would vary from run to run, and so would the choice between
    // two triangles met in their common edge.
    oneapi::tbb::task_arena alone(1);
    alone.execute([&] { rtcJoinCommitScene(s.tree.get()); });
    check(device_.get());
    return s;
}

MeshSurfaces::Triangle MeshSurfaces::MeshSurface::triangle(const MeshSurfaces& all, std::uint32_t number) const {
    Triangle t;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t vertex = 3 * std::size_t(triangles[3 * std::size_t(number) + i]);
        t.corner[i] = &all.mesh_.vertices_mm[vertex];
        t.normal[i] = &all.mesh_.normals[vertex];
    }
    return t;
}

optics::Hit<float> MeshSurfaces::meet(int k, const optics::Ray<float>& ray) const {
    const MeshSurface& s = surfaces_[std::size_t(k)];
    optics::Hit<float> hit{{ray.at.x, ray.at.y, 0}, {0, 0, 1}, 1, 1, false};
    // Embree's ray begins where the line enters the ball around the surface, so that all its numbers are of the lens's size.
    const Vec3d d{ray.to.x, ray.to.y, ray.to.z}, at{ray.at.x, ray.at.y, s.vertex_z};
    const Vec3d to_middle{-at[0], -at[1], s.middle_z - at[2]};
    const double length2 = dot(d, d), nearest = dot(to_middle, d) / length2;
    const double half2 = s.radius * s.radius - (dot(to_middle, to_middle) - nearest * nearest * length2);
    if (!(half2 > 0)) return hit;
    const double half = std::sqrt(half2 / length2), begin = nearest - half;

    RTCRayHit embree{};
    embree.ray.org_x = float(at[0] + begin * d[0]);
    embree.ray.org_y = float(at[1] + begin * d[1]);
    embree.ray.org_z = float(at[2] + begin * d[2]);
    embree.ray.dir_x = ray.to.x;
    embree.ray.dir_y = ray.to.y;
    embree.ray.dir_z = ray.to.z;
    embree.ray.mask = ~0u;
    // One crossing after the other, until the line passes a triangle downwards
    for (int crossing = 0; crossing < 16; ++crossing) {
        embree.ray.tfar = float(2 * half);
        embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(s.tree.get(), &context, &embree);
        if (embree.hit.geomID == RTC_INVALID_GEOMETRY_ID) return hit;
        const Triangle t = s.triangle(*this, embree.hit.primID);
        const Vec3d a = from_to(t.corner[0], t.corner[1]), b = from_to(t.corner[0], t.corner[2]), plane = cross(a, b);
        const double down = -dot(plane, d);
        if (!(down > 0)) {  // the line comes up through it: continue behind it
            embree.ray.tnear = embree.ray.tfar + float(1e-6 * s.radius);
            continue;
        }
        // Moeller and Trumbore, "Fast, minimum storage ray/triangle intersection", 1997
        const Vec3d p{at[0] - t.corner[0][0], at[1] - t.corner[0][1], at[2] - t.corner[0][2]}, q = cross(p, d);
        const double way = dot(plane, p) / down, u = dot(b, q) / down, v = -dot(a, q) / down;
        Vec3d n = plane;
        if (normals_ == LensNormals::smooth)
            for (std::size_t c = 0; c < 3; ++c)
                n[c] = (s.turned ? -1 : 1) * ((1 - u - v) * t.normal[0][c] + u * t.normal[1][c] + v * t.normal[2][c]);
        const double per = 1 / std::sqrt(dot(n, n)), cosine = -dot(n, d) * per / std::sqrt(length2);
        hit.at = {float(at[0] + way * d[0]), float(at[1] + way * d[1]), float(way * d[2])};
        hit.normal = {float(n[0] * per), float(n[1] * per), float(n[2] * per)};
        hit.cos = float(cosine);
        hit.cos2 = float(cosine * cosine);
        hit.ok = cosine > 0;
        return hit;
    }
    return hit;
}

}  // namespace lfdsim
