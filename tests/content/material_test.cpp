// Colours and textures, as the picture shows them.
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "small_world.h"

#include <cmath>

namespace {

using namespace small_world;

// A photograph of a square of 20 mm that fills 100 x 100 pixels in the middle of 240 x 160.
Image shoot(const fs::path& model) {
    Display d = display();
    d.camera.target_mm = {0, 0, resolve(d).vertex_plane_mm};
    const Geometry g = resolve(d);
    Job job;
    return reference_photograph(d, g, ContentScene(load_model(model), d, g), 0, {}, job).image;
}

std::array<double, 3> middle(const Image& image) {
    const float* c = image.at(120, 80);
    return {c[0] / facing_light, c[1] / facing_light, c[2] / facing_light};
}

// A square with texture coordinates 0 .. uv.
fs::path write_square(const Folder& folder, const std::string& material, double uv = 1) {
    folder.write("m.mtl", "newmtl m\n" + material);
    std::ostringstream obj;
    obj << "mtllib m.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt " << uv << " 0\nvt " << uv << " " << uv
        << "\nvt 0 " << uv << "\nf 1/1 2/2 3/3 4/4\n";
    return folder.write("m.obj", obj.str());
}

void expect_colour(const std::array<double, 3>& got, double r, double g, double b, double within = 1e-5) {
    EXPECT_NEAR(got[0], r, within);
    EXPECT_NEAR(got[1], g, within);
    EXPECT_NEAR(got[2], b, within);
}

// Colours of OBJ are display colours.
TEST(Material, ObjColoursAreDisplayColours) {
    Folder folder;
    expect_colour(middle(shoot(write_square(folder, "Kd 0.5 1 0.25"))), srgb_to_linear(0.5), 1, srgb_to_linear(0.25));
}

TEST(Material, TextureTexelsInPlace) {
    Folder folder;
    Image texels(4, 4);
    for (int k = 0; k < 48; ++k) texels.rgb[std::size_t(k)] = float(srgb_to_linear((k * 5 + 10) / 255.));
    write_image(folder.path() / "t.png", texels);
    const Image image = shoot(write_square(folder, "Kd 1 1 1\nmap_Kd t.png"));
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) {
            // A texel spans 25 pixels; its centre is that of a pixel, where bilinear filtering gives the texel itself.
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(image.at(70 + 25 * i + 12, 30 + 25 * j + 12)[c] / facing_light, texels.at(i, j)[c], 1e-4)
                    << i << ", " << j;
        }
    }
    // Half way between two texels: their mean in linear light.
    const float* left = image.at(70 + 24, 30 + 12);
    EXPECT_NEAR(left[0] / facing_light, texels.at(0, 0)[0] + (12. / 25) * (texels.at(1, 0)[0] - texels.at(0, 0)[0]), 1e-4);
}

TEST(Material, TextureRepeats) {
    Folder folder;
    Image texels(2, 1);
    texels.at(0, 0)[0] = 1;
    texels.at(1, 0)[2] = 1;
    write_image(folder.path() / "t.png", texels);
    const Image image = shoot(write_square(folder, "map_Kd t.png", 2));
    for (int period = 0; period < 2; ++period) {
        EXPECT_NEAR(image.at(70 + 50 * period + 12, 80)[0] / facing_light, 1, 0.05);
        EXPECT_NEAR(image.at(70 + 50 * period + 37, 80)[2] / facing_light, 1, 0.05);
    }
}

// The largest floats are finite, but what lies between them may not be.
TEST(Material, HugeTextureCoordinatesAreHarmless) {
    Folder folder;
    Image texels(2, 2);
    std::fill(texels.rgb.begin(), texels.rgb.end(), 0.5f);
    write_image(folder.path() / "t.png", texels);
    for (const double uv : {3.4028234e38, -3.4028234e38, 1e20}) {
        folder.write("m.mtl", "newmtl m\nmap_Kd t.png");
        std::ostringstream obj;
        obj.precision(9);
        obj << "mtllib m.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt " << uv << " " << uv << "\nf 1/1 2/1 3/1 4/1\n";
        const Image image = shoot(folder.write("m.obj", obj.str()));
        for (int row = 30; row < 130; ++row) {
            for (int column = 70; column < 170; ++column) ASSERT_NEAR(image.at(column, row)[0] / facing_light, 0.5, 0.01) << uv;
        }
    }
}

