// Texture files and embedded textures, decoded.
#pragma once
#include "content/models/model.h"
#include "content/reader/limits/folder.h"

#include <assimp/scene.h>

#include <map>
#include <string>
#include <vector>

namespace lfdsim::reader {

/// Returns a picture file's texels, upright if the camera was turned (image/formats/upright.h). Throws std::runtime_error, which
/// says why it cannot be decoded.
Texture read_texture(const std::filesystem::path&);

/// Returns whether any texel is not opaque.
bool has_alpha(const Texture&);

/// The textures of a scene, each decoded once.
class Textures {
  public:
    Textures(const aiScene& scene, const Folder& folder) : scene_(scene), folder_(folder) {}

    /// Returns the index of the texture that the model calls `name`; -1, with a note, if it is missing or cannot be decoded.
    int index(const std::string& name);

    /// Notes, once for each texture and reason, that a texture is not shown and its surfaces are grey.
    void leave_out(const std::string& name, const std::string& why);
    /// Returns these notes; of more than six the first five, and how many more there are.
    std::vector<std::string> notes() const;

    std::vector<Texture> textures;
    std::vector<std::string> files;  // that textures were read from

  private:
    int load(const std::string& name);

    const aiScene& scene_;
    const Folder& folder_;
    std::map<std::string, int> known_;
    std::vector<std::string> left_out_;
};

}  // namespace lfdsim::reader
