// Grids of views: which picture is of which camera, in the forms that there are, and what is refused.
#include "files/views/views_source.h"

#include "base/constants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

namespace {

using namespace lfdsim;
namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// Files without pictures in them: none is read here.
class ViewsSourceTest : public testing::Test {
  protected:
    ViewsSourceTest() {
        std::string name = (fs::temp_directory_path() / "lfdsim-views-XXXXXX").string();
        if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
        folder = name;
    }
    ~ViewsSourceTest() override { fs::remove_all(folder); }
    void write(const std::string& name, const std::string& text = "x") const { std::ofstream(folder / name) << text; }
    void pictures(int from, int count, const char* before = "input_Cam") const {
        for (int k = from; k < from + count; ++k) {
            char number[16];
            std::snprintf(number, sizeof number, "%03d", k);
            write(before + std::string(number) + ".png");
        }
    }
    std::string refused(const fs::path& path) const {
        try {
            find_views(path);
        } catch (const InputError& e) {
            return e.what();
        }
        return "";
    }
    static std::string hci(int columns, int rows, const std::string& more = "") {
        return "[intrinsics]\nfocal_length_mm = 100.0\nimage_resolution_x_px = 512\nimage_resolution_y_px = 256\nsensor_size_mm = "
               "35.0\n"
               "[extrinsics]\nnum_cams_x = " +
               std::to_string(columns) + "\nnum_cams_y = " + std::to_string(rows) +
               "\nbaseline_mm = 50.0\nfocus_distance_m = 8.0\n" + more;
    }
    fs::path folder;
    const ViewsPlace place{300, 200, 4, 10, 600};
};

// Row by row from the upper left; what a camera sees at the focus is sensor / focal length of the distance wide.
TEST_F(ViewsSourceTest, Hci) {
    write("parameters.cfg", hci(3, 3));
    pictures(0, 9);
    write("gt_disp_lowres.pfm");
    for (const fs::path& path : {folder, folder / "parameters.cfg"}) {
        const ViewsSource source = find_views(path);
        EXPECT_EQ(source.form, ViewsForm::hci);
        ASSERT_EQ(source.views(), 9u);
        EXPECT_EQ(source.pictures[0].filename(), "input_Cam000.png");
        EXPECT_EQ(source.pictures[5].filename(), "input_Cam005.png");
        EXPECT_EQ(source.cameras[0], (std::array{-50., 50.}));
        EXPECT_EQ(source.cameras[5], (std::array{50., 0.}));
        EXPECT_DOUBLE_EQ(*source.distance_mm, 8000);
        EXPECT_DOUBLE_EQ(*source.width_mm, 0.35 * 8000);
        EXPECT_EQ(source.depth_value, DepthValue::disparity);
        ASSERT_EQ(source.depths.size(), 9u);
        EXPECT_EQ(source.depths[4].filename(), "gt_disp_lowres.pfm");
        EXPECT_TRUE(source.depths[3].empty());
    }
    // The focus fits the panel, all lengths by one scale: 2800 mm become 300, its 1400 mm of height 150.
    std::vector<std::string> notes;
    const ViewGrid grid = placed(find_views(folder), {}, place, 2, notes);
    EXPECT_DOUBLE_EQ(grid.width_mm, 300);
    EXPECT_DOUBLE_EQ(grid.height_mm, 150);
    EXPECT_DOUBLE_EQ(grid.distance_mm, 8000 * 300. / 2800);
    EXPECT_DOUBLE_EQ(grid.camera(2, 0)[0], 50 * 300. / 2800);
    EXPECT_DOUBLE_EQ(grid.depth_mm, 10);
    EXPECT_TRUE(notes.empty());
    // Depth in metres has the first right.
    write("gt_depth_lowres.pfm");
    EXPECT_EQ(find_views(folder).depth_value, DepthValue::distance);
    EXPECT_EQ(find_views(folder).depth_unit_mm, 1000);
}

TEST_F(ViewsSourceTest, HciThatIsIncomplete) {
    write("parameters.cfg", hci(3, 3));
    EXPECT_THAT(refused(folder), HasSubstr("has no pictures input_Cam*.png"));
    pictures(0, 8);
    EXPECT_THAT(refused(folder), HasSubstr("has 8 pictures"));
    pictures(9, 1);
    EXPECT_THAT(refused(folder), HasSubstr("number 8"));
    pictures(8, 2);
    EXPECT_THAT(refused(folder), HasSubstr("has 10 pictures"));
    for (const auto& [text, words] : {std::pair("num_cams_x = 0", "num_cams_x is \"0\""),
                                      {"num_cams_x = 2.5", "whole number"},
                                      {"num_cams_x = 99999", "whole number"},
                                      {"baseline_mm = nan", "baseline_mm is \"nan\""},
                                      {"focus_distance_m = -8", "focus_distance_m"}}) {
        write("parameters.cfg", hci(3, 3, text));  // the last one counts
        EXPECT_THAT(refused(folder), HasSubstr(words));
    }
    write("parameters.cfg", "[intrinsics]\n");
    EXPECT_THAT(refused(folder), HasSubstr("num_cams_x is missing"));
}

// Rows and columns by the names, places by v and u, whatever their signs.
TEST_F(ViewsSourceTest, StanfordArchive) {
    for (int row = 0; row < 2; ++row)
        for (int column = 0; column < 3; ++column)
            write("out_0" + std::to_string(row) + "_0" + std::to_string(column) + "_" + std::to_string(-381.5 + 40 * row + column) +
                  "_" + std::to_string(1103.25 - 60 * column) + (row == 0 ? "_.png" : ".png"));
    const ViewsSource source = find_views(folder);
    EXPECT_EQ(source.form, ViewsForm::stanford);
    EXPECT_EQ(source.columns, 3);
    EXPECT_EQ(source.rows, 2);
    EXPECT_THAT(source.pictures[4].filename().string(), HasSubstr("out_01_01_"));
    EXPECT_NEAR(source.cameras[0][0], -60, 1e-9);
    EXPECT_NEAR(source.cameras[2][0], 60, 1e-9);
    EXPECT_NEAR(source.cameras[0][1], 21, 1e-9);
    EXPECT_NEAR(source.cameras[2][1], 19, 1e-9);  // a little uneven
    std::vector<std::string> notes;
    EXPECT_THROW(placed(source, {}, place, 1.5, notes), InputError);  // no unit
    ViewsWish wish;
    wish.baseline_mm = {6, 4};
    const ViewGrid grid = placed(source, wish, place, 1.5, notes);
    EXPECT_NEAR(grid.camera(1, 0)[0] - grid.camera(0, 0)[0], 6, 1e-9);
    EXPECT_DOUBLE_EQ(grid.distance_mm, 600 - 4 - 10);  // the viewer's
    fs::remove(source.pictures[4]);
    EXPECT_THAT(refused(folder), HasSubstr("row 1, column 1 is missing"));
}

// NAME_qs8x6a0.75: counted from the bottom left; cameras at equal angles from one end of the cone to the other.
TEST_F(ViewsSourceTest, Quilt) {
    const fs::path file = folder / "portrait_qs8x6a0.75.png";
    write(file.filename());
    const ViewsSource source = find_views(file);
    EXPECT_EQ(source.form, ViewsForm::quilt);
    EXPECT_EQ(source.columns, 48);
    EXPECT_EQ(source.rows, 1);
    EXPECT_EQ(source.tiles, (std::array{8, 6}));
    std::vector<std::string> notes;
    const ViewGrid grid = placed(source, {}, place, *source.aspect, notes);
    EXPECT_EQ(notes.size(), 2u);  // distance and cone are assumed
    EXPECT_DOUBLE_EQ(grid.height_mm, 200);
    EXPECT_DOUBLE_EQ(grid.width_mm, 150);
    for (const int i : {0, 17, 47}) EXPECT_NEAR(grid.camera(i, 0)[0], 586 * std::tan(40 * degree * (i / 47. - 0.5)), 1e-9);
    EXPECT_LT(grid.camera(0, 0)[0], 0);  // the first is the leftmost

    EXPECT_THAT(refused(folder / "none_qs8x6a0.75.png"), HasSubstr("no such"));
    for (const char* name : {"plain.png", "quilt_qs8x.png", "quilt_qs8x6.png"}) {
        write(name);
        EXPECT_THAT(refused(folder / name), HasSubstr("_qs"));
    }
    for (const char* name : {"q_qs0x6a0.75.png", "q_qs9999x9999a1.png", "q_qs2x2a0.000.png"}) {
        write(name);
        EXPECT_THAT(refused(folder / name), HasSubstr("is named as a quilt")) << name;
    }
    ViewsPlace far = place;
    far.viewing_distance_mm = std::numeric_limits<double>::infinity();
    EXPECT_THROW(placed(source, {}, far, 0.75, notes), InputError);
}

// How cameras divide a cone: as the file says, or the option, which comes first; quilts from end to end, others in equal parts.
TEST_F(ViewsSourceTest, BothConventionsOfAViewCone) {
    const auto ends = [](int i, int n, double cone) { return 586 * std::tan(cone * degree * (double(i) / (n - 1) - 0.5)); };
    const auto bins = [](int i, int n, double cone) { return 586 * std::tan(cone * degree * ((i + 0.5) / n - 0.5)); };
    const fs::path file = folder / "q_qs3x2a1.5.png";
    write(file.filename());
    pictures(0, 6, "view_");
    const auto x = [&](const fs::path& what, const std::string& toml, const ViewsWish& wish, int i) {
        write(what == folder ? "views.toml" : "q_qs3x2a1.5.toml", "schema = 1\n" + toml);
        std::vector<std::string> notes;
        return placed(find_views(what), wish, place, 1.5, notes).camera(i, 0)[0];
    };
    ViewsWish in_bins, at_ends, wide;
    in_bins.cone = ConeCameras::bins;
    at_ends.cone = ConeCameras::ends;
    wide.cone_deg = 54;
    const std::string row = "columns = 6\nrows = 1\n";
    for (const int i : {0, 2, 5}) {
        EXPECT_NEAR(x(file, "", {}, i), ends(i, 6, 40), 1e-9);
        EXPECT_NEAR(x(file, "", wide, i), ends(i, 6, 54), 1e-9);
        EXPECT_NEAR(x(file, "", in_bins, i), bins(i, 6, 40), 1e-9);
        EXPECT_NEAR(x(file, "view_cone_deg = 20\ncone = \"bins\"\n", {}, i), bins(i, 6, 20), 1e-9);
        EXPECT_NEAR(x(file, "view_cone_deg = 20\ncone = \"bins\"\n", at_ends, i), ends(i, 6, 20), 1e-9);
        EXPECT_NEAR(x(file, "cone = \"bins\"\n", wide, i), bins(i, 6, 54), 1e-9);
        EXPECT_NEAR(x(folder, row + "view_cone_deg = 20\n", {}, i), bins(i, 6, 20), 1e-9);
        EXPECT_NEAR(x(folder, row + "view_cone_deg = 20\ncone = \"ends\"\n", {}, i), ends(i, 6, 20), 1e-9);
        EXPECT_NEAR(x(folder, row + "view_cone_deg = 20\ndistance_mm = 586\ncone = \"ends\"\n", {}, i), ends(i, 6, 20), 1e-9);
    }
    write("views.toml", "schema = 1\n" + row + "baseline_mm = [1, 1]\ncone = \"ends\"\n");
    EXPECT_THAT(refused(folder), HasSubstr("cone places the cameras in a view cone"));
    write("views.toml", "schema = 1\n" + row + "view_cone_deg = 3\ncone = \"middle\"\n");
    EXPECT_THAT(refused(folder), HasSubstr("cone"));
    EXPECT_THROW(x(folder, row + "baseline_mm = [1, 1]\n", at_ends, 0), InputError);
    EXPECT_EQ(cone_places(1, 40, 500, ConeCameras::ends), std::vector<double>{0});
    EXPECT_EQ(cone_places(1, 40, 500, ConeCameras::bins), std::vector<double>{0});
}

// A display's own cone is that of quilts that say nothing of theirs: each view has its part of the zone, wherever its camera stood.
TEST_F(ViewsSourceTest, QuiltsOfADisplaysOwn) {
    const fs::path file = folder / "q_qs11x6a0.75.png";
    write(file.filename());
    ViewsPlace own = place;
    own.view_cone_deg = 54;
    own.zone_width_mm = 600;
    std::vector<std::string> notes;
    const ViewGrid grid = placed(find_views(file), {}, own, 0.75, notes);
    EXPECT_TRUE(notes.empty());  // nothing is assumed
    for (const int k : {0, 20, 65}) EXPECT_NEAR(grid.camera(k, 0)[0], 600 * ((k + 0.5) / 66 - 0.5), 1e-9);
    ViewsWish said;
    said.cone = ConeCameras::bins;
    EXPECT_NEAR(placed(find_views(file), said, own, 0.75, notes).camera(65, 0)[0], 586 * std::tan(27 * degree * 65 / 66), 1e-9);
    EXPECT_THAT(notes.back(), HasSubstr("54 degrees"));
}

// Rows and columns by two numbers, from any number on; in a views.toml the other way round, too.
TEST_F(ViewsSourceTest, RowColumnNames) {
    for (int row = 1; row <= 2; ++row)
        for (int column = 0; column < 3; ++column) write("lf_00" + std::to_string(row) + "_00" + std::to_string(column) + ".png");
    write("notes.txt");
    const auto names = [&] {
        std::string all;
        for (const fs::path& path : find_views(folder).pictures)
            all += path.stem().string().substr(5, 1) + path.stem().string().substr(9) + " ";
        return all;
    };
    const ViewsSource source = find_views(folder);
    EXPECT_EQ(source.form, ViewsForm::row_column);
    EXPECT_EQ(source.columns, 3);
    EXPECT_EQ(source.rows, 2);
    EXPECT_EQ(names(), "10 11 12 20 21 22 ");
    const auto described = [&](const std::string& more) {
        write("views.toml", "schema = 1\npictures = \"lf_*_*.png\"\n" + more);
        return names();
    };
    EXPECT_EQ(described("columns = 3\nrows = 2\n"), "10 11 12 20 21 22 ");
    EXPECT_EQ(described("columns = 3\nrows = 2\nfirst = \"bottom_left\"\n"), "20 21 22 10 11 12 ");
    EXPECT_EQ(described("columns = 2\nrows = 3\nalong = \"columns\"\n"), "10 20 11 21 12 22 ");
    write("views.toml", "schema = 1\npictures = \"lf_*_*.png\"\ncolumns = 2\nrows = 3\n");
    EXPECT_THAT(refused(folder), HasSubstr("2 rows and 3 columns"));
    write("views.toml", "schema = 1\npictures = \"x_*_*.png\"\ncolumns = 2\nrows = 3\n");
    EXPECT_THAT(refused(folder), HasSubstr("has no pictures x_*_*.png"));
    fs::remove(folder / "views.toml");
    write("other_1_1.png");
    write("other_1_2.png");
    EXPECT_THAT(refused(folder), HasSubstr("more than one name"));
    fs::remove(folder / "other_1_1.png");
    fs::remove(folder / "lf_001_002.png");
    EXPECT_THAT(refused(folder), HasSubstr("the picture of row 1, column 2 is missing"));
}

// Each corner and way in which pictures can be numbered.
TEST_F(ViewsSourceTest, OrderOfNumberedPictures) {
    pictures(1, 6, "v");
    const auto order = [&](const std::string& more) {
        write("views.toml", "schema = 1\ncolumns = 3\nrows = 2\npictures = \"v*.png\"\nbaseline_mm = [10, 5]\n" + more);
        std::string numbers;
        for (const fs::path& path : find_views(folder).pictures) numbers += path.stem().string().substr(3);
        return numbers;
    };
    EXPECT_EQ(order(""), "123456");
    EXPECT_EQ(order("first = \"top_right\""), "321654");
    EXPECT_EQ(order("first = \"bottom_left\""), "456123");
    EXPECT_EQ(order("first = \"bottom_right\""), "654321");
    EXPECT_EQ(order("along = \"columns\""), "135246");
    EXPECT_EQ(order("along = \"columns\"\nfirst = \"bottom_left\""), "246135");
    EXPECT_EQ(order("pseudoscopic = true"), "654321");
    EXPECT_EQ(find_views(folder).cameras.front(), (std::array{-10., 2.5}));  // places stay
    ViewsSource source = find_views(folder);
    EXPECT_TRUE(source.flipped);
    flip(source);
    EXPECT_FALSE(source.flipped);
    EXPECT_EQ(source.pictures.front().filename(), "v001.png");
}

TEST_F(ViewsSourceTest, WritesWhatItReads) {
    pictures(0, 6, "view_");
    for (int k = 0; k < 6; ++k) write("depth_00" + std::to_string(k) + ".exr");
    const ViewGrid grid{3, 2, camera_places({-11.25, 0.1, 13}, {7, -5.5}), 612.3, 151.7, 101.9, -3.25};
    write("views.toml", views_toml(grid, "view_*.png", "depth_*.exr"));
    const ViewsSource source = find_views(folder);
    EXPECT_EQ(source.depths.size(), 6u);
    std::vector<std::string> notes;
    const ViewGrid back = placed(source, {}, place, *source.aspect, notes);
    EXPECT_EQ(back.camera_mm, grid.camera_mm);
    EXPECT_EQ(back.width_mm, grid.width_mm);
    EXPECT_NEAR(back.height_mm, grid.height_mm, 1e-12);
    EXPECT_EQ(back.distance_mm, grid.distance_mm);
    EXPECT_EQ(back.depth_mm, grid.depth_mm);
    EXPECT_TRUE(notes.empty());
    // Another width scales all with it.
    ViewsWish wish;
    wish.width_mm = 2 * grid.width_mm;
    EXPECT_NEAR(placed(source, wish, place, *source.aspect, notes).camera(2, 0)[0], 26, 1e-12);
}

TEST_F(ViewsSourceTest, BadDescriptions) {
    pictures(0, 6, "view_");
    const std::string three = "schema = 1\ncolumns = 3\nrows = 2\n", good = three + "baseline_mm = [10, 5]\n";
    write("views.toml", good);
    EXPECT_EQ(refused(folder), "");
    for (const auto& [text, words] : std::vector<std::pair<std::string, std::string>>{
             {"columns = 3\nrows = 2\n", "schema is missing"},
             {"schema = 2\ncolumns = 3\nrows = 2\n", "only 1 is known"},
             {"schema = 1\nrows = 2\n", "columns is missing"},
             {"schema = 1\ncolumns = 3\nrows = 3\n", "has 6 pictures"},
             {"schema = 1\ncolumns = 0\nrows = 3\n", "allowed is 1 to 1024"},
             {good + "colums = 3\n", "did you mean columns"},
             {good + "view_cone_deg = 20\n", "give one of them"},
             {good + "camera_x_mm = [1, 2]\n", "give one of them"},
             {"schema = 1\ncolumns = 3\nrows = 2\ncamera_x_mm = [1, 2]\ncamera_y_mm = [1, 0]\n", "has 2 places"},
             {three + "camera_x_mm = [nan, 0, 1]\ncamera_y_mm = [1, 0]\n", "views.toml:4:15: camera_x_mm element 0 is not finite"},
             {three + "camera_x_mm = [1, 0, 2]\ncamera_y_mm = [1, 0]\n", "views.toml:4:15: camera_x_mm element 1 is 0, after 1;"},
             {three + "camera_x_mm = [1, 2, 2e6]\ncamera_y_mm = [1, 0]\n",
              "views.toml:4:15: camera_x_mm element 2 is 2000000, allowed"},
             {three + "camera_x_mm = [1, 2, 3]\ncamera_y_mm = [0, 1]\n", "views.toml:5:15: camera_y_mm element 1 is 1, after 0;"},
             {three + "camera_x_mm = [1, 2, 3]\ncamera_y_mm = [1, 0]\nview_cone_deg = 9\n",
              "views.toml:6:17: view_cone_deg is one"},
             {good + "pictures = \"../view_*.png\"\n", "with one *"},
             {good + "pictures = \"view.png\"\n", "with one *"},
             {good + "pictures = \"other_*.png\"\n", "has no pictures"},
             {good + "first = \"middle\"\n", "top_left"},
             {good + "pseudoscopic = 1\n", "true or false"},
             {good + "distance_mm = -3\n", "allowed is"},
             {good + "height_mm = 3\n", "needs width_mm"},
             {good + "depth_pictures = \"d_*.exr\"\n", "as well"},
             {"schema = 1\ncolumns = 3\nrows = 2\nbaseline_mm = [0, 5]\n", "baseline_mm is 0"},
             {"schema = 1\ncolumns = \n", "views.toml:2"}}) {
        write("views.toml", text);
        EXPECT_THAT(refused(folder), HasSubstr(words)) << text;
    }
    // What follows from a wrong number of views is not told besides.
    write("views.toml", "schema = 1\ncolumns = 0\nrows = 2\ncamera_x_mm = [1, 2]\ncamera_y_mm = [1, 0]\n");
    EXPECT_THAT(refused(folder), Not(HasSubstr("places")));
    // Possible each by itself, impossible together: cameras that look along the focus.
    write("views.toml", "schema = 1\ncolumns = 3\nrows = 2\nbaseline_mm = [1000, 5]\ndistance_mm = 20\nwidth_mm = 100\n");
    std::vector<std::string> notes;
    const auto impossible = [&] {
        try {
            placed(find_views(folder), {}, place, 1.5, notes);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_THAT(impossible(), HasSubstr("views.toml:4:15: baseline_mm: puts cameras 1000 mm off axis"));
    write("views.toml", three + "camera_x_mm = [-1, 0, 2000]\ncamera_y_mm = [1, 0]\ndistance_mm = 20\nwidth_mm = 100\n");
    EXPECT_THAT(impossible(), HasSubstr("views.toml:4:15: camera_x_mm: puts cameras 2000 mm off axis"));
    EXPECT_THAT(refused(folder / "nowhere"), HasSubstr("no such folder or file"));
    fs::create_directory(folder / "empty");
    EXPECT_THAT(refused(folder / "empty"), HasSubstr("views.toml"));
    write("view_0001.png");  // the number 1 again
    write("views.toml", good);
    EXPECT_THAT(refused(folder), HasSubstr("has the same number as"));
}

}  // namespace
