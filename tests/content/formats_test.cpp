// PLY, and what OBJ and other texts hold beside plain meshes.
#include "image/formats/encoding.h"
#include "image/formats/image_file.h"
#include "refused.h"
#include "seen_square.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

using namespace small_world;

// Red, green above; blue, white below.
void write_quarters(const Folder& folder) {
    Image texels(64, 64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            for (int c = 0; c < 3; ++c) texels.at(x, y)[c] = (y < 32 ? (x < 32 ? c == 0 : c == 1) : x >= 32 || c == 2) ? 1.f : 0.f;
    write_image(folder.path() / "quarters.png", texels);
}

// Width over height, a million times more accurate than a picture.
double aspect(const fs::path& file) {
    const Display d = display();
    const Vec3d half = half_size_mm({load_model(file)}, d, resolve(d));
    return half[0] / half[1];
}

TEST(Ply, ColoursOfFaces) {
    Folder folder;
    const std::string header = xyz +
                               "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\n"
                               "property uchar blue\n";
    const Image image = photo(folder.write("f.ply", ply(header, std::string(square) + "3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n")));
    EXPECT_EQ(colour_at(image, 0.5, -0.5), "red");
    EXPECT_EQ(colour_at(image, -0.5, 0.5), "blue");
}

// As some programs call them, as floats and shorts.
TEST(Ply, ColoursOfVertices) {
    Folder folder;
    for (const auto& [type, full] : {std::pair("float", "1"), std::pair("ushort", "65535"), std::pair("uchar", "255")}) {
        std::string header = "element vertex 4\nproperty double x\nproperty double y\nproperty double z\n", body;
        for (const char* name : {"diffuse_red", "diffuse_green", "diffuse_blue"})
            header += std::string("property ") + type + " " + name + "\n";
        for (const char* corner : {"-1 -1", "1 -1", "1 1", "-1 1"}) body += std::string(corner) + " 0 0 " + full + " 0\n";
        header += "element face 1\nproperty list uchar uint vertex_index\n";
        EXPECT_EQ(colour_at(photo(folder.write("v.ply", ply(header, body + "4 0 1 2 3\n"))), 0, 0.1), "green") << type;
    }
}

// Each triangle shows one quarter of the picture; the vertices are shared.
TEST(Ply, TextureCoordinatesOfCorners) {
    Folder folder;
    write_quarters(folder);
    const std::string header =
        "comment TextureFile quarters.png\nelement vertex 5\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 4\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\n";
    const auto file =
        folder.write("w.ply", ply(header, std::string(square) +
                                              "0 0 0\n3 0 1 4 6 0.15 0.65 0.35 0.65 0.25 0.85\n"
                                              "3 1 2 4 6 0.65 0.65 0.85 0.65 0.75 0.85\n3 2 3 4 6 0.15 0.15 0.35 0.15 0.25 0.35\n"
                                              "3 3 0 4 6 0.65 0.15 0.85 0.15 0.75 0.35\n"));
    const Image image = photo(file);
    EXPECT_EQ(colour_at(image, 0, -0.6), "red");
    EXPECT_EQ(colour_at(image, 0.6, 0), "green");
    EXPECT_EQ(colour_at(image, 0, 0.6), "blue");
    EXPECT_EQ(colour_at(image, -0.6, 0), "white");
}

TEST(Ply, SeveralTextures) {
    Folder folder;
    Image texel(1, 1);
    texel.rgb = {1, 0, 0};
    write_image(folder.path() / "a picture.png", texel);
    texel.rgb = {0, 0, 1};
    write_image(folder.path() / "b.png", texel);
    const std::string header =
        "comment TextureFile a picture.png\ncomment TextureFile b.png\n" + xyz +
        "element face 2\nproperty list uchar int vertex_indices\nproperty list uchar float texcoord\nproperty int "
        "texnumber\n";
    const Image image =
        photo(folder.write("t.ply", ply(header, std::string(square) + "3 0 1 2 6 0 0 1 0 1 1 1\n3 0 2 3 6 0 0 1 1 0 1 0\n")));
    EXPECT_EQ(colour_at(image, 0.5, -0.5), "blue");
    EXPECT_EQ(colour_at(image, -0.5, 0.5), "red");
}

// Binary, as big-endian doubles, in strips, where float would be half a unit off, of three thousandths.
TEST(Ply, StripsFarFromTheOrigin) {
    Folder folder;
    std::string body;
    const auto put = [&](auto x) {
        char bytes[sizeof x];
        std::copy_n(reinterpret_cast<const char*>(&x), sizeof x, bytes);
        std::reverse(bytes, bytes + sizeof x);
        body.append(bytes, sizeof x);
    };
    for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
        put(691000.3 + 0.003 * x);
        put(5334000.7 + 0.0015 * y);
        put(12.5);
    }
    put(std::int32_t(7));
    for (const std::int32_t i : {0, 1, 2, -1, 2, 1, 3}) put(i);
    const std::string head =
        "ply\r\nformat binary_big_endian 1.0\r\nelement vertex 4\r\nproperty double x\r\nproperty double y\r\n"
        "property double z\r\nelement tristrips 1\r\nproperty list int int vertex_indices\r\nend_header\r\n";
    const auto file = folder.write("s.ply", head + body);
    EXPECT_EQ(info(*load_model(file)).triangles, 2);
    EXPECT_NEAR(aspect(file), 2, 2e-6);  // of numbers whose last bit is 9.3e-10
    EXPECT_EQ(colour_at(photo(file), 1.5, 0.5), "white");
}

