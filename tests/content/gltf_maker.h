// glTF files written on the spot, and what their pictures show.
#pragma once
#include "geometry/vec.h"
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "small_world.h"

#include <cmath>
#include <cstring>

namespace gltf_maker {

using namespace small_world;

inline std::string base64(const std::string& bytes) {
    static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

inline std::string read_bytes(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// A square from -1 to 1 across the z axis, as two triangles of four vertices, with further attributes.
class Gltf {
  public:
    Gltf() : Gltf(floats({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}), 5126, R"("min":[-1,-1,0],"max":[1,1,0],)") {}
    /// With corners of other numbers.
    Gltf(const std::string& corners, int component, const std::string& more) {
        add("POSITION", "VEC3", corners, 4, component, more);
    }

    static std::string floats(const std::vector<float>& all) {
        return std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(float));
    }
    Gltf& add(const std::string& name, const std::string& type, const std::string& bytes, int count = 4, int component = 5126,
              const std::string& more = "") {
        attributes_ += (attributes_.empty() ? "\"" : ",\"") + name + "\":" + std::to_string(accessors_);
        accessor(type, bytes, count, component, more);
        return *this;
    }
    /// Numbers that no attribute names; their accessor's number.
    int list(const std::string& type, const std::string& bytes, int count, int component = 5126, const std::string& more = "") {
        accessor(type, bytes, count, component, more);
        return accessors_ - 1;
    }
    Gltf& nodes(const std::string& text) {
        nodes_ = text;
        return *this;
    }
    /// What the one primitive has beside attributes, indices and material: "targets":[...].
    Gltf& primitive(const std::string& text) {
        primitive_ += "," + text;
        return *this;
    }
    Gltf& uv(const std::vector<float>& all, const std::string& name = "TEXCOORD_0") { return add(name, "VEC2", floats(all)); }
    /// v points down: these show a texture upright.
    Gltf& upright() { return uv({0, 1, 1, 1, 1, 0, 0, 0}); }
    Gltf& material(const std::string& text) {
        material_ = text;
        return *this;
    }
    /// What follows "images" and so on: "images":[...],"textures":[...].
    Gltf& more(const std::string& text) {
        more_ += "," + text;
        return *this;
    }
    Gltf& texture(const std::string& image, const std::string& sampler = "") {
        more(R"("images":[)" + image + R"(],"textures":[{"source":0)" + (sampler.empty() ? "" : R"(,"sampler":0)") + "}]");
        if (!sampler.empty()) more(R"("samplers":[)" + sampler + "]");
        return *this;
    }
    std::string text(const std::string& uri) {
        const std::string indices("\0\0\1\0\2\0\0\0\2\0\3\0", 12);
        const int index = accessors_;
        accessor("SCALAR", indices, 6, 5123, "");
        return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes_ +
               R"(,"meshes":[{"primitives":[{"attributes":{)" + attributes_ + R"(},"indices":)" + std::to_string(index) +
               R"(,"material":0)" + primitive_ + R"(}]}],"materials":[)" + material_ + R"(],"buffers":[{)" +
               (uri.empty() ? "" : R"("uri":")" + uri + R"(",)") + R"("byteLength":)" + std::to_string(buffer_.size()) +
               R"(}],"bufferViews":[)" + views_ + R"(],"accessors":[)" + list_ + "]" + more_ + "}";
    }
    fs::path write(const Folder& folder, const std::string& uri = "t.bin", const std::string& file = "t.bin") {
        const std::string text_of_it = text(uri);
        folder.write(file, buffer_);
        return folder.write("t.gltf", text_of_it);
    }
    /// The same with everything in one file, a picture in its buffer.
    fs::path write_binary(const Folder& folder, const std::string& png) {
        while (buffer_.size() % 4) buffer_ += '\0';
        const int view = int(accessors_);
        views_ += R"(,{"buffer":0,"byteOffset":)" + std::to_string(buffer_.size()) + R"(,"byteLength":)" +
                  std::to_string(png.size()) + "}";
        buffer_ += png;
        shift_ = 1;
        texture(R"({"bufferView":)" + std::to_string(view) + R"(,"mimeType":"image/png"})");
        std::string json = text("");
        while (json.size() % 4) json += ' ';
        while (buffer_.size() % 4) buffer_ += '\0';
        const auto number = [](std::uint32_t n) { return std::string(reinterpret_cast<const char*>(&n), 4); };
        return folder.write("t.glb", "glTF" + number(2) + number(std::uint32_t(28 + json.size() + buffer_.size())) +
                                         number(std::uint32_t(json.size())) + "JSON" + json +
                                         number(std::uint32_t(buffer_.size())) + std::string("BIN\0", 4) + buffer_);
    }

  private:
    void accessor(const std::string& type, const std::string& bytes, int count, int component, const std::string& more) {
        while (buffer_.size() % 4) buffer_ += '\0';
        const std::string comma = accessors_ ? "," : "";
        views_ += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(buffer_.size()) + R"(,"byteLength":)" +
                  std::to_string(bytes.size()) + "}";
        list_ += comma + R"({"bufferView":)" + std::to_string(accessors_ + shift_) + R"(,"componentType":)" +
                 std::to_string(component) + R"(,"count":)" + std::to_string(count) + "," + more + R"("type":")" + type + "\"}";
        buffer_ += bytes;
        ++accessors_;
    }
    std::string attributes_, views_, list_, buffer_, material_ = "{}", more_, nodes_ = R"([{"mesh":0}])", primitive_;
    int accessors_ = 0, shift_ = 0;
};

inline constexpr const char* textured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";

inline Image photo(const std::shared_ptr<const Model>& model) {
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    const Geometry g = resolve(d);
    Job job;
    return reference_photograph(d, g, ContentScene(model, d, g), 0, {}, job).image;
}

/// Light of the place (x, y) of the square, -1 to 1, as if it were white where fully lit.
inline std::array<double, 3> at(const Image& image, double x, double y) {
    const float* const c = image.at(int(120 + 50 * x), int(80 - 50 * y));
    return {c[0] / facing_light, c[1] / facing_light, c[2] / facing_light};
}

inline void expect_colour(const std::array<double, 3>& got, const std::array<double, 3>& wanted, double within = 1e-4) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], within) << "channel " << c;
}

// Texels of 2 x 2 in four colours: red, green above; blue, white below.
inline constexpr std::array<double, 3> only_red{1, 0, 0}, only_green{0, 1, 0}, only_blue{0, 0, 1}, all_white{1, 1, 1};
inline std::string four_colours(const Folder& folder, const std::string& name = "four.png") {
    Image texels(2, 2);
    std::copy_n(only_red.begin(), 3, texels.at(0, 0));
    std::copy_n(only_green.begin(), 3, texels.at(1, 0));
    std::copy_n(only_blue.begin(), 3, texels.at(0, 1));
    std::copy_n(all_white.begin(), 3, texels.at(1, 1));
    write_image(folder.path() / name, texels);
    return read_bytes(folder.path() / name);
}

// The centres of the four texels of an upright texture.
inline void expect_upright(const fs::path& file) {
    const Image image = photo(load_model(file));
    expect_colour(at(image, -0.5, 0.5), only_red, 0.03);
    expect_colour(at(image, 0.5, 0.5), only_green, 0.03);
    expect_colour(at(image, -0.5, -0.5), only_blue, 0.03);
    expect_colour(at(image, 0.5, -0.5), all_white, 0.03);
}

}  // namespace gltf_maker
