// Model files by Assimp, with this program's loaders for glTF 2.0 and PLY: reading, repairs, and conversion to a Model.

#include "content/reader/import.h"

#include "base/counted.h"
#include "base/text.h"
#include "content/reader/axes.h"
#include "content/reader/colours_3mf.h"
#include "content/reader/fit_to_floats.h"
#include "content/reader/gltf/gltf_loader.h"
#include "content/reader/limits/edited_text.h"
#include "content/reader/limits/folder.h"
#include "content/reader/limits/not_shown.h"
#include "content/reader/limits/refusal.h"
#include "content/reader/limits/warnings.h"
#include "content/reader/limits/whole_file.h"
#include "content/reader/ply/ply_loader.h"
#include "content/reader/repairs.h"
#include "content/reader/smooth_normals.h"
#include "content/reader/textures.h"
#include "image/formats/encoding.h"

#include <assimp/GltfMaterial.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace lfdsim::reader {
namespace {

// A fold sharper than this, in degrees, remains an edge if the file has no normals.
constexpr double crease_deg = 60;

// Post-processing gives triangles in one frame: node transforms are applied, instances copied, points and lines removed.
constexpr unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_PreTransformVertices | aiProcess_GenUVCoords |
                           aiProcess_TransformUVCoords;
constexpr float grey = 0.5f;  // linear light of surfaces that cannot be shown as they are

Wrap wrap(aiTextureMapMode mode) {
    switch (mode) {
        case aiTextureMapMode_Clamp:
        case aiTextureMapMode_Decal:
            return Wrap::clamp;
        case aiTextureMapMode_Mirror:
            return Wrap::mirror;
        default:
            return Wrap::repeat;
    }
}

// Returns whether a material emits light.
bool shines(const aiMaterial& material) {
    aiColor4D light(0, 0, 0, 0);
    material.Get(AI_MATKEY_COLOR_EMISSIVE, light);
    return light.r > 0 || light.g > 0 || light.b > 0;
}

// The conversion of Assimp's meshes and materials to a Model.
class Conversion {
  public:
    Conversion(const aiScene& scene, const Folder& folder, const std::string& format, const AxesTurn& turn,
               const std::map<std::string, Tiling>& tilings, const NotShown& not_shown)
        : scene_(scene), textures_(scene, folder), turn_(turn), tilings_(tilings), left_out_(not_shown) {
        linear_ = format.starts_with("glTF");
    }

    // Converts all meshes. Throws std::runtime_error if there are no triangles.
    Model run() {
        for (unsigned m = 0; m < scene_.mNumMeshes; ++m) add(*scene_.mMeshes[m]);
        model_.textures = std::move(textures_.textures);
        model_.files = std::move(textures_.files);
        const std::vector<std::string> notes = textures_.notes();
        model_.notes.insert(model_.notes.end(), notes.begin(), notes.end());
        if (dropped_ > 0) model_.notes.push_back(counted(dropped_, "face") + " left out: degenerate");
        if (!linear_ && std::any_of(model_.textures.begin(), model_.textures.end(), has_alpha)) transparent_ = true;
        if (transparent_) model_.notes.push_back("transparent materials are shown opaque");
        if (out_of_range_) left_out_.add("colours that are not numbers from 0 to 1");
        const std::vector<std::string> left_out = left_out_.notes();
        model_.notes.insert(model_.notes.end(), left_out.begin(), left_out.end());
        show_black();
        if (model_.indices.empty()) throw std::runtime_error(no_triangles(left_out_));
        return std::move(model_);
    }

  private:
    // Returns whether a mesh has vertex colours. Some loaders (Blender's) give colours, all black, if the file has none.
    bool coloured(const aiMesh& mesh) const {
        if (!mesh.HasVertexColors(0)) return false;
        const aiColor4D* first = mesh.mColors[0];
        return linear_ ||
               std::any_of(first, first + mesh.mNumVertices, [](const aiColor4D& c) { return c.r > 0 || c.g > 0 || c.b > 0; });
    }

    // Returns a component of a colour of the file in linear light, 0 to 1; others are noted, but for what rounding may add.
    float light(float colour) {
        if (!(colour >= 0 && colour < 1.001f)) out_of_range_ = true;
        const double c = std::isfinite(colour) ? std::clamp(double(colour), 0., 1.) : 0;
        return float(linear_ ? c : srgb_to_linear(c));
    }