// 256 black and white texels over 100 pixels: each pixel covers several, and shows about their mean, not one of them.
TEST(Material, FineTexturesAreAveraged) {
    Folder folder;
    Image texels(256, 256);
    for (int j = 0; j < 256; ++j) {
        for (int i = 0; i < 256; ++i) std::fill_n(texels.at(i, j), 3, (i + j) % 2 ? 1.f : 0.f);
    }
    write_image(folder.path() / "t.png", texels);
    const Image image = shoot(write_square(folder, "map_Kd t.png"));
    for (int row = 32; row < 128; ++row) {
        for (int column = 72; column < 168; ++column) ASSERT_NEAR(image.at(column, row)[0] / facing_light, 0.5, 1e-4);
    }
}

// A gradient of one code a texel, of which a pixel sees two or three, is as bright and where it is at full size; also where halves
// of its size are odd.
TEST(Material, FinerTexelsKeepTheirBrightnessAndPlace) {
    for (const int size : {256, 251}) {
        Folder folder;
        Image texels(size, size);
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) std::fill_n(texels.at(i, j), 3, float(srgb_to_linear(i / 255.)));
        }
        write_image(folder.path() / "t.png", texels);
        const Image image = shoot(write_square(folder, "map_Kd t.png"));
        for (int column = 74; column < 166; ++column) {
            const double code = (column + 0.5 - 70) / 100 * size - 0.5;
            const double per_code = srgb_to_linear((code + 0.5) / 255) - srgb_to_linear((code - 0.5) / 255);
            const double light = image.at(column, 80)[0] / facing_light;
            ASSERT_NEAR((light - srgb_to_linear(code / 255)) / per_code, 0, 0.15) << size << " at " << code;
        }
    }
}

// Rays are shaded in packets of 4 x 4 pixels: here a fine texture, averaged, meets a coarse one, magnified, within one.
TEST(Material, NeighboursAreFilteredEachForItself) {
    Folder folder;
    Image fine(256, 256), coarse(1, 2);
    for (int j = 0; j < 256; ++j) {
        for (int i = 0; i < 256; ++i) std::fill_n(fine.at(i, j), 3, (i + j) % 2 ? 1.f : 0.f);
    }
    coarse.at(0, 0)[0] = 1;
    coarse.at(0, 1)[2] = 1;
    write_image(folder.path() / "fine.png", fine);
    write_image(folder.path() / "coarse.png", coarse);
    folder.write("m.mtl", "newmtl fine\nmap_Kd fine.png\nnewmtl coarse\nmap_Kd coarse.png\n");
    // They meet at x = 0.04, between the columns 121 and 122.
    const Image image = shoot(folder.write(
        "m.obj",
        "mtllib m.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nv -1 -1 0\nv 0.04 -1 0\nv 0.04 1 0\nv -1 1 0\nv 1 -1 0\nv 1 1 0\n"
        "usemtl fine\nf 1/1 2/2 3/3 4/4\nusemtl coarse\nf 2/1 5/2 6/3 3/4\n"));
    for (int row = 53; row < 57; ++row) {  // about the middle of the upper texel
        for (int column = 72; column < 168; ++column) {
            const float* c = image.at(column, row);
            ASSERT_NEAR(c[0] / facing_light, column < 122 ? 0.5 : 1, 0.05) << column;
            ASSERT_NEAR(c[2] / facing_light, column < 122 ? 0.5 : 0, 0.05) << column;
        }
    }
}

// glTF factors are linear light. A triangle in a binary file beside.
TEST(Material, GltfFactorsAreLinear) {
    Folder folder;
    const float corners[9] = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
    folder.write("t.bin", std::string(reinterpret_cast<const char*>(corners), sizeof corners));
    const std::string gltf = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
        "materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1]}}],
        "buffers":[{"uri":"t.bin","byteLength":36}],"bufferViews":[{"buffer":0,"byteLength":36}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[-1,-1,0],"max":[3,3,0]}]})";
    expect_colour(middle(shoot(folder.write("t.gltf", gltf))), 0.5, 0.25, 1);
}

TEST(Material, VertexColours) {
    Folder folder;
    std::ostringstream ply;
    ply << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar "
           "red\nproperty uchar green\n"
           "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"}) ply << corner << " 0 51 102 255\n";
    ply << "4 0 1 2 3\n";
    expect_colour(middle(shoot(folder.write("c.ply", ply.str()))), srgb_to_linear(0.2), srgb_to_linear(0.4), 1, 1e-3);
}

