// What the loaders of the model reader have to stand.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <assimp/scene.h>

#include <cstdlib>
#include <new>
#include <stdexcept>

namespace lfdsim {

template <class Read>
int fuzz_scene(const Read& read) {
    try {
        aiScene scene;
        reader::NotShown not_shown;
        read(scene, not_shown);
        if (scene.mNumMeshes == 0) std::abort();
        for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
            const aiMesh& mesh = *scene.mMeshes[m];
            if (mesh.mMaterialIndex >= scene.mNumMaterials || !mesh.mVertices) std::abort();
            for (unsigned f = 0; f < mesh.mNumFaces; ++f)
                for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                    if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices) std::abort();
        }
    } catch (const std::bad_alloc&) {
    } catch (const std::runtime_error& refusal) {
        if (!*refusal.what()) std::abort();
    }
    return 0;
}

}  // namespace lfdsim
