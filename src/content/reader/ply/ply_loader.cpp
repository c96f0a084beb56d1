#include "content/reader/ply/ply_loader.h"

#include "base/counted.h"
#include "content/reader/limits/whole_file.h"
#include "content/reader/places.h"
#include "content/reader/ply/ply_file.h"

#include <assimp/importerdesc.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>

namespace lfdsim::reader {
namespace {

/// Two or three numbers of an element's rows, by the names that programs give them.
struct Columns {
    std::vector<const PlyProperty*> all;  // empty if one of them is missing

    Columns() = default;
    Columns(const PlyElement& element, std::initializer_list<std::initializer_list<std::string_view>> names) {
        for (const auto& of_one : names) all.push_back(element.find(of_one));
        if (std::any_of(all.begin(), all.end(), [](const PlyProperty* p) { return !p || p->is_list; })) all.clear();
    }
    explicit operator bool() const { return !all.empty(); }
    double of(std::size_t column, std::size_t row) const { return *all[column]->row(row); }
    float colour(std::size_t column, std::size_t row) const { return float(of(column, row) / all[column]->unit); }
};

Columns colours_of(const PlyElement& element) {
    return {element, {{"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"}, {"blue", "b", "diffuse_blue"}}};
}

/// A corner of a polygon.
struct Corner {
    std::size_t vertex, face;
    const double* uv;  // the corner's texture coordinates, or null
};

/// A mesh of polygons with one texture.
struct Polygons {
    std::vector<Corner> corners;
    std::vector<std::size_t> sizes;  // corners of each polygon
};

/// The conversion of a file's elements to Assimp's meshes, one for each texture.
class Reading {
  public:
    Reading(const PlyFile& file, NotShown& not_shown) : file_(file), not_shown_(not_shown) {
        const PlyElement* const vertices = file.find("vertex");
        if (!vertices) throw std::runtime_error("has no vertices");
        vertices_ = vertices;
        place_ = Columns(*vertices, {{"x"}, {"y"}, {"z"}});
        normal_ = Columns(*vertices, {{"nx"}, {"ny"}, {"nz"}});
        uv_ = Columns(*vertices, {{"s", "u", "texture_u", "tx"}, {"t", "v", "texture_v", "ty"}});
        colour_ = colours_of(*vertices);
        if (!place_) throw std::runtime_error("its vertices have no x, y and z");
    }

    void fill(aiScene& scene) {
        if (const PlyElement* faces = file_.find("face")) add_faces(*faces);
        if (const PlyElement* strips = file_.find("tristrips")) add_strips(*strips);
        for (const PlyElement& element : file_.elements)
            if (element.count > 0 &&
                (element.name == "edge" || element.name == "material" || element.name.starts_with("multi_texture")))
                not_shown_.add("its elements \"" + element.name + "\"");
        if (meshes_.empty()) throw std::runtime_error("has no triangles: nothing to show");
        for (std::size_t row = 0; row < vertices_->count; ++row) middle_.add(place(row));
        offset_ = middle_.offset();
        // Each texture gets a mesh and a material of the same index.
        scene.mRootNode = new aiNode("scene");
        scene.mRootNode->mMeshes = new unsigned[meshes_.size()];
        scene.mMeshes = new aiMesh* [meshes_.size()] {};
        scene.mMaterials = new aiMaterial* [meshes_.size()] {};
        for (const auto& [texture, polygons] : meshes_) {
            scene.mMaterials[scene.mNumMaterials++] = material(texture).release();
            scene.mRootNode->mMeshes[scene.mRootNode->mNumMeshes++] = scene.mNumMeshes;
            auto made = mesh(polygons);
            made->mMaterialIndex = scene.mNumMeshes;
            scene.mMeshes[scene.mNumMeshes++] = made.release();
        }
    }

  private:
    Place place(std::size_t row) const { return {place_.of(0, row), place_.of(1, row), place_.of(2, row)}; }