TEST(Ply, WhatIsNoMeshIsNamed) {
    Folder folder;
    EXPECT_THAT(refused(folder.write("p.ply", ply(xyz, square))), testing::HasSubstr("holds 4 points and no triangles"));
    EXPECT_THAT(refused(folder.write("h.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\npr")),
                testing::HasSubstr("header has no end"));
    EXPECT_THAT(refused(folder.write("n.ply", "nothing at all\n")), testing::HasSubstr("does not begin like a PLY file"));
    const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
    EXPECT_THAT(refused(folder.write("c.ply", ply(xyz + face, "-1 -1 0\n1 -1"))), testing::HasSubstr("cut short"));
    EXPECT_THAT(refused(folder.write("w.ply", ply(xyz + face, "-1 -1 zero\n"))), testing::HasSubstr("a word"));
    EXPECT_THAT(refused(folder.write("i.ply", ply(xyz + face, std::string(square) + "3 0 1 9\n"))),
                testing::HasSubstr("do not exist"));
    EXPECT_THAT(refused(folder.write("l.ply", ply(xyz + face, std::string(square) + "4000000000 0 1 2\n"))),
                testing::HasSubstr("damaged"));
    EXPECT_THAT(refused(folder.write("t.ply", ply(xyz + "property quad w\n" + face, square))), testing::HasSubstr("unknown type"));
}

TEST(Ply, FacesOfTwoCornersAreNoted) {
    Folder folder;
    const auto file = folder.write(
        "e.ply", ply(xyz + "element face 2\nproperty list uchar int vertex_indices\n", std::string(square) + "4 0 1 2 3\n2 0 2\n"));
    EXPECT_THAT(info(*load_model(file)).notes, testing::ElementsAre("points and lines are not shown"));
}

TEST(Ply, WhatIsLeftOutIsSaid) {
    Folder folder;
    const std::string header =
        xyz +
        "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
        "property list uchar int vertex_indices\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element edge 1\nproperty int vertex1\nproperty int vertex2\n";
    const auto file = folder.write(
        "b.ply", ply(header, "-1 -1 0 0 255 0\n1 -1 0 0 255 0\n1 1 0 0 255 0\n-1 1 0 0 255 0\n4 0 1 2 3 255 0 0\n0 1\n"));
    EXPECT_EQ(colour_at(photo(file), 0, 0.1), "green");
    EXPECT_THAT(info(*load_model(file)).notes,
                testing::ElementsAre("colours of faces beside those of vertices and its elements \"edge\" are not shown"));
}

