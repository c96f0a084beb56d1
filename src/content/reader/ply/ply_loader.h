// A loader of PLY in place of Assimp's, whose version 5.2 assigns to vertices what corners and faces have, and rounds coordinates
// before anything else.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <assimp/BaseImporter.h>
#include <assimp/scene.h>

#include <string_view>

namespace lfdsim::reader {

/// Fills an empty scene with a file's faces and strips; positions far from the origin are taken relative to their middle. Throws
/// std::runtime_error, which says what is wrong.
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
