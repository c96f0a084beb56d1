// glTF 2.0: colours, textures and normals against closed forms.
#include "image/encoding.h"
#include "image/image_file.h"
#include "model/vec.h"
#include "small_world.h"

#include <cmath>
#include <cstring>

namespace {

using namespace small_world;

std::string base64(const std::string& bytes) {
    static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? letters[three >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string read_bytes(const fs::path& path) {
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

constexpr const char* textured = R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}})";

Image photo(const std::shared_ptr<const Model>& model) {
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    const Geometry g = resolve(d);
    Job job;
    return reference_photograph(d, g, ContentScene(model, d, g), 0, {}, job).image;
}

/// Light of the place (x, y) of the square, -1 to 1, as if it were white where fully lit.
std::array<double, 3> at(const Image& image, double x, double y) {
    const float* const c = image.at(int(120 + 50 * x), int(80 - 50 * y));
    return {c[0] / facing_light, c[1] / facing_light, c[2] / facing_light};
}

void expect_colour(const std::array<double, 3>& got, const std::array<double, 3>& wanted, double within = 1e-4) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(got[c], wanted[c], within) << "channel " << c;
}

// Texels of 2 x 2 in four colours: red, green above; blue, white below.
constexpr std::array<double, 3> only_red{1, 0, 0}, only_green{0, 1, 0}, only_blue{0, 0, 1}, all_white{1, 1, 1};
std::string four_colours(const Folder& folder, const std::string& name = "four.png") {
    Image texels(2, 2);
    std::copy_n(only_red.begin(), 3, texels.at(0, 0));
    std::copy_n(only_green.begin(), 3, texels.at(1, 0));
    std::copy_n(only_blue.begin(), 3, texels.at(0, 1));
    std::copy_n(all_white.begin(), 3, texels.at(1, 1));
    write_image(folder.path() / name, texels);
    return read_bytes(folder.path() / name);
}

// The centres of the four texels of an upright texture.
void expect_upright(const fs::path& file) {
    const Image image = photo(load_model(file));
    expect_colour(at(image, -0.5, 0.5), only_red, 0.03);
    expect_colour(at(image, 0.5, 0.5), only_green, 0.03);
    expect_colour(at(image, -0.5, -0.5), only_blue, 0.03);
    expect_colour(at(image, 0.5, -0.5), all_white, 0.03);
}

TEST(Gltf, TexturesFromEveryPlaceStandUpright) {
    Folder folder;
    const std::string png = four_colours(folder);
    expect_upright(Gltf().upright().material(textured).texture(R"({"uri":"four.png"})").write(folder));
    expect_upright(
        Gltf().upright().material(textured).texture(R"({"uri":"data:image/png;base64,)" + base64(png) + "\"}").write(folder));
    expect_upright(Gltf().upright().material(textured).write_binary(folder, png));
}

// Factor x texture x vertex colour, all in linear light; the texture's codes alone are sRGB.
TEST(Gltf, FactorTextureAndVertexColourMultiply) {
    Folder folder;
    Image texel(1, 1);
    texel.rgb = {float(srgb_to_linear(128 / 255.)), float(srgb_to_linear(64 / 255.)), 1};
    write_image(folder.path() / "t.png", texel);
    const std::string bytes(16, char(51));  // 0.2, as normalised bytes, which are linear, too
    const auto file = Gltf()
                          .upright()
                          .add("COLOR_0", "VEC4", bytes, 4, 5121, R"("normalized":true,)")
                          .material(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,0.25,1],"baseColorTexture":{"index":0}}})")
                          .texture(R"({"uri":"t.png"})")
                          .write(folder);
    expect_colour(at(photo(load_model(file)), 0.3, 0.2),
                  {0.5 * 0.2 * srgb_to_linear(128 / 255.), 0.2 * srgb_to_linear(64 / 255.), 0.25 * 0.2});
}

TEST(Gltf, VertexColoursAreLinearAndInterpolated) {
    Folder folder;
    const auto file =
        Gltf().add("COLOR_0", "VEC3", Gltf::floats({0, 0, 0.25f, 1, 0, 0.25f, 1, 0, 0.25f, 0, 0, 0.25f})).write(folder);
    const Image image = photo(load_model(file));
    for (const double x : {-0.8, -0.2, 0.4})  // at a pixel's middle
        expect_colour(at(image, x, 0.1), {(x + 0.01 + 1) / 2, 0, 0.25}, 1e-3);
}