// An ellipse of 48 corners, 3 m wide and 0.6 m high, on a map's grid, as each format writes it. Its points are given to 0.1 mm.
std::vector<std::string> corners_of_ellipse() {
    std::vector<std::string> corners;
    for (int k = 0; k < 48; ++k) {
        char text[100];
        std::snprintf(text, sizeof text, "%.4f %.4f 12.5", 691000.5 + 1.5 * std::cos(k * M_PI / 24),
                      5334000.25 + 0.3 * std::sin(k * M_PI / 24));
        corners.push_back(text);
    }
    return corners;
}

TEST(FarFromTheOrigin, TextsKeepTheirAccuracy) {
    Folder folder;
    std::string obj, off = "OFF\n48 46 0\n", stl = "solid ellipse\n", faces;
    const std::vector<std::string> corner = corners_of_ellipse();
    for (std::size_t k = 0; k < 48; ++k) {
        obj += "v " + corner[k] + " 0.5 0.5 0.5\n";
        off += corner[k] + "\n";
        if (k < 2) continue;
        faces += "3 0 " + std::to_string(k - 1) + " " + std::to_string(k) + "\n";
        stl += "facet normal 0 0 1\nouter loop\n";
        for (const std::size_t i : {std::size_t(0), k - 1, k}) stl += "vertex " + corner[i] + "\n";
        stl += "endloop\nendfacet\n";
    }
    obj += "f";
    for (int k = 1; k <= 48; ++k) obj += " " + std::to_string(k);
    EXPECT_NEAR(aspect(folder.write("d.obj", obj + "\n")), 5, 1e-5);
    EXPECT_NEAR(aspect(folder.write("d.off", off + faces)), 5, 1e-5);
    LoadOptions as_it_lies;
    as_it_lies.up = "y";
    const Display d = display();
    const Vec3d half = half_size_mm({load_model(folder.write("d.stl", stl + "endsolid\n"), as_it_lies)}, d, resolve(d));
    EXPECT_NEAR(half[0] / half[1], 5, 1e-5);
    EXPECT_THAT(info(*load_model(folder.path() / "d.obj")).notes, testing::IsEmpty());
}

