// A loader of glTF 2.0 in place of Assimp's, whose version 5.2 copies integers into floats as they are, and ignores skins, morph
// weights and instances.
#pragma once
#include "content/reader/gltf/gltf_file.h"
#include "content/reader/limits/folder.h"
#include "content/reader/limits/not_shown.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>

namespace lfdsim::reader {

/// Fills an empty scene with the meshes of a file's scene, without animations: every mesh in its position, with skins and morph
/// targets applied and instances copied; positions far from the origin are taken relative to their middle. Throws
/// std::runtime_error, which says what is wrong, or which required extension is not read.
void read_gltf(std::string bytes, const GltfFile::Open& open, aiScene&, NotShown&);

class GltfLoader : public Assimp::BaseImporter {
  public:
    static constexpr const char* name = "glTF2";
    GltfLoader(const Folder& folder, NotShown& not_shown) : folder_(folder), not_shown_(not_shown) {}

    bool CanRead(const std::string& file, Assimp::IOSystem*, bool check_signature) const override;
    const aiImporterDesc* GetInfo() const override;

  protected:
    void InternReadFile(const std::string& file, aiScene*, Assimp::IOSystem*) override;

  private:
    const Folder& folder_;
    NotShown& not_shown_;
};

}  // namespace lfdsim::reader