TEST(Gltf, BlackVertexColoursAreBlack) {
    Folder folder;
    const auto file = Gltf().add("COLOR_0", "VEC3", Gltf::floats(std::vector<float>(12, 0.f))).write(folder);
    expect_colour(at(photo(load_model(file)), 0, 0), {0, 0, 0});
}

// Texture coordinates from 0 to 2 across: what the second period shows says how the sampler wraps.
TEST(Gltf, SamplersWrap) {
    Folder folder;
    four_colours(folder);
    const auto second_period = [&](const char* mode) {
        const std::string sampler = std::string(R"({"wrapS":)") + mode + R"(,"wrapT":)" + mode + "}";
        const auto file =
            Gltf().uv({0, 1, 2, 1, 2, 0, 0, 0}).material(textured).texture(R"({"uri":"four.png"})", sampler).write(folder);
        const Image image = photo(load_model(file));
        return std::array{at(image, 0.25, 0.5), at(image, 0.75, 0.5)};  // u = 1.25 and 1.75, in the upper row
    };
    expect_colour(second_period("10497")[0], only_red, 0.05);  // repeat
    expect_colour(second_period("10497")[1], only_green, 0.05);
    expect_colour(second_period("33071")[0], only_green, 0.05);  // clamp to edge
    expect_colour(second_period("33071")[1], only_green, 0.05);
    expect_colour(second_period("33648")[0], only_green, 0.05);  // mirrored repeat
    expect_colour(second_period("33648")[1], only_red, 0.05);
}

// KHR_texture_transform: uv' = offset + rotation(scale uv), counter-clockwise in the picture's u, v, in that order.
TEST(Gltf, TextureTransforms) {
    Folder folder;
    four_colours(folder);
    const auto corner = [&](const char* transform, double x, double y) {
        const std::string material = std::string(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{)") +
                                     R"("KHR_texture_transform":{)" + transform + "}}}}}";
        const auto file = Gltf()
                              .upright()
                              .material(material)
                              .more(R"("extensionsUsed":["KHR_texture_transform"])")
                              .texture(R"({"uri":"four.png"})")
                              .write(folder);
        return at(photo(load_model(file)), x, y);
    };
    expect_colour(corner(R"("offset":[0.5,0])", -0.5, 0.5), only_green, 0.05);
    expect_colour(corner(R"("offset":[0,0.5])", -0.5, 0.5), only_blue, 0.05);
    // Half of the texture's width over the square: its upper left texel covers x < 0 to x = 1, the middle is at u = 0.25.
    expect_colour(corner(R"("scale":[0.5,0.5])", 0.01, -0.01), only_red, 0.05);
    // u' = cos u + sin v, v' = -sin u + cos v: a quarter turn takes (0.25, 0.75), the lower left, to (0.75, -0.25), the lower
    // right.
    expect_colour(corner(R"("rotation":1.5707963)", -0.5, -0.5), all_white, 0.05);
    expect_colour(corner(R"("rotation":1.5707963)", 0.5, -0.5), only_green, 0.05);  // (0.75, 0.75) to (0.75, -0.75)
}

TEST(Gltf, TheMaterialChoosesTheTextureCoordinates) {
    Folder folder;
    four_colours(folder);
    const auto file = Gltf()
                          .uv({0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f, 0.25f})
                          .uv({0, 1, 1, 1, 1, 0, 0, 0}, "TEXCOORD_1")
                          .material(R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"texCoord":1}}})")
                          .texture(R"({"uri":"four.png"})")
                          .write(folder);
    expect_upright(file);
}

// A fold along x = 0 whose sides lean 20 degrees: far below the angle up to which other formats are smoothed.
TEST(Gltf, WithoutNormalsFacesAreFlat) {
    Folder folder;
    const float h = float(std::tan(20 * M_PI / 180));
    const std::string roof = Gltf::floats({-1, -1, 0, 0, -1, h, 0, 1, h, -1, 1, 0, 1, -1, 0, 1, 1, 0});
    const std::string indices("\0\0\1\0\2\0\0\0\2\0\3\0\1\0\4\0\5\0\1\0\5\0\2\0", 24);
    folder.write("r.bin", roof + indices);
    const auto file = folder.write("r.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
        "buffers":[{"uri":"r.bin","byteLength":96}],
        "bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":24}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0.5]},
                     {"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})");
    const Image image = photo(load_model(file));
    const Vec3d light = normalised({0.3, 0.5, 0.81}), n{std::sin(20 * M_PI / 180), 0, std::cos(20 * M_PI / 180)};
    for (const double x : {0.1, 0.5, 0.9}) {
        EXPECT_NEAR(at(image, x, 0)[0] * facing_light, 0.2 + 0.8 * dot(n, light), 1e-5);
        EXPECT_NEAR(at(image, -x, 0)[0] * facing_light, 0.2 + 0.8 * dot({-n[0], 0, n[2]}, light), 1e-5);
    }
}