    std::size_t vertex(double number) const {
        if (!(number >= 0 && number < double(vertices_->count)))
            throw std::runtime_error("some faces have indices of vertices that do not exist; the file is damaged, export it again");
        return std::size_t(number);
    }

    // Returns a texture's number; all that do not exist count as one more.
    std::size_t texture_of(double number) const {
        return number >= 0 && number < double(file_.textures.size()) ? std::size_t(number) : file_.textures.size();
    }

    void add_faces(const PlyElement& faces) {
        const PlyProperty* const indices = faces.find({"vertex_indices", "vertex_index"});
        const PlyProperty* const uvs = faces.find({"texcoord"});
        const PlyProperty* const texture = faces.find({"texnumber"});
        face_colour_ = colours_of(faces);
        if (face_colour_ && colour_) {  // one of them can be shown
            not_shown_.add("colours of faces beside those of vertices");
            face_colour_ = {};
        }
        for (std::size_t f = 0; indices && f < faces.count; ++f) {
            const std::size_t size = indices->size(f);
            if (size < 3) {
                not_shown_.add("points and lines");
                continue;
            }
            Polygons& to = meshes_[texture && !texture->is_list ? texture_of(*texture->row(f)) : 0];
            const bool own_uvs = uvs && uvs->is_list && uvs->size(f) == 2 * size;
            if (uvs && !own_uvs && uvs->size(f) > 0) not_shown_.add("texture coordinates of some faces");
            for (std::size_t k = 0; k < size; ++k)
                to.corners.push_back({vertex(indices->row(f)[k]), f, own_uvs ? uvs->row(f) + 2 * k : nullptr});
            to.sizes.push_back(size);
            own_uvs_ = own_uvs_ || own_uvs;
        }
    }

    // Adds the triangles of strips: every vertex makes one with the two before it, in alternating order; -1 begins a new strip.
    void add_strips(const PlyElement& strips) {
        const PlyProperty* const indices = strips.find({"vertex_indices", "vertex_index"});
        for (std::size_t s = 0; indices && s < strips.count; ++s) {
            const double* const row = indices->row(s);
            std::size_t start = 0;
            for (std::size_t k = 0; k < indices->size(s); ++k) {
                if (row[k] < 0) start = k + 1;
                if (k < start + 2) continue;
                const std::size_t odd = (k - start) % 2, a = vertex(row[k - 2]), b = vertex(row[k - 1]), c = vertex(row[k]);
                if (a == b || b == c || a == c) continue;  // how strips are joined
                for (const std::size_t v : {odd ? b : a, odd ? a : b, c}) meshes_[0].corners.push_back({v, 0, nullptr});
                meshes_[0].sizes.push_back(3);
            }
        }
        if (face_colour_ && indices && strips.count > 0) {  // strips have none
            not_shown_.add("colours of faces beside strips");
            face_colour_ = {};
        }
    }

    std::unique_ptr<aiMaterial> material(std::size_t texture) const {
        auto made = std::make_unique<aiMaterial>();
        const aiColor4D white(1, 1, 1, 1);
        made->AddProperty(&white, 1, AI_MATKEY_COLOR_DIFFUSE);
        const bool coloured = colour_ || face_colour_, on_surface = uv_ || own_uvs_;
        if (texture < file_.textures.size() && coloured && !on_surface)
            not_shown_.add("textures of a PLY file without texture coordinates");
        else if (texture < file_.textures.size()) {
            const aiString name(file_.textures[texture]);
            made->AddProperty(&name, AI_MATKEY_TEXTURE_DIFFUSE(0));
        }
        return made;
    }

