// Where a model's sides go: up axis, tilt, yaw, place and size.
#include "small_world.h"

#include <cmath>

namespace {

using namespace small_world;

// A box of 2 x 4 x 6 units with its corner at (10, 20, 30), each side in a colour of its own: -x white, +x blue, +y yellow,
// -y cyan, +z red, -z green.
fs::path write_box(const Folder& folder) {
    folder.write("box.mtl",
                 "newmtl left\nKd 1 1 1\nnewmtl right\nKd 0 0 1\nnewmtl top\nKd 1 1 0\nnewmtl bottom\nKd 0 1 1\n"
                 "newmtl front\nKd 1 0 0\nnewmtl back\nKd 0 1 0\n");
    std::ostringstream obj;
    obj << "mtllib box.mtl\no box\n";
    for (int k = 0; k < 8; ++k) obj << "v " << 10 + 2 * (k & 1) << " " << 20 + 4 * (k >> 1 & 1) << " " << 30 + 6 * (k >> 2) << "\n";
    obj << "usemtl left\nf 1 5 7 3\nusemtl right\nf 2 4 8 6\nusemtl top\nf 3 7 8 4\nusemtl bottom\nf 1 2 6 5\n"
           "usemtl front\nf 5 6 8 7\nusemtl back\nf 1 3 4 2\n";
    return folder.write("box.obj", obj.str());
}

struct View {
    std::string colour;
    double width_mm, height_mm;
};

// What a distant camera sees: the colour in the middle, and the extents of what is not black (0.2 mm a pixel).
View look(const fs::path& model, double tilt_deg, double yaw_deg, const std::string& up = "") {
    Display d = display();
    d.content.tilt_deg = tilt_deg;
    d.content.yaw_deg = yaw_deg;
    d.content.height_mm = 12;
    d.camera.position_mm = {0, 0, 1e6};
    LoadOptions options;
    options.up = up;
    const Geometry g = resolve(d);
    Job job;
    const Picture p = reference_photograph(d, g, ContentScene(load_model(model, options), d, g), 0, {}, job);
    int x0 = 240, x1 = 0, y0 = 160, y1 = 0;
    for (int row = 0; row < 160; ++row) {
        for (int column = 0; column < 240; ++column) {
            const float* c = p.image.at(column, row);
            if (c[0] + c[1] + c[2] == 0) continue;
            x0 = std::min(x0, column), x1 = std::max(x1, column + 1), y0 = std::min(y0, row), y1 = std::max(y1, row + 1);
        }
    }
    EXPECT_EQ(x0 + x1, 240);  // centred
    EXPECT_EQ(y0 + y1, 160);
    const float* c = p.image.at(120, 80);
    return {std::string(c[0] > 0.5 ? "r" : "") + (c[1] > 0.5 ? "g" : "") + (c[2] > 0.5 ? "b" : ""), 0.2 * (x1 - x0),
            0.2 * (y1 - y0)};
}

void expect(const View& v, const std::string& colour, double width, double height) {
    EXPECT_EQ(v.colour, colour);
    EXPECT_NEAR(v.width_mm, width, 0.2);
    EXPECT_NEAR(v.height_mm, height, 0.2);
}

TEST(Pose, YUpIsTakenAsItIs) {
    Folder folder;
    const fs::path box = write_box(folder);
    expect(look(box, 0, 0), "r", 6, 12);
    expect(look(box, 0, 0, "y"), "r", 6, 12);
}

// +z goes up, and what looked along -y looks at the viewer.
TEST(Pose, ZUpIsTurned) {
    Folder folder;
    expect(look(write_box(folder), 0, 0, "z"), "gb", 4, 12);
}

// Counter-clockwise seen from above: the front goes to the viewer's right, the left side comes before the viewer.
TEST(Pose, Yaw) {
    Folder folder;
    const fs::path box = write_box(folder);
    expect(look(box, 0, 90), "rgb", 18, 12);
    expect(look(box, 0, -90), "b", 18, 12);
    expect(look(box, 0, 180), "g", 6, 12);
}

// Positive raises the front, so that the bottom comes before the viewer; the yaw comes after it.
TEST(Pose, Tilt) {
    Folder folder;
    const fs::path box = write_box(folder);
    expect(look(box, 90, 0), "gb", 4, 12);
    expect(look(box, -90, 0), "rg", 4, 12);
    expect(look(box, 90, 90), "rgb", 8, 12);
}

// STL lies with z up by custom; it has no colours.
TEST(Pose, FormatsHaveTheirOwnAxes) {
    Folder folder;
    // A wedge: 1 deep along y, 1 wide, 3 high along z.
    const std::string stl =
        "solid w\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0 3\nendloop\nendfacet\n"
        "facet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 3\nvertex 0 0 3\nendloop\nendfacet\nendsolid w\n";
    const View v = look(folder.write("w.stl", stl), 0, 0);
    EXPECT_NEAR(v.width_mm, 4, 0.2);
    EXPECT_NEAR(v.height_mm, 12, 0.2);
}

TEST(Pose, LyingFlatIsAnErrorWithARemedy) {
    Folder folder;
    const fs::path flat = folder.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    try {
        look(flat, 0, 0);
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr("tilt"));
    }
    look(flat, -90, 0);
}

TEST(Pose, UnknownUpIsAnError) {
    Folder folder;
    EXPECT_THROW(look(write_box(folder), 0, 0, "x"), InputError);
}

}  // namespace