TEST(Gltf, NormalsOfTheFileAreInterpolated) {
    Folder folder;
    const auto file = Gltf().add("NORMAL", "VEC3", Gltf::floats({-1, 0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0})).write(folder);
    const Image image = photo(load_model(file));
    const double light = 0.3 / std::sqrt(0.3 * 0.3 + 0.5 * 0.5 + 0.81 * 0.81);
    EXPECT_NEAR(at(image, 0.5, 0)[0] * facing_light, 0.2 + 0.8 * light, 1e-5);
    EXPECT_NEAR(at(image, -0.5, 0)[0] * facing_light, 0.2, 1e-5);
}

// What cannot be shown is grey, and is said once.
TEST(Gltf, MissingTexturesAndCoordinatesAreGrey) {
    Folder folder;
    four_colours(folder);
    const auto missing = load_model(Gltf().upright().material(textured).texture(R"({"uri":"no.png"})").write(folder));
    EXPECT_THAT(info(*missing).notes, testing::Contains(testing::HasSubstr("\"no.png\" left out, shown grey: not found")).Times(1));
    expect_colour(at(photo(missing), 0, 0), {0.5, 0.5, 0.5});
    const auto bare = load_model(Gltf().material(textured).texture(R"({"uri":"four.png"})").write(folder));
    EXPECT_THAT(info(*bare).notes, testing::Contains(testing::HasSubstr("no texture coordinates")).Times(1));
    expect_colour(at(photo(bare), 0, 0), {0.5, 0.5, 0.5});
}

TEST(Gltf, WhatIsNotShownIsSaid) {
    Folder folder;
    four_colours(folder);
    const auto notes = [&](const std::string& material) {
        return info(*load_model(Gltf().upright().material(material).texture(R"({"uri":"four.png"})").write(folder))).notes;
    };
    EXPECT_THAT(notes("{}"), testing::IsEmpty());
    EXPECT_THAT(notes(R"({"alphaMode":"BLEND"})"), testing::ElementsAre(testing::HasSubstr("opaque")));
    EXPECT_THAT(notes(R"({"alphaMode":"MASK"})"), testing::ElementsAre(testing::HasSubstr("opaque")));
    EXPECT_THAT(notes(R"({"normalTexture":{"index":0}})"), testing::ElementsAre(testing::HasSubstr("normal and bump maps")));
    EXPECT_THAT(notes(R"({"emissiveFactor":[1,0,0]})"), testing::ElementsAre(testing::HasSubstr("emissive")));
}

template <class T>
std::string bytes_of(const std::vector<T>& all) {
    return std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T));
}

constexpr const char* four = R"({"uri":"four.png"})";

std::string refused(const fs::path& file) {
    try {
        load_model(file);
    } catch (const InputError& error) {
        return error.what();
    }
    ADD_FAILURE() << file << " was read";
    return {};
}

// glTF 2.0, 3.6.2.2: integers are c/255, c/65535, max(c/127, -1), max(c/32767, -1) where they are normalized, else themselves.
TEST(Gltf, Integers) {
    Folder folder;
    four_colours(folder);
    const auto texture = [](Gltf gltf) { return gltf.material(textured).texture(four); };
    const std::string normalized = R"("normalized":true,)";
    using Bytes = std::vector<std::uint8_t>;
    using Shorts = std::vector<std::uint16_t>;
    using Signed = std::vector<std::int16_t>;
    expect_upright(texture(Gltf().add("TEXCOORD_0", "VEC2", bytes_of(Bytes{0, 255, 255, 255, 255, 0, 0, 0}), 4, 5121, normalized))
                       .write(folder));
    expect_upright(
        texture(Gltf().add("TEXCOORD_0", "VEC2", bytes_of(Shorts{0, 65535, 65535, 65535, 65535, 0, 0, 0}), 4, 5123, normalized))
            .write(folder));
    const std::string needs = R"("extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"])";
    const Shorts corners{0, 0, 0, 2000, 0, 0, 2000, 2000, 0, 0, 2000, 0};
    expect_upright(texture(Gltf(bytes_of(corners), 5123, "").upright().more(needs)).write(folder));
    const Signed fractions{-32768, -32767, 0, 32767, -32767, 0, 32767, 32767, 0, -32768, 32767, 0};
    expect_upright(texture(Gltf(bytes_of(fractions), 5122, normalized).upright().more(needs)).write(folder));
}