    // Returns the index of a mesh's material, and in `channel` the texture coordinates that it uses. glTF's colours are factors
    // in linear light, multiplied with texture and vertex colours. In other formats a colour is meant for a screen (sRGB), and a
    // texture or vertex colours replace it: formats and exporters differ in what they multiply, and loaders fill in greys of
    // their own.
    std::uint32_t material(const aiMesh& mesh, int& channel) {
        const auto key = std::tuple(mesh.mMaterialIndex, mesh.HasTextureCoords(0), coloured(mesh));
        const aiMaterial& from = *scene_.mMaterials[mesh.mMaterialIndex];
        // The texture is that of the base colour (glTF), else that of the diffuse colour.
        Material to;
        aiString name;
        unsigned uv = 0;
        aiTextureMapMode modes[2] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
        bool wants_texture = false;
        for (const aiTextureType type : {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}) {
            if (to.texture >= 0) break;
            if (from.GetTexture(type, 0, &name, nullptr, &uv, nullptr, nullptr, modes) != aiReturn_SUCCESS) continue;
            wants_texture = true;
            if (mesh.HasTextureCoords(0))
                to.texture = textures_.index(name.C_Str());
            else
                textures_.leave_out(name.C_Str(), "a mesh has no texture coordinates");
        }
        channel = uv < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(uv) ? int(uv) : 0;
        to.wrap_u = wrap(modes[0]);
        to.wrap_v = wrap(modes[1]);
        int shading = 0;
        if (linear_ && from.Get(AI_MATKEY_SHADING_MODEL, shading) == aiReturn_SUCCESS) to.lit = shading != aiShadingMode_Unlit;
        // Grey replaces a texture that is missing; outside of glTF a texture or vertex colours replace the colour.
        aiColor4D colour(1, 1, 1, 1);
        if (linear_ || (to.texture < 0 && !coloured(mesh))) {
            if (from.Get(AI_MATKEY_BASE_COLOR, colour) != aiReturn_SUCCESS) from.Get(AI_MATKEY_COLOR_DIFFUSE, colour);
        }
        if (wants_texture && to.texture < 0 && !linear_) colour = aiColor4D(1, 1, 1, 1);
        for (unsigned c = 0; c < 3; ++c) to.colour[c] = light(colour[c]) * (wants_texture && to.texture < 0 ? grey : 1);
        const auto [entry, fresh] = known_.try_emplace(key, std::uint32_t(model_.materials.size()));
        if (fresh) model_.materials.push_back(to);
        // What is not shown is noted.
        float opacity = 1;
        aiString alpha("OPAQUE");
        from.Get(AI_MATKEY_OPACITY, opacity);
        from.Get(AI_MATKEY_GLTF_ALPHAMODE, alpha);
        transparent_ = transparent_ || opacity < 0.99f || alpha != aiString("OPAQUE") || has(from, aiTextureType_OPACITY);
        if (has(from, aiTextureType_NORMALS) || has(from, aiTextureType_HEIGHT) || has(from, aiTextureType_NORMAL_CAMERA))
            left_out_.add("normal and bump maps");
        if (shines(from) || has(from, aiTextureType_EMISSIVE)) left_out_.add("emissive materials' own lights");
        if (!linear_ && to.texture >= 0 && is_tinted(from)) left_out_.add("tints of textures (Kd)");
        return entry->second;
    }

    static bool has(const aiMaterial& material, aiTextureType type) { return material.GetTextureCount(type) > 0; }

    // Returns whether a material's colour would tint its texture. Greys are what exporters and loaders fill in.
    static bool is_tinted(const aiMaterial& material) {
        aiColor4D c(1, 1, 1, 1);
        material.Get(AI_MATKEY_COLOR_DIFFUSE, c);
        return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > 0.01f;
    }

    /// What a mesh's vertices take from it: texture coordinates of a channel, with a tiling, and colours.
    struct Attributes {
        int channel;
        bool coloured;
        Tiling tiling;
    };

    // Adds the triangles of a mesh.
    void add(const aiMesh& mesh) {
        if (!(mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) || !mesh.mVertices) return;
        Attributes of{0, coloured(mesh), {}};
        if (const auto tiling = tilings_.find(scene_.mMaterials[mesh.mMaterialIndex]->GetName().C_Str()); tiling != tilings_.end())
            of.tiling = tiling->second;
        const std::uint32_t own = material(mesh, of.channel);
        const std::size_t first = model_.vertices();
        if (first + mesh.mNumVertices >= std::size_t(1) << 32) throw std::runtime_error("has more than 2^32 vertices");
        if (mesh.mNormals)
            for (unsigned v = 0; v < mesh.mNumVertices; ++v) add_vertex(mesh, v, of, mesh.mNormals[v]);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
            const aiFace& face = mesh.mFaces[f];
            if (face.mNumIndices != 3) {
                ++dropped_;
                continue;
            }
            if (mesh.mNormals)
                for (int k = 0; k < 3; ++k) model_.indices.push_back(std::uint32_t(first + face.mIndices[k]));
            else
                add_flat(mesh, face, of);
            model_.material_of.push_back(own);
        }
    }