TEST(Material, MissingTextureIsNoted) {
    Folder folder;
    const auto model = load_model(write_square(folder, "Kd 1 1 1\nmap_Kd nowhere.png"));
    EXPECT_EQ(info(*model).textures, 0);
    EXPECT_THAT(info(*model).notes, testing::Contains(testing::HasSubstr("nowhere.png")));
}

// Nothing outside the model's folder is opened: not by .., not by an absolute path, not by a link.
TEST(Material, TexturesComeFromTheModelsFolderOnly) {
    Folder folder;
    Image texel(1, 1);
    texel.rgb = {1, 0, 0};
    write_image(folder.path() / "secret.png", texel);
    Folder inner_model;
    fs::create_symlink(folder.path() / "secret.png", inner_model.path() / "link.png");
    for (const std::string& name : {"../" + folder.path().filename().string() + "/secret.png",
                                    (folder.path() / "secret.png").string(), std::string("link.png")}) {
        const auto model = load_model(write_square(inner_model, "map_Kd " + name));
        EXPECT_EQ(info(*model).textures, 0) << name;
    }
    write_image(inner_model.path() / "secret.png", texel);
    EXPECT_EQ(info(*load_model(write_square(inner_model, "map_Kd C:\\art\\Secret.PNG"))).textures, 1);
}

// What has no texture to show is grey, and it is said once.
TEST(Material, MissingTexturesAreGrey) {
    Folder folder;
    expect_colour(middle(shoot(write_square(folder, "Kd 1 0 0\nmap_Kd nowhere.png"))), 0.5, 0.5, 0.5);
    write_image(folder.path() / "t.png", Image(2, 2));
    folder.write("m.mtl", "newmtl m\nmap_Kd t.png\n");
    const auto bare = folder.write("bare.obj",
                                   "mtllib m.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\no b\n"
                                   "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nusemtl m\nf 5 6 7\n");
    expect_colour(middle(shoot(bare)), 0.5, 0.5, 0.5);
    EXPECT_THAT(info(*load_model(bare)).notes, testing::Contains(testing::HasSubstr("no texture coordinates")).Times(1));
}

// A tint of a texture is left out, which is said; greys are what exporters fill in.
TEST(Material, TintsOfObjTexturesAreNoted) {
    Folder folder;
    Image texel(1, 1);
    texel.rgb = {1, 1, 1};
    write_image(folder.path() / "t.png", texel);
    const auto tinted = write_square(folder, "Kd 1 0 0\nmap_Kd t.png");
    expect_colour(middle(shoot(tinted)), 1, 1, 1);
    EXPECT_THAT(info(*load_model(tinted)).notes, testing::ElementsAre(testing::HasSubstr("tints")));
    EXPECT_THAT(info(*load_model(write_square(folder, "Kd 0.8 0.8 0.8\nmap_Kd t.png"))).notes, testing::IsEmpty());
}

TEST(Material, ObjVertexColoursAreDisplayColours) {
    Folder folder;
    std::ostringstream obj;
    for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"}) obj << "v " << corner << " 0 0.5 1 0.25\n";
    obj << "f 1 2 3 4\n";
    expect_colour(middle(shoot(folder.write("c.obj", obj.str()))), srgb_to_linear(0.5), 1, srgb_to_linear(0.25));
}

// A fold of 40 degrees without normals: smoothed in general, flat where the file says so; sharper ones stay edges; and the file's
// own normals hold.
TEST(Material, ObjNormals) {
    Folder folder;
    const auto slope = [&](const std::string& smoothing, const std::string& normals, const std::string& face) {
        const double h = std::tan(20 * M_PI / 180);
        std::ostringstream obj;
        obj << "v -1 -1 0\nv 0 -1 " << h << "\nv 0 1 " << h << "\nv -1 1 0\nv 1 -1 0\nv 1 1 0\n" << normals << smoothing << face;
        const Image image = shoot(folder.write("f.obj", obj.str()));
        return std::abs(image.at(121, 80)[0] - image.at(118, 80)[0]) / image.at(120, 80)[0];
    };
    const std::string faces = "f 1 2 3 4\nf 2 5 6 3\n";
    EXPECT_LT(slope("", "", faces), 0.03);
    EXPECT_LT(slope("s 1\n", "", faces), 0.03);
    EXPECT_GT(slope("s off\n", "", faces), 0.15);
    EXPECT_GT(slope("s 0\n", "", faces), 0.15);
    EXPECT_LT(slope("s off\n", "vn 0 0 1\n", "f 1//1 2//1 3//1 4//1\nf 2//1 5//1 6//1 3//1\n"), 1e-6);
}

}  // namespace