// A URI is not a file name: %20 is a blank.
TEST(Gltf, NamesWithBlanks) {
    Folder folder;
    four_colours(folder, "four quarters.png");
    expect_upright(
        Gltf().upright().material(textured).texture(R"({"uri":"four%20quarters.png"})").write(folder, "a%20b.bin", "a b.bin"));
}

// The lower corners at x = -1.5 and 0.5, the upper ones at -0.5 and 1.5, once their middle is at 0.
void expect_sheared(const fs::path& file) {
    const auto model = load_model(file);
    EXPECT_THAT(info(*model).notes, testing::IsEmpty());
    const Image image = photo(model);
    expect_colour(at(image, -0.25, 0.5), only_red, 0.03);
    expect_colour(at(image, 0.75, 0.5), only_green, 0.03);
    expect_colour(at(image, -0.75, -0.5), only_blue, 0.03);
    expect_colour(at(image, 0.25, -0.5), all_white, 0.03);
    expect_colour(at(image, -1.3, 0.9), {0, 0, 0});
    expect_colour(at(image, 1.3, -0.9), {0, 0, 0});
}

// 3.7.2.1: displacements times the default weights, the node's before the mesh's.
TEST(Gltf, MorphTargetsHaveTheirDefaultWeights) {
    Folder folder;
    four_colours(folder);
    Gltf gltf;
    const int moves = gltf.list("VEC3", Gltf::floats({0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0, 0}), 4);
    gltf.primitive(R"("targets":[{"POSITION":)" + std::to_string(moves) + "}]").nodes(R"([{"mesh":0,"weights":[0.5]}])");
    expect_sheared(gltf.upright().material(textured).texture(four).write(folder));
}

// 3.7.3: a vertex goes where joint x inverse bind matrix takes it; the node of the mesh has no say.
TEST(Gltf, SkinsStandInTheirDefaultPose) {
    Folder folder;
    four_colours(folder);
    Gltf gltf;
    gltf.add("JOINTS_0", "VEC4", bytes_of(std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}), 4, 5121);
    gltf.add("WEIGHTS_0", "VEC4", bytes_of(std::vector<std::uint8_t>{255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}), 4,
             5121, R"("normalized":true,)");
    // The second joint stands at x = 3 and was bound at x = 2.
    const int inverse = gltf.list("MAT4", Gltf::floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,  0, 0, 1,  //
                                                        1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -2, 0, 0, 1}),
                                  2);
    gltf.more(R"("skins":[{"joints":[1,2],"inverseBindMatrices":)" + std::to_string(inverse) + "}]");
    gltf.nodes(R"([{"mesh":0,"skin":0,"translation":[7,0,0],"rotation":[0,1,0,0]},{"children":[2]},{"translation":[3,0,0]}])");
    expect_sheared(gltf.upright().material(textured).texture(four).write(folder));
}

TEST(Gltf, InstancesAreCopied) {
    Folder folder;
    four_colours(folder);
    Gltf gltf;
    const int places = gltf.list("VEC3", Gltf::floats({-1, 0, 0, 1, 0, 0}), 2),
              sizes = gltf.list("VEC3", Gltf::floats({0.5f, 1, 1, 0.5f, 1, 1}), 2);
    gltf.nodes(R"([{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" + std::to_string(places) +
               R"(,"SCALE":)" + std::to_string(sizes) + "}}}}]");
    gltf.more(R"("extensionsRequired":["EXT_mesh_gpu_instancing"])");
    const Image image = photo(load_model(gltf.upright().material(textured).texture(four).write(folder)));
    for (const double x : {-1., 1.}) {
        expect_colour(at(image, x - 0.25, 0.5), only_red, 0.05);
        expect_colour(at(image, x + 0.25, 0.5), only_green, 0.05);
    }
    expect_colour(at(image, 0, 0), {0, 0, 0});
}

