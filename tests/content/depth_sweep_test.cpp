// A scene moved along z against scenes made where it goes.
#include "image/formats/image_file.h"
#include "small_world.h"

namespace {

using namespace small_world;

// Several surfaces, one of them with a texture, whose mip level follows the width of the rays, and so the depth.
fs::path write_scene(const Folder& folder) {
    Image texels(64, 64);
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 64; ++i) std::fill_n(texels.at(i, j), 3, float((i * 7 + j * 13) % 11) / 11);
    write_image(folder.path() / "t.png", texels);
    folder.write("s.mtl", "newmtl plain\nKd 1 0.4 0.2\nnewmtl fine\nmap_Kd t.png\n");
    return folder.write("s.obj",
                        "mtllib s.mtl\nusemtl plain\nv -9 -10 -4\nv 9 -10 -2\nv 0 10 -3\nf 1 2 3\n"
                        "usemtl fine\nv -8 -8 0\nv 8 -8 3\nv 8 8 4\nv -8 8 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/1 5/2 6/3 7/4\n");
}

class DepthSweep : public testing::Test {
  protected:
    DepthSweep() {
        display_.content.yaw_deg = 20;
        display_.content.viewing_distance_mm = 700;
    }
    Display at(double depth_mm) const {
        Display d = display_;
        d.content.depth_mm = depth_mm;
        return d;
    }
    Image eia(const Display& d, const ContentScene& scene) { return elemental_images(d, resolve(d), scene, 2, job_).image; }
    Image photo(const Display& d, const ContentScene& scene) {
        return reference_photograph(d, resolve(d), scene, 2, {}, job_).image;
    }

    Folder folder_;
    Display display_ = display();
    std::shared_ptr<const Model> model_ = load_model(write_scene(folder_));
    Job job_;
};

TEST_F(DepthSweep, AMovedSceneHasTheBitsOfOneMadeThere) {
    const ContentScene scene(model_, at(0), resolve(at(0)));
    const Image unmoved = eia(at(0), scene);
    for (const double depth : {-200., -0.1, 25., 33.3333333, 190.}) {
        SCOPED_TRACE(depth);
        const Display there = at(depth);
        const ContentScene moved = scene.at_depth(depth), made(model_, there, resolve(there));
        const Image shown = eia(there, moved);
        EXPECT_EQ(shown.rgb, eia(there, made).rgb);
        EXPECT_NE(shown.rgb, unmoved.rgb);
        EXPECT_EQ(photo(there, moved).rgb, photo(there, made).rgb);
    }
    EXPECT_EQ(eia(at(0), scene).rgb, unmoved.rgb);
    EXPECT_EQ(eia(at(0), scene.at_depth(190).at_depth(0)).rgb, unmoved.rgb);
}

TEST_F(DepthSweep, NothingIsBuiltAgain) {
    const ContentScene scene(model_, at(0), resolve(at(0)));
    const ContentScene moved = scene.at_depth(50);
    EXPECT_EQ(&moved.impl(), &scene.impl());
    EXPECT_EQ(moved.centre_mm()[2], resolve(at(50)).vertex_plane_mm + 50);
}

TEST_F(DepthSweep, AMovedSceneOutlivesTheFirst) {
    const Display there = at(40);
    const auto moved = [&] { return ContentScene(model_, at(0), resolve(at(0))).at_depth(40); }();
    EXPECT_EQ(eia(there, moved).rgb, eia(there, ContentScene(model_, there, resolve(there))).rgb);
}

TEST_F(DepthSweep, DepthsThatNoDisplayHasAreErrors) {
    const ContentScene scene(model_, at(0), resolve(at(0)));
    for (const double depth : {1.1e6, -1.1e6, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW(scene.at_depth(depth), InputError) << depth;
}

}  // namespace
