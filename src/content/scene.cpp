#include "content/scene.h"
#include "model/keys.h"
#include "model/numbers.h"
#include "model/vec.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

struct Box {
    Vec3d low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    void add(const Vec3d& p) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
};

// Tilt about x (positive raises the front, +z towards +y), then yaw about +y, counter-clockwise seen from above (the front goes
// towards +x).
struct Turn {
    double ct, st, cy, sy;
    explicit Turn(const Content& c)
        : ct(std::cos(c.tilt_deg * degree)),
          st(std::sin(c.tilt_deg * degree)),
          cy(std::cos(c.yaw_deg * degree)),
          sy(std::sin(c.yaw_deg * degree)) {}
    Vec3d operator()(const float* p) const {
        const double y = ct * p[1] + st * p[2], z = ct * p[2] - st * p[1];
        return {cy * p[0] + sy * z, y, cy * z - sy * p[0]};
    }
    Vec3d inverse(const Vec3d& p) const {
        const double z = cy * p[2] + sy * p[0];
        return {cy * p[0] - sy * p[2], ct * p[1] - st * z, ct * z + st * p[1]};
    }
};

void pose(ContentScene::Impl& scene, const Display& display, const Geometry& geometry) {
    const Model& model = *scene.model;
    const Turn turn(display.content);
    Box box;
    for (const std::uint32_t i : model.indices) box.add(turn(&model.positions[3 * std::size_t(i)]));
    const double extent = box.high[1] - box.low[1];
    const double scale = geometry.content_height_mm / extent;
    if (!(extent > 0) || !std::isfinite(scale))
        throw InputError(
            "content.model",
            fmt::format("the model is {} units high and cannot be scaled to {} mm; if it lies flat, raise it with tilt_deg", extent,
                        geometry.content_height_mm));
    for (int k = 0; k < 3; ++k) scene.half_mm[k] = 0.5 * scale * (box.high[k] - box.low[k]);
    if (const double longest = 2 * *std::max_element(scene.half_mm.begin(), scene.half_mm.end()); longest > 1e6)
        throw InputError("content.model",
                         fmt::format("{} mm high, the model would be {:g} mm wide or deep; allowed is 1e6 mm; is it lying flat?",
                                     geometry.content_height_mm, longest));
    scene.positions_mm.resize(model.positions.size() + 1);
    for (std::size_t v = 0; v < model.vertices(); ++v) {
        const Vec3d p = turn(&model.positions[3 * v]);
        for (int k = 0; k < 3; ++k) scene.positions_mm[3 * v + k] = float(scale * (p[k] - 0.5 * (box.low[k] + box.high[k])));
    }
    const Vec3d light = normalised(turn.inverse({0.3, 0.5, 0.81}));
    for (int k = 0; k < 3; ++k) scene.light[k] = float(light[k]);
}

// Texels per millimetre: the square root of (area in texels / area in mm^2).
void measure_textures(ContentScene::Impl& scene) {
    const Model& m = *scene.model;
    for (const Texture& t : m.textures) scene.textures.emplace_back(t);
    if (m.textures.empty()) return;
    scene.texels_per_mm.resize(m.triangles());
    for (std::size_t t = 0; t < m.triangles(); ++t) {
        const Material& material = m.materials[m.material_of[t]];
        if (material.texture < 0) continue;
        const Texture& texture = m.textures[std::size_t(material.texture)];
        Vec3d e[2];
        double s[2][2];
        for (int k = 0; k < 2; ++k) {
            const std::size_t a = m.indices[3 * t], b = m.indices[3 * t + 1 + k];
            for (int c = 0; c < 3; ++c) e[k][c] = double(scene.positions_mm[3 * b + c]) - scene.positions_mm[3 * a + c];
            for (int c = 0; c < 2; ++c) s[k][c] = double(m.uvs[2 * b + c]) - m.uvs[2 * a + c];
        }
        const double area = length(cross(e[0], e[1]));
        const double texels = std::abs(s[0][0] * s[1][1] - s[0][1] * s[1][0]) * texture.width * texture.height;
        scene.texels_per_mm[t] = area > 0 ? float(std::sqrt(texels / area)) : 0;
    }
}

void build(ContentScene::Impl& scene) {
    const Model& m = *scene.model;
    scene.device.reset(rtcNewDevice(nullptr));
    if (!scene.device) throw std::runtime_error("Embree cannot start");
    scene.tree.reset(rtcNewScene(scene.device.get()));
    // Robust: rays through shared edges must not fall between the triangles.
    rtcSetSceneFlags(scene.tree.get(), RTC_SCENE_FLAG_ROBUST);
    RTCGeometry mesh = rtcNewGeometry(scene.device.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, scene.positions_mm.data(), 0, 12, m.vertices());
    rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m.indices.data(), 0, 12, m.triangles());
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(scene.tree.get(), mesh);
    rtcReleaseGeometry(mesh);
    // One thread builds the tree: several would order its leaves by chance, and coincident surfaces could change places.
    tbb::task_arena alone(1);
    alone.execute([&] { rtcJoinCommitScene(scene.tree.get()); });
    if (const RTCError error = rtcGetDeviceError(scene.device.get()); error != RTC_ERROR_NONE)
        throw std::runtime_error(error == RTC_ERROR_OUT_OF_MEMORY ? "not enough memory for the ray-tracing structure of the model"
                                                                  : "Embree cannot build the ray-tracing structure of the model");
}

}  // namespace

ContentScene::ContentScene(std::shared_ptr<const Model> model, const Display& display, const Geometry& geometry)
    : vertex_plane_mm_(geometry.vertex_plane_mm), depth_mm_(geometry.content_depth_mm) {
    const auto made = std::make_shared<Impl>();
    made->model = std::move(model);
    pose(*made, display, geometry);
    measure_textures(*made);
    build(*made);
    impl_ = made;
}

Vec3d ContentScene::half_size_mm() const { return impl_->half_mm; }

ContentScene ContentScene::before(const Geometry& geometry) const {
    ContentScene moved = *this;
    moved.vertex_plane_mm_ = geometry.vertex_plane_mm;
    moved.depth_mm_ = geometry.content_depth_mm;
    return moved;
}

ContentScene ContentScene::at_depth(double depth_mm) const {
    if (!any_length.contains(depth_mm))
        throw InputError("content.depth_mm", fmt::format("is {}, allowed is {}", depth_mm, any_length.text()));
    ContentScene moved = *this;
    moved.depth_mm_ = depth_mm;
    return moved;
}

}  // namespace lfdsim