    // Returns Assimp's mesh. If corners have texture coordinates or faces have colours, or if there are several textures, every
    // corner becomes a vertex.
    std::unique_ptr<aiMesh> mesh(const Polygons& from) const {
        const bool own = own_uvs_ || face_colour_ || meshes_.size() > 1;
        const std::size_t count = own ? from.corners.size() : vertices_->count;
        if (count >= std::size_t(1) << 32) throw std::runtime_error("has more than 2^32 corners");
        auto made = std::make_unique<aiMesh>();
        made->mNumVertices = unsigned(count);
        made->mVertices = new aiVector3D[count];
        if (normal_) made->mNormals = new aiVector3D[count];
        if (uv_ || own_uvs_) made->mTextureCoords[0] = new aiVector3D[count];
        if (uv_ || own_uvs_) made->mNumUVComponents[0] = 2;
        if (colour_ || face_colour_) made->mColors[0] = new aiColor4D[count];
        for (std::size_t i = 0; i < count; ++i) {
            const auto [v, face, own_uv] = own ? from.corners[i] : Corner{i, 0, nullptr};
            made->mVertices[i] = to_float(place(v) - offset_);
            if (normal_) made->mNormals[i] = {float(normal_.of(0, v)), float(normal_.of(1, v)), float(normal_.of(2, v))};
            if (own_uv)
                made->mTextureCoords[0][i] = {float(own_uv[0]), float(own_uv[1]), 0};
            else if (uv_)
                made->mTextureCoords[0][i] = {float(uv_.of(0, v)), float(uv_.of(1, v)), 0};
            const Columns& colour = colour_ ? colour_ : face_colour_;
            const std::size_t row = colour_ ? v : face;
            if (colour) made->mColors[0][i] = {colour.colour(0, row), colour.colour(1, row), colour.colour(2, row), 1};
        }
        made->mNumFaces = unsigned(from.sizes.size());
        made->mFaces = new aiFace[from.sizes.size()];
        std::size_t next = 0;
        for (std::size_t f = 0; f < from.sizes.size(); ++f) {
            aiFace& face = made->mFaces[f];
            face.mNumIndices = unsigned(from.sizes[f]);
            face.mIndices = new unsigned[from.sizes[f]];
            for (unsigned k = 0; k < face.mNumIndices; ++k, ++next)
                face.mIndices[k] = unsigned(own ? next : from.corners[next].vertex);
        }
        return made;
    }

    const PlyFile& file_;
    NotShown& not_shown_;
    const PlyElement* vertices_;
    Columns place_, normal_, uv_, colour_, face_colour_;
    bool own_uvs_ = false;
    std::map<std::size_t, Polygons> meshes_;  // by their textures' numbers
    BoxMiddle middle_;
    Place offset_;
};

}  // namespace

void read_ply(std::string_view bytes, aiScene& scene, NotShown& not_shown) {
    PlyFile file(bytes);
    const auto has = [&](const char* name) { return file.find(name) && file.find(name)->count > 0; };
    if (has("vertex") && !has("face") && !has("tristrips"))
        throw std::runtime_error("holds " + counted(file.find("vertex")->count, "point") +
                                 " and no triangles; point clouds and Gaussian splats are not shown");
    file.read();
    Reading(file, not_shown).fill(scene);
}

bool PlyLoader::CanRead(const std::string& file, Assimp::IOSystem* io, bool) const {
    return CheckMagicToken(io, file, "ply", 1, 0, 3) || SimpleExtensionCheck(file, "ply");
}

const aiImporterDesc* PlyLoader::GetInfo() const {
    static const aiImporterDesc info{name, "", "", "", aiImporterFlags_SupportTextFlavour | aiImporterFlags_SupportBinaryFlavour,
                                     0,    0,  0,  0,  "ply"};
    return &info;
}

void PlyLoader::InternReadFile(const std::string& file, aiScene* scene, Assimp::IOSystem* io) {
    const auto bytes = whole_file(*io, file);
    if (!bytes) throw std::runtime_error("it cannot be opened");
    if (!bytes->starts_with("ply")) throw std::runtime_error("it does not begin like a PLY file");
    read_ply(*bytes, *scene, not_shown_);
}

}  // namespace lfdsim::reader
