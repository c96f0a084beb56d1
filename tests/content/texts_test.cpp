// Texts and STL files that Assimp would misread, and are read rightly.
#include "image/formats/image_file.h"
#include "refused.h"
#include "seen_square.h"

#include <cstdint>

namespace {

using namespace small_world;

// The mark is no part of the first word: here the name of a library, a vertex, a keyword.
TEST(Texts, ByteOrderMark) {
    Folder folder;
    const std::string mark = "\xef\xbb\xbf", faces = "f 1 2 3 4\n";
    folder.write("b.mtl", mark + "newmtl m\nKd 1 0 0\n");
    const std::string vertices = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";
    EXPECT_EQ(colour_at(photo(folder.write("l.obj", mark + "mtllib b.mtl\nusemtl m\n" + vertices + faces)), 0, 0.1), "red");
    EXPECT_EQ(photo(folder.write("b.obj", mark + vertices + "v 9 9 9\n" + faces)).rgb,
              photo(folder.write("p.obj", vertices + "v 9 9 9\n" + faces)).rgb);
    const std::string polygons =
        ply(xyz + "element face 1\nproperty list uchar int vertex_indices\n", square + std::string("4 0 1 2 3\n"));
    EXPECT_EQ(info(*load_model(folder.write("b.ply", mark + polygons))).triangles, 2);
    EXPECT_EQ(info(*load_model(folder.write("b.off", mark + "OFF\n4 1 0\n" + square + "4 0 1 2 3\n"))).triangles, 2);
}

TEST(Obj, SeveralLibrariesInALine) {
    Folder folder;
    folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("with blank.mtl", "newmtl b\nKd 0 0 1\n");
    const auto file = folder.write("l.obj",
                                   "mtllib a.mtl with blank.mtl \r\no l\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
                                   "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    const Image image = photo(file);
    EXPECT_EQ(colour_at(image, 0.5, -0.5), "red");
    EXPECT_EQ(colour_at(image, -0.5, 0.5), "blue");
    EXPECT_THAT(info(*load_model(file)).notes, testing::IsEmpty());
}

// The first material of the faces is not the last of the libraries; another one is in none of them.
TEST(Obj, SeveralLinesOfLibraries) {
    Folder folder;
    folder.write("a.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("b.mtl", "newmtl b\nKd 0 0 1\n");
    const std::string begin = "mtllib a.mtl\nmtllib b.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nusemtl a\nf 1 2 3\nusemtl ";
    const auto file = folder.write("l.obj", begin + "b\nf 1 3 4\n");
    const Image image = photo(file);
    EXPECT_EQ(colour_at(image, 0.5, -0.5), "red");
    EXPECT_EQ(colour_at(image, -0.5, 0.5), "blue");
    EXPECT_THAT(info(*load_model(file)).notes, testing::IsEmpty());
    EXPECT_THAT(info(*load_model(folder.write("c.obj", begin + "c\nf 1 3 4\n"))).notes,
                testing::ElementsAre("material \"c\" is in no material file: shown grey"));
}

TEST(Stl, KeywordsInCapitals) {
    Folder folder;
    for (const char* text :
         {"SOLID A Facet NORMAL\n  FACET NORMAL 0 0 1\n    OUTER LOOP\n VERTEX -1 -1 0\n VERTEX 1 -1 0\n VERTEX 1E0 1 0\n"
          "    ENDLOOP\n  ENDFACET\nENDSOLID\n",
          "solid a\nFacet Normal 0 0 1\nOuter Loop\nVertex -1 -1 0\nVertex 1 -1 0\nVertex 1 1 0\nEndLoop\nEndFacet\n"
          "EndSolid a\n"})
        EXPECT_EQ(info(*load_model(folder.write("c.stl", text))).triangles, 1) << text;
}

// Two triangles, lower right and upper left. Materialise: bit 15 set is the header's colour, clear the facet's own, red in the
// lowest bits. VisCAM: set is the facet's own, red in the highest bits.
TEST(Stl, ColoursOfFacets) {
    Folder folder;
    const auto shown = [&](std::string header, std::uint16_t first, std::uint16_t second) {
        header.resize(80, ' ');
        std::string bytes = header + std::string("\2\0\0\0", 4);
        const float corners[2][12] = {{0, 0, 1, -1, -1, 0, 1, -1, 0, 1, 1, 0}, {0, 0, 1, -1, -1, 0, 1, 1, 0, -1, 1, 0}};
        for (int k = 0; k < 2; ++k) {
            bytes.append(reinterpret_cast<const char*>(corners[k]), sizeof corners[k]);
            const std::uint16_t code = k == 0 ? first : second;
            bytes += {char(code & 255), char(code >> 8)};
        }
        LoadOptions as_it_lies;
        as_it_lies.up = "y";
        const Image image = photo(folder.write("f.stl", bytes), as_it_lies);
        return colour_at(image, 0.5, -0.5) + " " + colour_at(image, -0.5, 0.5);
    };
    const std::string green = "COLOR=" + std::string("\0\xff\0\xff", 4);
    EXPECT_EQ(shown(green, 0xffff, 0xffff), "green green");
    EXPECT_EQ(shown(green, 31, 0x8000), "red green");
    EXPECT_EQ(shown(green, 31, 31 << 10), "red blue");
    EXPECT_EQ(shown(green, 0, 0), "green green");
    EXPECT_EQ(shown("VisCAM", 0x8000 | 31 << 10, 0x8000 | 31), "red blue");
}

// Colours of vertices are numbers of 0 to 1 or codes of 0 to 255; those of faces are not shown.
TEST(Off, Colours) {
    Folder folder;
    const auto vertices = [](const std::string& colour) {
        return "COFF\n4 1 0\n-1 -1 0 " + colour + "\n1 -1 0 " + colour + "\n1 1 0 " + colour + "\n-1 1 0 " + colour +
               "\n4 0 1 2 3\n";
    };
    const fs::path numbers = folder.write("n.off", vertices("0.6 0.2 0.4 1")),
                   codes = folder.write("c.off", vertices("153 51 102 255"));
    EXPECT_NEAR(photo(codes).at(40, 30)[0], photo(numbers).at(40, 30)[0], 1e-5);
    EXPECT_THAT(info(*load_model(codes)).notes, testing::IsEmpty());
    const std::string square = "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n4 0 1 2 3";
    for (const char* header : {"OFF\n4 1 0\n", "OFF\n# of faces\n4 1 0\n"}) {
        EXPECT_THAT(info(*load_model(folder.write("f.off", header + square + "\n"))).notes, testing::IsEmpty()) << header;
        for (const char* colour : {" 255 0 0\n", " 1. 0. 0.\n", " 3\n"})
            EXPECT_THAT(info(*load_model(folder.write("f.off", header + square + colour))).notes,
                        testing::ElementsAre("colours of OFF faces are not shown"))
                << header << colour;
    }
}

TEST(X3d, ColoursOfFacesAreNoted) {
    Folder folder;
    const auto notes = [&](const std::string& per_vertex) {
        return info(*load_model(folder.write(
                        "f.x3d", "<?xml version=\"1.0\"?><X3D><Scene><Shape><IndexedFaceSet coordIndex=\"0 1 2 -1 0 2 3 -1\" " +
                                     per_vertex +
                                     "><Coordinate point=\"-1 -1 0 1 -1 0 1 1 0 -1 1 0\"/><Color color=\"1 0 0 0 1 0 "
                                     "0 1 0 1 0 0\"/></IndexedFaceSet></Shape></Scene></X3D>")))
            .notes;
    };
    EXPECT_THAT(notes(""), testing::IsEmpty());
    for (const char* of_faces : {"colorPerVertex=\"false\"", "colorPerVertex='false'"})
        EXPECT_THAT(notes(of_faces), testing::ElementsAre(testing::HasSubstr("colours of X3D faces")));
}

TEST(Ply, TextureWithoutCoordinatesLeavesColours) {
    Folder folder;
    const std::string
        header =
            "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
            "property uchar blue\nelement face 1\nproperty list uchar int vertex_indices\n",
        body = "-1 -1 0 255 0 0\n1 -1 0 255 0 0\n1 1 0 255 0 0\n-1 1 0 255 0 0\n4 0 1 2 3\n";
    const fs::path plain = folder.write("p.ply", ply(header, body)),
                   named = folder.write("t.ply", ply("comment TextureFile quarters.png\n" + header, body));
    write_image(folder.path() / "quarters.png", Image(64, 64));
    EXPECT_EQ(photo(named).rgb, photo(plain).rgb);
    EXPECT_THAT(info(*load_model(named)).notes,
                testing::ElementsAre("textures of a PLY file without texture coordinates are not shown"));
}

TEST(Stl, WhatIsCutShortIsNamed) {
    Folder folder;
    std::string bytes(84, '\0');
    bytes[80] = 2;
    for (const std::size_t length : {164, 221})
        EXPECT_THAT(refused(folder.write("s.stl", bytes + std::string(length - bytes.size(), '\1'))),
                    testing::HasSubstr("is damaged: it names 2 triangles, for which it must have 184 bytes; it has " +
                                       std::to_string(length)));
}

}  // namespace
