// PLY in Assimp's place: version 5.2 folds what corners and faces have onto vertices, and rounds coordinates before anything else.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>

#include <string_view>

namespace lfdsim::reader {

/// Fills an empty scene with a file's faces and strips, the middle taken off what is far from the origin. Throws std::runtime_error
/// that says what is wrong.
void read_ply(std::string_view bytes, aiScene&, NotShown&);

class PlyLoader : public Assimp::BaseImporter {
  public:
    static constexpr const char* name = "PLY";
    explicit PlyLoader(NotShown& not_shown) : not_shown_(not_shown) {}

    bool CanRead(const std::string& file, Assimp::IOSystem*, bool check_signature) const override;
    const aiImporterDesc* GetInfo() const override;

  protected:
    void InternReadFile(const std::string& file, aiScene*, Assimp::IOSystem*) override;

  private:
    NotShown& not_shown_;
};

}  // namespace lfdsim::reader
