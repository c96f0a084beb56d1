// The posing of models, and their ray-tracing structure. docs/model.md, "Pose".

#include "content/pictures/scene.h"

#include "base/free_memory.h"
#include "content/models/join.h"
#include "content/models/memory.h"
#include "content/models/turn.h"
#include "display/keys.h"
#include "engine/devices/memory.h"
#include "geometry/vec.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace lfdsim {
namespace {

/// The scale of a rotated model, and the point of it that becomes the origin.
struct Placing {
    double scale;
    Vec3d origin;  // in the model's units, after rotation
};

// Returns the placing of a single model: the centre of its box, scaled to its height.
Placing of_model(const PointBounds& box, double height_mm) {
    const double extent = box.extent(1), scale = height_mm / extent;
    if (!(extent > 0) || !std::isfinite(scale))
        throw InputError(
            "content.model",
            fmt::format("the model is {} units high and cannot be scaled to {} mm; if it lies flat, raise it with tilt_deg", extent,
                        height_mm));
    return {scale, {box.middle(0), box.middle(1), box.middle(2)}};
}

// Returns the placing of joined objects, which keep their positions and sizes about their common origin unless they are scaled
// together.
Placing of_objects(const PointBounds& box, const std::optional<double>& height_mm) {
    const double scale = height_mm ? *height_mm / box.extent(1) : 1;
    if (!(scale > 0) || !std::isfinite(scale))
        throw InputError("content.height_mm",
                         fmt::format("the objects together are {} mm high and cannot be scaled to {} mm; leave it out",
                                     box.extent(1), height_mm.value_or(0)));
    return {scale, {}};
}

// Rotates, scales and moves the model's vertices, and rotates the light into the model's axes instead of all normals.
void place_model(ContentScene::Impl& scene, const Display& display, const Geometry& geometry) {
    const Model& model = *scene.model;
    const Content& content = display.content;
    const Turn turn(0, content.tilt_deg, content.yaw_deg);
    PointBounds box;
    for (const std::uint32_t i : model.indices) box.add(turn(&model.positions[3 * std::size_t(i)]));
    const bool together = !content.objects.empty();
    const auto [scale, origin] =
        together ? of_objects(box, geometry.content_height_mm) : of_model(box, geometry.content_height_mm.value());
    for (std::size_t k = 0; k < 3; ++k)
        scene.half_mm[k] = together ? scale * std::max(std::abs(box.low[k]), std::abs(box.high[k])) : 0.5 * scale * box.extent(k);
    if (const double longest = 2 * *std::max_element(scene.half_mm.begin(), scene.half_mm.end()); longest > (together ? 4e6 : 1e6))
        throw InputError(
            together ? "content.height_mm" : "content.model",
            fmt::format("{} mm high, {} would be {:g} mm wide or deep; allowed is {}",
                        geometry.content_height_mm.value_or(scale * box.extent(1)), together ? "the objects together" : "the model",
                        longest, together ? "4e6 mm" : "1e6 mm; is it lying flat?"));
    scene.positions_mm.resize(model.positions.size() + 1);
    for (std::size_t v = 0; v < model.vertices(); ++v) {
        const Vec3d p = turn(&model.positions[3 * v]);
        for (std::size_t k = 0; k < 3; ++k) scene.positions_mm[3 * v + k] = float(scale * (p[k] - origin[k]));
    }
    const Vec3d light = normalised(turn.inverse(content.light.direction));
    for (std::size_t k = 0; k < 3; ++k) scene.light[k] = float(light[k]);
    scene.ambient = float(content.light.ambient);
    scene.strength = float(content.light.strength);
}

// Makes the textures' pyramids, and measures texels per mm of each triangle: sqrt(area in texels / area in mm^2).
void measure_textures(ContentScene::Impl& scene) {
    const Model& m = *scene.model;
    std::vector<bool> with_alpha(m.textures.size());
    for (const Material& material : m.materials) {
        if (!material.see_through || material.texture < 0) continue;
        with_alpha[std::size_t(material.texture)] = true;
        scene.see_through = true;
    }
    for (std::size_t i = 0; i < m.textures.size(); ++i) scene.textures.emplace_back(m.textures[i], with_alpha[i]);
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

// Builds Embree's tree over the posed triangles.
void build(ContentScene::Impl& scene) {
    const Model& m = *scene.model;
    scene.device.reset(rtcNewDevice(nullptr));
    if (!scene.device) throw std::runtime_error("Embree cannot start; " + free_text(free_memory()));
    const auto count = [](void* bytes, ssize_t more, bool) {
        *static_cast<std::int64_t*>(bytes) += more;
        return true;
    };
    rtcSetDeviceMemoryMonitorFunction(scene.device.get(), count, &scene.tree_bytes);
    scene.tree.reset(rtcNewScene(scene.device.get()));
    // The robust mode is needed so that rays through shared edges do not pass between the triangles.
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

// Returns a scene's posed model, without textures and tree. Small scenes are made without asking for the memory that is free.
std::shared_ptr<ContentScene::Impl> posed(const ContentParts& parts, const Display& display, const Geometry& geometry) {
    constexpr double small_bytes = 1 << 20;
    if (const double bytes = making_scene_bytes(parts, display); bytes > small_bytes)
        require_memory(model_key(display), making_scene_text(parts), bytes);
    const auto made = std::make_shared<ContentScene::Impl>();
    made->joined = !display.content.objects.empty();
    made->model = made->joined ? joined(parts, display.content.objects) : parts.at(0);
    place_model(*made, display, geometry);
    return made;
}

template <class List>
double bytes_of_list(const List& list) {
    return double(sizeof(typename List::value_type)) * double(list.capacity());
}

}  // namespace

std::string model_key(const Display& display) { return display.content.objects.empty() ? "content.model" : "content.object"; }

std::string making_scene_text(const ContentParts& parts) {
    std::size_t triangles = 0;
    for (const auto& part : parts) triangles += part->triangles();
    return fmt::format("showing {} triangles", triangles);
}

// Lists that grow while objects are joined may have room for twice as much. Embree 3 takes at most 115 bytes per triangle while
// it builds a tree of many triangles, and some blocks for one of few. The means of a texture's texels (content/models/texture.h)
// are a third as many, and twice as long.
double making_scene_bytes(const ContentParts& parts, const Display& display) {
    constexpr double tree_bytes = 160, least_tree_bytes = 1 << 16, growth = 2, mip_levels = 5. / 3;
    constexpr double vertex_bytes = 4 * (3 + 3 + 2 + 3), triangle_bytes = 4 * (3 + 1), posed_bytes = 4 * 3,
                     texture_density_bytes = 4;
    const std::vector<SceneObject>& objects = display.content.objects;
    double bytes = least_tree_bytes;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Model& part = *parts[i];
        const bool flat = !objects.empty() && objects[i].shading == Shading::flat;  // its triangles have separate vertices
        const auto triangles = double(part.triangles());
        const double vertices = flat ? 3 * triangles : double(part.vertices());
        double texels = 0;
        for (const Texture& t : part.textures) texels += double(t.rgba.size());
        bytes += vertices * posed_bytes + triangles * (tree_bytes + texture_density_bytes) + texels * mip_levels;
        if (!objects.empty()) bytes += growth * (vertices * vertex_bytes + triangles * triangle_bytes) + texels;
    }
    return bytes;
}

double bytes_of(const ContentScene& scene) {
    const ContentScene::Impl& it = scene.impl();
    double bytes = bytes_of_list(it.positions_mm) + bytes_of_list(it.texels_per_mm) + double(it.tree_bytes);
    for (const MipMap& texture : it.textures) bytes += texture.bytes();
    return bytes + (it.joined ? double(bytes_of(*it.model)) : 0);
}

void keep(const ContentScene& scene, std::shared_ptr<const void> other) { scene.impl().kept = std::move(other); }

bool has_copies(const ContentScene& scene) { return scene.impl().weak_from_this().use_count() > 1; }

Vec3d half_size_mm(const ContentParts& parts, const Display& display, const Geometry& geometry) {
    return posed(parts, display, geometry)->half_mm;
}

ContentScene::ContentScene(const ContentParts& parts, const Display& display, const Geometry& geometry)
    : vertex_plane_mm_(geometry.vertex_plane_mm), depth_mm_(geometry.content_depth_mm) {
    const auto made = posed(parts, display, geometry);
    measure_textures(*made);
    build(*made);
    impl_ = made;
}

const std::vector<std::string>& ContentScene::files() const { return impl_->model->files; }

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
