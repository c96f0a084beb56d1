#include "content/reader/gltf/gltf_loader.h"

#include "base/counted.h"
#include "content/reader/gltf/gltf_mesh.h"
#include "content/reader/gltf/gltf_nodes.h"
#include "content/reader/limits/whole_file.h"

#include <assimp/importerdesc.h>

#include <algorithm>
#include <memory>

namespace lfdsim::reader {
namespace {

// Extensions that a file may require and that are read
constexpr const char* shown_extensions[] = {
    "KHR_mesh_quantization",   "KHR_draco_mesh_compression",          "KHR_texture_transform", "KHR_materials_unlit",
    "EXT_mesh_gpu_instancing", "KHR_materials_pbrSpecularGlossiness", "KHR_node_visibility"};
// Extensions without which shapes are right: gloss, lights, other choices of materials, shaders, metadata
constexpr const char* harmless_extensions[] = {"KHR_materials_", "KHR_technique", "KHR_lights_", "EXT_lights_", "KHR_xmp"};

// Throws std::runtime_error if a file requires an extension without which it would be shown wrongly.
void check_extensions(const Item& required, NotShown& not_shown) {
    for (std::size_t i = 0; i < required.size(); ++i) {
        const std::string name = required[i].text();
        const auto begins = [&](const char* start) { return name.starts_with(start); };
        if (std::find(std::begin(shown_extensions), std::end(shown_extensions), name) != std::end(shown_extensions)) continue;
        if (std::any_of(std::begin(harmless_extensions), std::end(harmless_extensions), begins))
            not_shown.add("features required by " + name);
        else
            throw std::runtime_error("it requires the glTF extension " + name + ", which is not read; export it without");
    }
}

// Returns a skin's joint matrices: each joint's transform times its inverse bind matrix.
std::vector<Matrix> joints_of(GltfFile& file, const GltfNodes& nodes, const Item& skin) {
    std::vector<Matrix> joints;
    const Item numbers = skin.at("joints");
    std::optional<AccessorValues> inverse;
    if (const auto accessor = file.named(skin.at("inverseBindMatrices"), "accessors")) {
        inverse = file.numbers(*accessor);
        if (inverse->width != 16 || inverse->count < numbers.size()) accessor->fail("has no matrix for each joint");
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        file.named(numbers[i], "nodes");
        Matrix joint = nodes.world(numbers[i].whole(0));
        if (inverse) {
            const double* const m = (*inverse)[i];  // column by column
            joint = joint *
                    Matrix(m[0], m[4], m[8], m[12], m[1], m[5], m[9], m[13], m[2], m[6], m[10], m[14], m[3], m[7], m[11], m[15]);
        }
        joints.push_back(joint);
    }
    return joints;
}

// Returns the transforms of a node's mesh into the scene: with EXT_mesh_gpu_instancing one for each entry of its lists, which are
// in the node's coordinates, else the node's.
std::vector<Matrix> instances_of(GltfFile& file, const Item& instancing, const Matrix& world) {
    if (!instancing.is_there()) return {world};
    struct {
        const char* name;
        std::size_t width;
        std::optional<AccessorValues> numbers;
    } lists[] = {{"TRANSLATION", 3, {}}, {"ROTATION", 4, {}}, {"SCALE", 3, {}}};
    std::optional<std::size_t> count;
    for (auto& list : lists) {
        const auto accessor = file.named(instancing.at("attributes").at(list.name), "accessors");
        if (!accessor) continue;
        list.numbers = file.numbers(*accessor);
        if (list.numbers->width != list.width || count.value_or(list.numbers->count) != list.numbers->count)
            instancing.fail("has lists that do not fit");
        count = list.numbers->count;
    }
    constexpr double no_move[] = {0, 0, 0}, no_turn[] = {0, 0, 0, 1}, no_scale[] = {1, 1, 1};
    std::vector<Matrix> all;
    for (std::size_t i = 0; i < count.value_or(0); ++i) {
        const auto value = [&](std::size_t k, const double* otherwise) {
            return lists[k].numbers ? (*lists[k].numbers)[i] : otherwise;
        };
        all.push_back(world * placed(value(0, no_move), value(1, no_turn), value(2, no_scale)));
    }
    return all;
}

// Throws std::runtime_error for JSON that is nested deeper than Assimp, which recurses, can follow.
void check_depth(std::string_view json) {
    constexpr int deepest = 1000;
    int depth = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (in_text) {
            if (c == '\\') ++i;
            in_text = c != '"';
        } else if (c == '{' || c == '[') {
            if (++depth > deepest) throw std::runtime_error("its JSON is nested more than 1000 levels deep");
        } else if (c == '}' || c == ']') {
            --depth;
        } else {
            in_text = c == '"';
        }
    }
}

std::vector<double> list_of(const Item& numbers) {
    std::vector<double> all;
    for (std::size_t i = 0; i < numbers.size(); ++i) all.push_back(numbers[i].number(0));
    return all;
}

template <class T>
void hand_over(std::vector<std::unique_ptr<T>>& from, T**& to, unsigned& count) {
    to = new T*[from.size()];
    for (auto& one : from) to[count++] = one.release();
}

// Moves all meshes to the scene's only node.
void fill(aiScene& scene, GltfMeshes& read) {
    BoxMiddle middle;
    for (const Piece& piece : read.pieces)
        for (const Place& p : piece.places) middle.add(p);
    const Place offset = middle.offset();
    std::vector<std::unique_ptr<aiMesh>> meshes;
    for (Piece& piece : read.pieces) {
        piece.mesh->mVertices = new aiVector3D[piece.places.size()];
        for (std::size_t v = 0; v < piece.places.size(); ++v) piece.mesh->mVertices[v] = to_float(piece.places[v] - offset);
        meshes.push_back(std::move(piece.mesh));
        piece.places = {};
    }
    scene.mRootNode = new aiNode("scene");
    scene.mRootNode->mMeshes = new unsigned[meshes.size()];
    for (; scene.mRootNode->mNumMeshes < meshes.size(); ++scene.mRootNode->mNumMeshes)
        scene.mRootNode->mMeshes[scene.mRootNode->mNumMeshes] = scene.mRootNode->mNumMeshes;
    hand_over(meshes, scene.mMeshes, scene.mNumMeshes);
    hand_over(read.materials().all, scene.mMaterials, scene.mNumMaterials);
    hand_over(read.materials().embedded, scene.mTextures, scene.mNumTextures);
}

}  // namespace