// Coordinates of maps: float would be half a unit off, of a fifth.
TEST(Gltf, FarNodesKeepTheirAccuracy) {
    Folder folder;
    four_colours(folder);
    Gltf gltf;
    gltf.nodes(
        R"([{"children":[1],"translation":[691000.3,5334000.7,12.9]},{"mesh":0,"translation":[0.111,0.222,0.333],"scale":[0.1,0.1,0.1]}])");
    expect_upright(gltf.upright().material(textured).texture(four).write(folder));
}

// A mirror image's faces look the same way.
TEST(Gltf, MirroredNodesFaceTheSameWay) {
    Folder folder;
    expect_colour(at(photo(load_model(Gltf().nodes(R"([{"mesh":0,"scale":[-1,1,1]}])").write(folder))), 0.3, 0.2), all_white);
}

TEST(Gltf, UnlitMaterialsShineInTheirOwnColour) {
    Folder folder;
    const auto file =
        Gltf()
            .material(R"({"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1]},"extensions":{"KHR_materials_unlit":{}}})")
            .write(folder);
    const auto got = at(photo(load_model(file)), 0, 0);
    expect_colour({got[0] * facing_light, got[1] * facing_light, got[2] * facing_light}, {0.5, 0.25, 1});
}

// Elements of the base that a sparse accessor replaces: two corners' texture coordinates.
TEST(Gltf, SparseAccessors) {
    Folder folder;
    four_colours(folder);
    Gltf gltf;
    const int numbers = gltf.list("SCALAR", bytes_of(std::vector<std::uint16_t>{1, 2}), 2, 5123),
              values = gltf.list("VEC2", Gltf::floats({1, 1, 1, 0}), 2);
    gltf.add("TEXCOORD_0", "VEC2", Gltf::floats({0, 1, 9, 9, 9, 9, 0, 0}), 4, 5126,
             R"("sparse":{"count":2,"indices":{"bufferView":)" + std::to_string(numbers) +
                 R"(,"componentType":5123},"values":{"bufferView":)" + std::to_string(values) + "}},");
    expect_upright(gltf.material(textured).texture(four).write(folder));
}

// Triangles at one place keep colours of their own: here the corners of two, doubled.
TEST(Gltf, VerticesOfOtherColoursAreNotJoined) {
    Folder folder;
    const std::string places = Gltf::floats({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, -1, 0, 1, 1, 0, -1, 1, 0}),
                      colours = Gltf::floats({1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1});
    folder.write("c.bin", places + colours);
    const auto file = folder.write("c.gltf", R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1}}]}],"buffers":[{"uri":"c.bin","byteLength":144}],
        "bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":72}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3","min":[-1,-1,0],"max":[1,1,0]},
                     {"bufferView":1,"componentType":5126,"count":6,"type":"VEC3"}]})");
    const Image image = photo(load_model(file));
    expect_colour(at(image, 0.5, -0.5), only_red);
    expect_colour(at(image, -0.5, 0.5), only_blue);
}

// What a file requires and is not read is named; what only concerns gloss and light is said.
TEST(Gltf, RequiredExtensionsAreNamed) {
    Folder folder;
    const auto with = [&](const std::string& name) {
        return Gltf().more(R"("extensionsRequired":[")" + name + "\"]").write(folder);
    };
    for (const char* name : {"EXT_meshopt_compression", "KHR_texture_basisu", "EXT_texture_webp", "VENDOR_something"})
        EXPECT_THAT(refused(with(name)), testing::HasSubstr(name));
    EXPECT_THAT(info(*load_model(with("KHR_materials_clearcoat"))).notes,
                testing::ElementsAre(testing::HasSubstr("KHR_materials_clearcoat")));
    EXPECT_THAT(info(*load_model(with("KHR_materials_unlit"))).notes, testing::IsEmpty());
    const std::string ktx = std::string("\xabKTX 20\xbb\r\n\x1a\n") + std::string(68, '\0');
    const auto texture = Gltf()
                             .upright()
                             .material(textured)
                             .more(R"("images":[{"uri":"data:image/ktx2;base64,)" + base64(ktx) +
                                   R"("}],"textures":[{"extensions":{"KHR_texture_basisu":{"source":0}}}])")
                             .write(folder);
    EXPECT_THAT(info(*load_model(texture)).notes, testing::ElementsAre(testing::HasSubstr("KHR_texture_basisu")));
}

