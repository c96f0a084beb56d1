#include "content/reader/repairs.h"

#include <nlohmann/json.hpp>

#include <fstream>
#include <sstream>
#include <string>

namespace lfdsim::reader {
namespace {

// Corrects nodes of glTF 1.0: a node's matrix is translation x rotation x scale, but the loader applies the translation first and
// so rotates it (a truck loses its wheels). The linear part is right; the translation is set to that of the file.
void place_gltf1_nodes(aiScene& scene, const std::filesystem::path& file) {
    std::ifstream text(file);
    const auto description = nlohmann::json::parse(text, nullptr, false);
    if (!description.is_object() || !description.contains("nodes") || !description["nodes"].is_object()) return;
    for (const auto& [name, node] : description["nodes"].items()) {
        if (!node.is_object() || node.contains("matrix") || !node.contains("translation")) continue;
        const auto& t = node["translation"];
        aiNode* placed = scene.mRootNode->FindNode(name.c_str());
        if (!placed || !t.is_array() || t.size() != 3 || !t[0].is_number() || !t[1].is_number() || !t[2].is_number()) continue;
        placed->mTransformation.a4 = t[0].get<float>();
        placed->mTransformation.b4 = t[1].get<float>();
        placed->mTransformation.c4 = t[2].get<float>();
    }
}

// Removes the normals of Blender's files: they are those of vertices even where faces are flat, so that cubes look like pillows.
// New ones are then computed, with creases.
void drop_normals(aiScene& scene) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        delete[] scene.mMeshes[m]->mNormals;
        scene.mMeshes[m]->mNormals = nullptr;
    }
}

}  // namespace

bool flat_without_normals(const std::filesystem::path& file, const std::string& format) {
    if (format.starts_with("glTF2")) return true;
    if (!format.starts_with("Wavefront")) return false;
    bool off = false;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, group;
        if (line.empty() || line[0] != 's' || !(words >> key >> group) || key != "s") continue;
        if (group != "off" && group != "0") return false;
        off = true;
    }
    return off;
}

void repair(aiScene& scene, const std::filesystem::path& file, const std::string& format) {
    if (format == "glTF Importer") place_gltf1_nodes(scene, file);
    if (format.starts_with("Blender")) drop_normals(scene);
}

}  // namespace lfdsim::reader