void read_gltf(std::string bytes, const GltfFile::Open& open, aiScene& scene, NotShown& not_shown) {
    GltfFile file(std::move(bytes), open);
    const Item root = file.root(), node_items = root.at("nodes");
    const std::string version = root.at("asset").at("version").text();
    if (version.empty()) throw std::runtime_error("it states no version of glTF; export it as glTF 2.0");
    if (!version.starts_with("2."))
        throw std::runtime_error("it is glTF " + version + ", which is not read; export it as glTF 2.0");
    check_extensions(root.at("extensionsRequired"), not_shown);
    if (root.at("animations").size() > 0) not_shown.add("animations");
    const GltfNodes nodes(file);
    GltfMeshes meshes(file, not_shown);
    for (const std::size_t n : nodes.shown()) {
        const Item node = node_items[n];
        const auto mesh = file.named(node.at("mesh"), "meshes");
        if (!mesh) continue;
        Posing posing;
        posing.instances = instances_of(file, node.at("extensions").at("EXT_mesh_gpu_instancing"), nodes.world(n));
        if (const auto skin = file.named(node.at("skin"), "skins")) posing.joints = joints_of(file, nodes, *skin);
        posing.morph_weights = list_of(node.has("weights") ? node.at("weights") : mesh->at("weights"));
        if (!posing.instances.empty()) meshes.add(*mesh, posing);
    }
    if (meshes.pieces.empty() && meshes.points() > 0)
        throw std::runtime_error("holds " + counted(meshes.points(), "point") +
                                 " and no triangles; point clouds, lines and Gaussian splats are not shown");
    if (meshes.pieces.empty()) throw std::runtime_error("has no triangles: nothing to show");
    fill(scene, meshes);
}

// Decides by content: a binary file, or a JSON description, of another version than 1 (which Assimp reads); by the ending if a
// description has no version.
bool GltfLoader::CanRead(const std::string& file, Assimp::IOSystem* io, bool) const {
    const std::string bytes = whole_file(*io, file).value_or("");
    if (bytes.starts_with("glTF")) return bytes.size() >= 8 && bytes[4] != 1;
    const std::size_t first = bytes.find_first_not_of(" \t\r\n\xef\xbb\xbf");
    if (first == std::string::npos || (bytes[first] != '{' && bytes[first] != '[')) return false;
    check_depth(bytes);
    const auto description = nlohmann::json::parse(bytes, nullptr, false);
    const bool named = SimpleExtensionCheck(file, "gltf", "glb", "vrm");
    if (!description.is_object() || !description.contains("asset") || !description["asset"].is_object()) return named;
    const auto version = description["asset"].value("version", nlohmann::json());
    if (version.is_number()) return version.get<double>() >= 2;  // files of version 1 have numbers here, too
    return version.is_string() ? !version.get<std::string>().starts_with("1") : named;
}

const aiImporterDesc* GltfLoader::GetInfo() const {
    static const aiImporterDesc info{name, "", "", "", aiImporterFlags_SupportTextFlavour | aiImporterFlags_SupportBinaryFlavour,
                                     0,    0,  0,  0,  "gltf glb vrm"};
    return &info;
}

void GltfLoader::InternReadFile(const std::string& file, aiScene* scene, Assimp::IOSystem* io) {
    auto bytes = whole_file(*io, file);
    if (!bytes) throw std::runtime_error("it cannot be opened");
    const auto open = [&](const std::string& wanted) -> std::optional<std::string> {
        const auto path = folder_.find(wanted);
        return path ? whole_file(*io, path->string()) : std::nullopt;
    };
    read_gltf(std::move(*bytes), open, *scene, not_shown_);
}

}  // namespace lfdsim::reader