TEST(Gltf, WhatIsLeftOutIsOneNote) {
    Folder folder;
    const auto file =
        Gltf()
            .material(R"({"normalTexture":{"index":0}})")
            .more(R"("animations":[{"channels":[],"samplers":[]}],"images":[{"uri":"no.png"}],"textures":[{"source":0}])")
            .write(folder);
    EXPECT_THAT(info(*load_model(file)).notes, testing::ElementsAre("animations and normal and bump maps are not shown"));
    EXPECT_THAT(refused(Gltf().primitive(R"("mode":0)").write(folder)), testing::HasSubstr("holds 4 points and no triangles"));
}

TEST(Gltf, Avatars) {
    Folder folder;
    const std::string png = four_colours(folder);
    const fs::path file = Gltf().upright().material(textured).write_binary(folder, png);
    fs::rename(file, folder.path() / "avatar.vrm");
    expect_upright(folder.path() / "avatar.vrm");
}

TEST(Gltf, DracoIsUnpacked) {
    const fs::path sample = "/usr/share/assimp/models/glTF2/draco/2CylinderEngine.gltf";
    if (!fs::exists(sample)) GTEST_SKIP() << "needs Debian's assimp-testmodels";
    const ModelInfo packed = info(*load_model(sample));
    EXPECT_EQ(packed.triangles, 110336);
    EXPECT_THAT(packed.notes, testing::IsEmpty());
}

// Each change to a good file is refused in words that name the place.
TEST(Gltf, LiesAreFound) {
    Folder folder;
    Gltf gltf;
    const std::string good = gltf.upright().write(folder).string(), text = read_bytes(good);
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string other = text;
        const std::size_t at = other.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return refused(folder.write("bad.gltf", other.replace(at, from.size(), to)));
    };
    EXPECT_THAT(changed(R"("byteOffset":0,"byteLength":48)", R"("byteOffset":70,"byteLength":48)"),
                testing::HasSubstr("bufferViews[0]"));
    EXPECT_THAT(changed(R"("byteOffset":0,"byteLength":48)", R"("byteOffset":-1,"byteLength":48)"),
                testing::HasSubstr("no whole number"));
    EXPECT_THAT(changed(R"("byteOffset":0)", R"("byteOffset":18446744073709551615)"), testing::HasSubstr("no whole number"));
    EXPECT_THAT(changed(R"("count":4)", R"("count":5)"), testing::HasSubstr("accessors[0]"));
    EXPECT_THAT(changed(R"("count":4)", R"("count":4000000000)"), testing::HasSubstr("accessors[0]"));
    EXPECT_THAT(changed(R"("componentType":5126)", R"("componentType":5130)"), testing::HasSubstr("no type"));
    EXPECT_THAT(changed(R"("mesh":0)", R"("mesh":7)"), testing::HasSubstr("there are only 1 meshes"));
    EXPECT_THAT(changed(R"("mesh":0)", R"("mesh":0,"children":[0])"), testing::HasSubstr("recursively"));
    EXPECT_THAT(changed(R"([{"mesh":0}])", R"([{"children":[2]},{"children":[2]},{"mesh":0}])"),
                testing::HasSubstr("another node"));
    EXPECT_THAT(changed(R"("uri":"t.bin")", R"("uri":"../t.bin2")"), testing::HasSubstr("not in the model's folder"));
    EXPECT_THAT(changed(R"("uri":"t.bin",)", ""), testing::HasSubstr("has no bytes"));
    EXPECT_THAT(changed(R"({"asset":)", R"({{"asset":)"), testing::HasSubstr("JSON is damaged at line 1"));
    EXPECT_THAT(refused(folder.write("bad.glb", std::string("glTF\2\0\0\0\xff\0\0\0\xff\0\0\0JSON{}", 22))),
                testing::HasSubstr("cut short"));
    std::string deep;  // deeper than any stack
    for (int k = 0; k < 200000; ++k) deep += "[";
    EXPECT_THAT(refused(folder.write("deep.gltf", R"({"asset":)" + deep)), testing::HasSubstr("JSON is damaged"));
}

}  // namespace