    // Adds a face with separate vertices and the face's normal, for meshes without normals.
    void add_flat(const aiMesh& mesh, const aiFace& face, const Attributes& of) {
        const aiVector3D* const p = mesh.mVertices;
        const unsigned* const at = face.mIndices;
        const aiVector3D normal = ((p[at[1]] - p[at[0]]) ^ (p[at[2]] - p[at[0]])).NormalizeSafe();
        for (int k = 0; k < 3; ++k) {
            model_.indices.push_back(std::uint32_t(model_.vertices()));
            add_vertex(mesh, at[k], of, normal);
        }
    }

    void add_vertex(const aiMesh& mesh, unsigned v, const Attributes& of, const aiVector3D& normal) {
        if (of.coloured) {
            model_.colours.resize(model_.positions.size(), 1.f);
            const aiColor4D& c = mesh.mColors[0][v];
            push(model_.colours, aiVector3D(light(c.r), light(c.g), light(c.b)));
        } else if (!model_.colours.empty()) {
            push(model_.colours, aiVector3D(1, 1, 1));
        }
        push(model_.positions, turn_(mesh.mVertices[v]));
        push(model_.normals, turn_(normal));
        const aiVector3D uv = mesh.HasTextureCoords(unsigned(of.channel)) ? mesh.mTextureCoords[of.channel][v] : aiVector3D();
        for (unsigned k = 0; k < 2; ++k) model_.uvs.push_back(float(of.tiling.offset[k] + of.tiling.scale[k] * double(uv[k])));
    }

    // Shows a model in grey if all of its materials are black: some loaders find no colours, and a black model on black would
    // look like a fault of the display.
    void show_black() {
        const auto black = [](const Material& m) {
            return m.texture < 0 && std::max({m.colour[0], m.colour[1], m.colour[2]}) < 1e-3f;
        };
        if (!std::all_of(model_.materials.begin(), model_.materials.end(), black)) return;
        for (Material& m : model_.materials) std::fill_n(m.colour, 3, grey);
        model_.notes.push_back("every material is black: shown in grey");
    }

    static void push(std::vector<float>& list, const aiVector3D& v) { list.insert(list.end(), {v.x, v.y, v.z}); }

    const aiScene& scene_;
    Textures textures_;
    AxesTurn turn_;
    const std::map<std::string, Tiling>& tilings_;  // by the materials' names
    bool linear_;
    std::map<std::tuple<unsigned, bool, bool>, std::uint32_t> known_;
    Model model_;
    NotShown left_out_;
    std::int64_t dropped_ = 0;
    bool transparent_ = false, out_of_range_ = false;
};

// Notes animations, skins, morph targets, points and lines (which faces of fewer than three corners are), which are not shown.
void note_deformations(const aiScene& scene, NotShown& not_shown) {
    if (scene.mNumAnimations > 0) not_shown.add("animations");
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        if (mesh.mNumBones > 0) not_shown.add("skins' poses");
        if (mesh.mNumAnimMeshes > 0) not_shown.add("morph targets");
        if (mesh.mPrimitiveTypes & (aiPrimitiveType_POINT | aiPrimitiveType_LINE) ||
            std::any_of(mesh.mFaces, mesh.mFaces + mesh.mNumFaces, [](const aiFace& face) { return face.mNumIndices < 3; }))
            not_shown.add("points and lines");
    }
}

// Returns whether Assimp may join vertices. It joins those nearer to each other than 1e-5, whatever their colours; its own
// loaders give most corners of faces separate vertices.
bool may_join(const aiScene& scene, const std::string& format) {
    if (format.starts_with(GltfLoader::name) || format == PlyLoader::name) return false;
    return std::none_of(scene.mMeshes, scene.mMeshes + scene.mNumMeshes,
                        [](const aiMesh* mesh) { return mesh->HasVertexColors(0); });
}

// Removes the loaders whose names begin with `loader_name`.
void take_away(Assimp::Importer& importer, const char* loader_name) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        if (!std::string(importer.GetImporterInfo(i)->mName).starts_with(loader_name)) continue;
        Assimp::BaseImporter* const loader = importer.GetImporter(i);
        importer.UnregisterLoader(loader);
        delete loader;
    }
}