// Assimp keeps floats of what it reads by itself: what that loses is said.
TEST(FarFromTheOrigin, WhatFloatsRoundIsSaid) {
    Folder folder;
    const auto amf = [&](double x) {
        std::ostringstream text;
        text.precision(12);
        text << "<?xml version=\"1.0\"?><amf unit=\"meter\"><object id=\"0\"><mesh><vertices>";
        for (const auto& [u, v] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
            text << "<vertex><coordinates><x>" << x + u << "</x><y>0</y><z>" << v << "</z></coordinates></vertex>";
        text << "</vertices><volume><triangle><v1>0</v1><v2>1</v2><v3>2</v3></triangle><triangle><v1>0</v1><v2>2</v2><v3>3</v3></"
                "triangle>"
                "</volume></mesh></object></amf>";
        return info(*load_model(folder.write("a.amf", text.str()))).notes;
    };
    EXPECT_THAT(amf(5334000), testing::ElementsAre(testing::HasSubstr("details below 0.1 of the model's size")));
    EXPECT_THAT(amf(3), testing::IsEmpty());
}

// A pyramid with a square base, in each format; its numbers are written times `unit`.
std::vector<fs::path> write_pyramids(const Folder& folder, double unit) {
    const std::vector<std::array<double, 3>> corner{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0.31, 0.23, 1}};
    const std::vector<std::vector<int>> face{{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    const std::array<std::array<int, 3>, 6> triangle{{{3, 2, 1}, {3, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}};
    std::string obj, faces, places, off = "OFF\n5 5 0\n", stl = "solid p\n", triangles, amf, volume, bytes, indices;
    std::string binary = std::string(80, ' ') + std::string("\6\0\0\0", 4);
    const auto text = [&](int k) {
        char out[100];
        const auto& c = corner[std::size_t(k)];
        std::snprintf(out, sizeof out, "%.9g %.9g %.9g", c[0] * unit, c[1] * unit, c[2] * unit);
        return std::string(out);
    };
    const auto put = [&](std::string& to, int k) {
        for (const double x : corner[std::size_t(k)]) {
            const auto value = float(x * unit);
            to.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
    };
    for (int k = 0; k < 5; ++k) {
        places += text(k) + "\n";
        obj += "v " + text(k) + "\n";
        std::istringstream words(text(k));
        amf += "<vertex><coordinates>";
        for (const char* name : {"x", "y", "z"}) {
            std::string word;
            words >> word;
            amf += std::string("<") + name + ">" + word + "</" + name + ">";
        }
        amf += "</coordinates></vertex>";
        put(bytes, k);
    }
    for (const auto& f : face) {
        obj += "f";
        faces += std::to_string(f.size());
        for (const int k : f) obj += " " + std::to_string(k + 1), faces += " " + std::to_string(k);
        obj += "\n", faces += "\n";
    }
    for (const auto& [a, b, c] : triangle) {
        stl += "facet normal 0 0 0\nouter loop\n";
        binary += std::string(12, '\0');
        for (const int k : {a, b, c}) {
            stl += "vertex " + text(k) + "\n";
            put(binary, k);
            indices += std::string{char(k), '\0'};
        }
        stl += "endloop\nendfacet\n";
        binary += std::string(2, '\0');
        volume += "<triangle><v1>" + std::to_string(a) + "</v1><v2>" + std::to_string(b) + "</v2><v3>" + std::to_string(c) +
                  "</v3></triangle>";
    }
    folder.write("p.bin", bytes + indices);
    const std::string header =
        "element vertex 5\nproperty double x\nproperty double y\nproperty double z\nelement face 5\n"
        "property list uchar int vertex_indices\n";
    return {folder.write("p.obj", obj),
            folder.write("p.off", off + places + faces),
            folder.write("p.stl", stl + "endsolid\n"),
            folder.write("b.stl", binary),
            folder.write("p.ply", ply(header, places + faces)),
            folder.write("p.amf", "<?xml version=\"1.0\"?><amf><object id=\"0\"><mesh><vertices>" + amf + "</vertices><volume>" +
                                      volume + "</volume></mesh></object></amf>"),
            folder.write("p.gltf", R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
                "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],
                "buffers":[{"uri":"p.bin","byteLength":96}],
                "bufferViews":[{"buffer":0,"byteLength":60},{"buffer":0,"byteOffset":60,"byteLength":36}],
                "accessors":[{"bufferView":0,"componentType":5126,"count":5,"type":"VEC3"},
                             {"bufferView":1,"componentType":5123,"count":18,"type":"SCALAR"}]})")};
}

// A model looks the same at any size that floats hold: no threshold of a length is seen.
TEST(AnySize, LooksTheSame) {
    Folder folder;
    std::vector<Image> usual;
    for (const fs::path& file : write_pyramids(folder, 1)) usual.push_back(photo(file));
    for (const double unit : {1e-30, 2e-12, 1e-9, 1e-7, 1e-5, 1e9, 1e16, 1e34}) {
        std::size_t k = 0;
        for (const fs::path& file : write_pyramids(folder, unit)) {
            const Image& same = usual[k++];
            const Image image = photo(file);
            double difference = 0, light = 0;
            for (std::size_t i = 0; i < image.rgb.size(); ++i) {
                difference += std::abs(double(image.rgb[i]) - same.rgb[i]);
                light += same.rgb[i];
            }
            EXPECT_LT(difference, 1e-3 * light) << file.filename() << " of " << unit << " units";
            EXPECT_THAT(info(*load_model(file)).notes, testing::IsEmpty());
        }
    }
}

// Vertices of no face lie anywhere; scanners mark what they did not see by the largest float.
TEST(AnySize, OtherVerticesDoNotCount) {
    Folder folder;
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n", one = "4 0 1 2 3\n";
    const Image usual = photo(folder.write("u.ply", ply(xyz + faces, square + one)));
    for (const char* stray : {"1e12 0 0\n", "0 3.4e38 0\n"}) {
        const std::string header = "element vertex 5\n" + xyz.substr(xyz.find("property"));
        EXPECT_EQ(photo(folder.write("s.ply", ply(header + faces, square + (stray + one)))).rgb, usual.rgb) << stray;
    }
}

// The square is covered by texture coordinates from 0 to 1; "-s 0.5 0.5" shows the lower left quarter, "-o" moves it.
TEST(Obj, TextureOptions) {
    Folder folder;
    write_quarters(folder);
    const auto shown = [&](const std::string& options) {
        folder.write("m.mtl", "newmtl m one\nmap_Kd " + options + " quarters.png\n");
        return photo(
            folder.write("m.obj",
                         "mtllib m.mtl\nusemtl m one\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                         "f 1/1 2/2 3/3 4/4\n"));
    };
    EXPECT_EQ(colour_at(shown(""), -0.5, 0.5), "red");
    EXPECT_EQ(colour_at(shown("-s 0.4 0.4 1"), 0.5, 0.5), "blue");
    EXPECT_EQ(colour_at(shown("-o 0.5 0 -s 0.4 0.4"), 0.5, 0.5), "white");
    EXPECT_EQ(colour_at(shown("-blendu on -s 0.4 0.4 -o 0 0.55 0 -clamp on"), 0.5, 0.5), "red");
    EXPECT_THAT(info(*load_model(folder.path() / "m.obj")).notes, testing::IsEmpty());
    shown("-mm 0.2 0.5");
    EXPECT_THAT(info(*load_model(folder.path() / "m.obj")).notes, testing::ElementsAre("options -mm of textures are not shown"));
}

// A colour of one number is grey; what is no number from 0 to 1 is noted.
TEST(Obj, ColoursOfOneNumber) {
    Folder folder;
    const auto write = [&](const std::string& colour) {
        folder.write("k.mtl", "newmtl m\nKd " + colour + "\n");
        return folder.write("k.obj", "mtllib k.mtl\nusemtl m\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
    };
    const Image grey = photo(write("0.5 0.5 0.5"));
    EXPECT_EQ(photo(write("0.5")).rgb, grey.rgb);
    EXPECT_EQ(photo(write(" 0.5\t\r")).rgb, grey.rgb);
    EXPECT_EQ(photo(write("0.5 # of light")).rgb, grey.rgb);
    EXPECT_THAT(info(*load_model(write("0.5"))).notes, testing::IsEmpty());
    EXPECT_THAT(refused(write("0.5 0.2")), testing::HasSubstr("k.mtl, line 2: a colour (Kd) has one or three numbers, this one 2"));
    for (const char* colour : {"5 -1 0", "0 1 nan", "1.01"})
        EXPECT_THAT(info(*load_model(write(colour))).notes,
                    testing::ElementsAre("colours that are not numbers from 0 to 1 are not shown"));
}

TEST(Obj, WhatIsNoTriangleIsNoted) {
    Folder folder;
    const std::string white = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
    const auto notes = [&](const std::string& more) { return info(*load_model(folder.write("n.obj", white + more))).notes; };
    EXPECT_THAT(notes(""), testing::IsEmpty());
    for (const char* more : {"f 1 3\n", "f 1\n", "f 1", "l 1 3\n", "p 1\n"})
        EXPECT_THAT(notes(more), testing::ElementsAre("points and lines are not shown")) << more;
    for (const char* more : {"cstype bezier\ndeg 3 3\nsurf 0 1 0 1 1 2 3 4\nend\n", "curv 0 1 1 2 3\n"})
        EXPECT_THAT(notes(more), testing::ElementsAre("free-form curves and surfaces are not shown")) << more;
    EXPECT_THAT(refused(folder.write("l.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 3\n")),
                testing::HasSubstr("has no triangles: nothing to show (points and lines are not shown)"));
}

}  // namespace
