// Texts and STL files that Assimp would misread, and are read rightly.
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

}  // namespace
