// glTF 2.0 in Assimp's place: version 5.2 copies integers into floats as they are, and knows of no skins, morph weights or
// instances.
#pragma once
#include "content/reader/gltf/gltf_file.h"
#include "content/reader/limits/folder.h"
#include "content/reader/limits/not_shown.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>

namespace lfdsim::reader {

/// Fills an empty scene with the meshes of a file's scene as it stands without animations: every mesh in place, skins and morph
/// targets applied, instances copied, the middle taken off what is far from the origin. Throws std::runtime_error that says what is
/// wrong, or which extension the file requires that is not read.
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
