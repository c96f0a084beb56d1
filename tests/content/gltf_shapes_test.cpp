// glTF 2.0: numbers, names, poses and extensions, and files that lie.
#include "gltf_maker.h"
#include "refused.h"

namespace gltf_maker {
namespace {

template <class T>
std::string bytes_of(const std::vector<T>& all) {
    return std::string(reinterpret_cast<const char*>(all.data()), all.size() * sizeof(T));
}

constexpr const char* four = R"({"uri":"four.png"})";

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
    // By version 0.x they look along -z, by 1.0 along +z as glTF does.
    const auto with = [&](const char* extensions, const char* nodes) {
        const std::string used = R"("extensions":)" + std::string(extensions);
        return Gltf().nodes(nodes).upright().material(textured).texture(four).more(used).write(folder);
    };
    constexpr const char *as_it_is = R"([{"mesh":0}])", *turned = R"([{"mesh":0,"rotation":[0,1,0,0]}])";
    expect_upright(with(R"({"VRM":{"specVersion":"0.0"}})", turned));
    expect_upright(with(R"({"VRMC_vrm":{"specVersion":"1.0"}})", as_it_is));
    expect_upright(with(R"({"VRM":{},"VRMC_vrm":{}})", as_it_is));
}

TEST(Gltf, DracoIsUnpacked) {
    const fs::path sample = "/usr/share/assimp/models/glTF2/draco/2CylinderEngine.gltf";
    if (!fs::exists(sample)) GTEST_SKIP() << "needs Debian's assimp-testmodels";
    const ModelInfo packed = info(*load_model(sample));
    EXPECT_EQ(packed.triangles, 110336);
    EXPECT_THAT(packed.notes, testing::IsEmpty());
}

// Version 1 stays with Assimp, also where the version is a number, as collada2gltf wrote it.
TEST(Gltf, VersionOneIsReadByAssimp) {
    const fs::path sample = "/usr/share/assimp/models/glTF/CesiumMilkTruck/CesiumMilkTruck.gltf";
    if (!fs::exists(sample)) GTEST_SKIP() << "needs Debian's assimp-testmodels";
    EXPECT_GT(info(*load_model(sample)).triangles, 1000);
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
                testing::HasSubstr("not a whole number"));
    EXPECT_THAT(changed(R"("byteOffset":0)", R"("byteOffset":18446744073709551615)"), testing::HasSubstr("not a whole number"));
    EXPECT_THAT(changed(R"("count":4)", R"("count":5)"), testing::HasSubstr("accessors[0]"));
    EXPECT_THAT(changed(R"("count":4)", R"("count":4000000000)"), testing::HasSubstr("accessors[0]"));
    EXPECT_THAT(changed(R"("componentType":5126)", R"("componentType":5130)"), testing::HasSubstr("not a type"));
    EXPECT_THAT(changed(R"("byteOffset":0,"byteLength":48)", R"("byteOffset":0,"byteLength":48,"byteStride":8)"),
                testing::HasSubstr("bufferViews[0].byteStride is 8, but elements of accessors[0] have 12 bytes"));
    EXPECT_THAT(changed(R"("componentType":5123)", R"("componentType":5126)"), testing::HasSubstr("indices are unsigned integers"));
    EXPECT_THAT(changed(R"("mesh":0)", R"("mesh":7)"), testing::HasSubstr("there are only 1 meshes"));
    EXPECT_THAT(changed(R"("mesh":0)", R"("mesh":0,"children":[0])"), testing::HasSubstr("descendant of itself"));
    EXPECT_THAT(changed(R"([{"mesh":0}])", R"([{"children":[2]},{"children":[2]},{"mesh":0}])"),
                testing::HasSubstr("another node"));
    EXPECT_THAT(changed(R"("uri":"t.bin")", R"("uri":"../t.bin2")"), testing::HasSubstr("not in the model's folder"));
    EXPECT_THAT(changed(R"("uri":"t.bin",)", ""), testing::HasSubstr("has no bytes"));
    EXPECT_THAT(changed(R"({"asset":)", R"({{"asset":)"), testing::HasSubstr("JSON is damaged at line 1"));
    const auto binary = [&](const std::string& header) { return refused(folder.write("bad.glb", header + "JSON{} ")); };
    EXPECT_THAT(binary(std::string("glTF\2\0\0\0\x17\0\0\0\xff\0\0\0", 16)), testing::HasSubstr("cut short"));
    EXPECT_THAT(binary(std::string("glTF\2\0\0\0\x14\0\0\0\3\0\0\0", 16)),
                testing::HasSubstr("a length of 20 bytes, but it has 23"));
    EXPECT_THAT(binary(std::string("glTF\x09\0\0\0\x17\0\0\0\3\0\0\0", 16)), testing::HasSubstr("states version 9"));
    const std::string deep(1000000, '['), closed = deep + std::string(1000000, ']');  // deeper than any stack
    for (const std::string& bytes : {R"({"asset":)" + deep, closed, R"({"asset":{"version":"1.0"},"x":)" + closed + "}"})
        EXPECT_THAT(refused(folder.write("deep.gltf", bytes)), testing::HasSubstr("nested more than 1000 levels deep"));
    const std::string brackets =
        R"({"asset":{"version":"2.0","copyright":"\"[)" + deep + R"("},)" + text.substr(text.find("\"scene\""));
    EXPECT_EQ(info(*load_model(folder.write("texts.gltf", brackets))).triangles, 2);
}

}  // namespace
}  // namespace gltf_maker
