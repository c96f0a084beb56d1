#include "content/reader/picture.h"

#include "content/reader/textures.h"

#include <stdexcept>

namespace lfdsim::reader {
namespace {

Texture read(const std::filesystem::path& file) {
    try {
        return read_texture(file);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(std::string(error.what()) +
                                 "; PNG, JPEG, BMP, TGA and GIF files of at most 16384 x 16384 pixels are");
    }
}

}  // namespace

Model picture(const std::filesystem::path& file) {
    Model m;
    m.textures.push_back(read(file));
    const Texture& texture = m.textures.front();
    const float x = 0.5f * float(texture.width) / float(texture.height), y = 0.5f;
    m.positions = {-x, -y, 0, x, -y, 0, x, y, 0, -x, y, 0};
    m.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    m.uvs = {0, 0, 1, 0, 1, 1, 0, 1};
    m.indices = {0, 1, 2, 0, 2, 3};
    m.material_of = {0, 0};
    m.materials.push_back({{1, 1, 1}, 0, Wrap::clamp, Wrap::clamp, 0, has_alpha(texture)});
    m.files.push_back(file.string());
    return m;
}

}  // namespace lfdsim::reader