/// Puts this program's loaders in place of some of Assimp's.
void choose_loaders(Assimp::Importer& importer, const std::filesystem::path& file, Folder& folder, NotShown& not_shown) {
    take_away(importer, "glTF2 Importer");
    take_away(importer, "Stanford Polygon Library");
    auto* const gltf = new GltfLoader(folder, not_shown);  // owned by the importer, like the PlyLoader
    // Assimp's loader of version 1 would otherwise try first.
    if (gltf->CanRead(file.string(), &folder, true)) take_away(importer, "glTF Importer");
    importer.RegisterLoader(gltf);
    importer.RegisterLoader(new PlyLoader(not_shown));
}

}  // namespace

Model import(const std::filesystem::path& file, const std::string& up) {
    Assimp::Importer importer;
    auto* folder = new Folder(file);  // owned by the importer from here on
    importer.SetIOHandler(folder);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    NotShown not_shown;
    std::map<std::string, Tiling> tilings;
    int exponent = 0;  // of the power of two by which positions are multiplied as long as Assimp has them
    folder->edited = [&](const std::string& name) -> std::optional<std::string> {
        const std::string ending = lower_case(std::filesystem::path(name).extension().string());
        const bool has_positions = ending == ".obj" || ending == ".off" || ending == ".stl";
        const bool has_face_colours = ending == ".off" || ending == ".x3d";
        bool changed = has_byte_order_mark(name);
        if (ending == ".mtl")
            return readable_materials(bytes_without_mark(name), std::filesystem::path(name).filename().string(), tilings,
                                      not_shown);
        if (!has_positions && !has_face_colours && !changed) return {};
        std::string text = bytes_without_mark(name);
        if (has_face_colours) note_face_colours(text, ending, not_shown);
        if (ending == ".obj") {
            note_free_forms(text, not_shown);
            changed |= separate_libraries(text);
            changed |= lead_with_digits(text);
        }
        if (ending == ".stl") {
            changed |= lower_keywords(text);
            changed |= invert_materialise_bits(text);
        }
        if (auto scaled = has_positions ? readable_positions(text, ending) : std::nullopt) {
            exponent = scaled->exponent;
            return std::move(scaled->text);
        }
        return changed ? std::optional(std::move(text)) : std::nullopt;
    };
    choose_loaders(importer, file, *folder, not_shown);
    note_3mf(file, not_shown);
    auto* warnings = new Warnings;  // owned by the logger
    Assimp::DefaultLogger::create("", Assimp::Logger::NORMAL, 0);
    Assimp::DefaultLogger::get()->attachStream(warnings, Assimp::Logger::Warn | Assimp::Logger::Err);

    // The scene is loaded, repaired as loaded, and then post-processed.
    const aiScene* scene = importer.ReadFile(file.string(), 0);
    const aiImporterDesc* used = importer.GetImporterInfo(std::size_t(importer.GetPropertyInteger("importerIndex", 0)));
    const std::string format = used ? used->mName : "";
    const bool is_3mf = format.starts_with("3mf");
    if (scene && scene->mRootNode) {
        auto& loaded = const_cast<aiScene&>(*scene);  // owned by the importer
        check_references(loaded);
        repair(loaded, file, format);
        note_deformations(loaded, not_shown);
        exponent += fit_to_floats(loaded, not_shown);
        if (!flat_without_normals(file, format)) smooth_normals(loaded, crease_deg);
        scene = importer.ApplyPostProcessing(steps | (may_join(loaded, format) ? aiProcess_JoinIdenticalVertices : 0u));
    }
    if (!scene) {
        if (std::string(importer.GetErrorString()) == "std::bad_alloc") throw std::bad_alloc();
        throw std::runtime_error(refusal(importer.GetErrorString(), file, not_shown));
    }
    // A face without a valid vertex means a damaged file: Assimp would leave it out and continue.
    for (const std::string& warning : warnings->texts)
        if (warning.find("out-of-range ind") != std::string::npos) throw std::runtime_error(missing_vertices);
    Model model = Conversion(*scene, *folder, format, turn(*scene, format, up), tilings, not_shown).run();
    // Blender's loader warns of every field that a version of the program did not have, 3MF's of every file of the archive.
    if (!format.starts_with("Blender") && !is_3mf)
        for (const std::string& warning : warnings->texts)
            if (std::optional<std::string> plain = plain_warning(warning)) model.notes.push_back(std::move(*plain));
    model.files.insert(model.files.end(), folder->opened().begin(), folder->opened().end());
    mend_normals(model);
    for (float& x : model.positions) x = std::ldexp(x, -exponent);
    return model;
}

}  // namespace lfdsim::reader
