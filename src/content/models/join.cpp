#include "content/models/join.h"

#include "content/models/normals.h"
#include "content/models/turn.h"
#include "display/keys.h"
#include "geometry/geometry.h"
#include "geometry/resolve.h"
#include "image/formats/encoding.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace lfdsim {
namespace {

std::string key_of(std::size_t object, const char* key) { return fmt::format("content.object.{}.{}", object, key); }

// Refuses scenes with 2^31 triangles or vertices or more. A file that several objects show is read once, but its mesh is there for
// each; flat triangles have separate vertices.
void check_size(const ContentParts& parts, const std::vector<SceneObject>& objects) {
    double vertices = 0, triangles = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const auto own = double(parts[i]->triangles());
        triangles += own;
        vertices += objects[i].shading == Shading::flat ? 3 * own : double(parts[i]->vertices());
    }
    if (std::max(vertices, triangles) >= two_to_31)
        throw InputError("content.object", fmt::format("the objects together have {:.0f} triangles and {:.0f} vertices, allowed "
                                                       "are 2^31 of each; show fewer or coarser ones",
                                                       triangles, vertices));
}

// Joins one object after the other.
class Joining {
  public:
    explicit Joining(double middle_z_mm) : middle_z_mm_(middle_z_mm) {}

    void add(const Model& read, const SceneObject& object, std::size_t number) {
        Model own;  // only where its normals are replaced
        if (object.shading != Shading::file) {
            own = read;
            object.shading == Shading::flat ? make_flat(own) : make_smooth(own);
        }
        const Model& from = object.shading == Shading::file ? read : own;
        add_surfaces(from, object);
        add_materials(read, object);
        add_files(read);
        add_vertices(from, object, number);
    }
    std::shared_ptr<const Model> model() { return std::make_shared<Model>(std::move(all_)); }

  private:
    // Adds triangles, texture coordinates and vertex colours. Vertices without colour are white once some object has colours.
    void add_surfaces(const Model& from, const SceneObject& object) {
        const auto vertex = std::uint32_t(all_.vertices()), material = std::uint32_t(all_.materials.size());
        for (const std::uint32_t i : from.indices) all_.indices.push_back(vertex + i);
        for (const std::uint32_t i : from.material_of) all_.material_of.push_back(material + (object.colour ? 0 : i));
        all_.uvs.insert(all_.uvs.end(), from.uvs.begin(), from.uvs.end());
        const bool coloured = !from.colours.empty() && !object.colour;
        if (coloured || !all_.colours.empty()) all_.colours.resize(all_.positions.size(), 1.f);
        if (coloured)
            all_.colours.insert(all_.colours.end(), from.colours.begin(), from.colours.end());
        else if (!all_.colours.empty())
            all_.colours.resize(all_.colours.size() + from.positions.size(), 1.f);
    }

    void add_materials(const Model& read, const SceneObject& object) {
        if (object.colour) {
            Material plain;
            for (std::size_t c = 0; c < 3; ++c) plain.colour[c] = float(srgb_to_linear((*object.colour)[c]));
            return all_.materials.push_back(plain);
        }
        // A model that several objects show has its textures once.
        const auto [first, fresh] = textures_of_.try_emplace(&read, std::int32_t(all_.textures.size()));
        if (fresh) all_.textures.insert(all_.textures.end(), read.textures.begin(), read.textures.end());
        for (Material material : read.materials) {
            if (material.texture >= 0) material.texture += first->second;
            all_.materials.push_back(material);
        }
    }

    void add_files(const Model& read) {
        for (const std::string& file : read.files)
            if (std::find(all_.files.begin(), all_.files.end(), file) == all_.files.end()) all_.files.push_back(file);
    }

    // Adds rotated, scaled and moved vertices: k (R p - m) + position, m the middle of the rotated box.
    void add_vertices(const Model& from, const SceneObject& object, std::size_t number) {
        const Turn turn(object.roll_deg, object.tilt_deg, object.yaw_deg);
        PointBounds box, turned;
        for (const std::uint32_t i : from.indices) {
            const float* const p = &from.positions[3 * std::size_t(i)];
            box.add({p[0], p[1], p[2]});
            turned.add(turn(p));
        }
        const double scale = scale_of(object, object.image.empty() ? turned : box, number);
        for (std::size_t k = 0; k < 3; ++k)
            if (const double extent = scale * turned.extent(k); extent > longest_mm)
                throw InputError(key_of(number, "position_mm"),
                                 fmt::format("the object would be {:g} mm long; allowed is {:g} mm", extent, longest_mm));
        for (std::size_t v = 0; v < from.vertices(); ++v) {
            const Vec3d p = turn(&from.positions[3 * v]), n = turn(&from.normals[3 * v]);
            for (std::size_t k = 0; k < 3; ++k) {
                const double place = object.position_mm[k] - (k == 2 ? middle_z_mm_ : 0);
                all_.positions.push_back(float(scale * (p[k] - turned.middle(k)) + place));
                all_.normals.push_back(float(n[k]));
            }
        }
    }

    // Returns k, mm per unit of the file. A model's height or width is that of its rotated box, an image's that before rotation.
    static double scale_of(const SceneObject& object, const PointBounds& box, std::size_t number) {
        if (object.unit_mm) return *object.unit_mm;
        const bool by_height = object.height_mm.has_value();
        const double wanted = by_height ? *object.height_mm : object.width_mm.value_or(0), extent = box.extent(by_height ? 1 : 0);
        if (extent > 0 && std::isfinite(wanted / extent)) return wanted / extent;
        throw InputError(key_of(number, by_height ? "height_mm" : "width_mm"),
                         fmt::format("the model is {} units {} and cannot be scaled to {} mm; turn it with tilt_deg or yaw_deg, or "
                                     "give unit_mm",
                                     extent, by_height ? "high" : "wide", wanted));
    }

    double middle_z_mm_;
    Model all_;
    std::map<const Model*, std::int32_t> textures_of_;  // index of each model's first one
};

}  // namespace

std::shared_ptr<const Model> joined(const ContentParts& parts, const std::vector<SceneObject>& objects) {
    check_size(parts, objects);
    Joining joining(middle_z_mm(objects));
    for (std::size_t i = 0; i < objects.size(); ++i) joining.add(*parts[i], objects[i], i);
    return joining.model();
}

}  // namespace lfdsim
