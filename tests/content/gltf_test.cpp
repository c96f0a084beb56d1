// glTF 2.0: colours, textures and normals against closed forms.
#include "gltf_maker.h"

namespace gltf_maker {
namespace {

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

TEST(Gltf, FurtherVertexColoursAreNoted) {
    Folder folder;
    const auto file = Gltf().add("COLOR_1", "VEC3", Gltf::floats(std::vector<float>(12, 0.f))).write(folder);
    EXPECT_THAT(info(*load_model(file)).notes, testing::ElementsAre("colours of vertices beyond COLOR_0 are not shown"));
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

}  // namespace
}  // namespace gltf_maker
