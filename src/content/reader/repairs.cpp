#include "content/reader/repairs.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

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

// Makes codes of 0 to 255, which OFF files have as well as numbers of 0 to 1, such numbers, as the loader takes both for.
void scale_codes(aiScene& scene) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        aiColor4D* const first = scene.mMeshes[m]->mColors[0];
        aiColor4D* const end = first ? first + scene.mMeshes[m]->mNumVertices : nullptr;
        if (std::any_of(first, end, [](const aiColor4D& c) { return std::max({c.r, c.g, c.b}) >= 2; }))
            std::for_each(first, end, [](aiColor4D& c) { c = c * (1 / 255.f); });
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
    if (format.starts_with("OFF")) scale_codes(scene);
}

void mend_normals(Model& model) {
    const auto bad = [&](std::uint32_t v) {
        const float* n = &model.normals[3 * std::size_t(v)];
        const float square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        return !(square > 0.25f && square < 4.f);
    };
    const auto append = [](std::vector<float>& list, std::uint32_t v, std::size_t size) {
        for (std::size_t c = 0; c < size && !list.empty(); ++c) list.push_back(list[std::size_t(v) * size + c]);
    };
    for (std::size_t t = 0; t < model.indices.size(); t += 3) {
        std::uint32_t* const corner = &model.indices[t];
        aiVector3D p[3];
        for (int k = 0; k < 3; ++k) {
            const float* at = &model.positions[3 * std::size_t(corner[k])];
            p[k] = {at[0], at[1], at[2]};
        }
        const aiVector3D face = ((p[1] - p[0]) ^ (p[2] - p[0])).NormalizeSafe();
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = corner[k];
            if (!bad(v)) continue;
            corner[k] = std::uint32_t(model.vertices());
            append(model.positions, v, 3);
            append(model.uvs, v, 2);
            append(model.colours, v, 3);
            model.normals.insert(model.normals.end(), {face.x, face.y, face.z});
        }
    }
}

void check_references(const aiScene& scene) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
        const aiMesh& mesh = *scene.mMeshes[m];
        if (mesh.mMaterialIndex >= scene.mNumMaterials) throw std::runtime_error(missing_material);
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices) throw std::runtime_error(missing_vertices);
    }
}

}  // namespace lfdsim::reader
