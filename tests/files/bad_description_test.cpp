// A table of bad descriptions: the place and words of the one message that each must give.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "example.h"
#include "files/description/display_file.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;

struct Bad {
    std::string text;
    const char* where;
    const char* says;
};

class BadDescription : public testing::TestWithParam<Bad> {};

TEST_P(BadDescription, IsRefusedAtItsPlace) {
    try {
        parse_display(GetParam().text, "d");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems.size(), 1u) << error.what();
        EXPECT_EQ(error.problems[0].where, GetParam().where);
        EXPECT_THAT(error.problems[0].what, HasSubstr(GetParam().says));
    }
}

const std::string surfaces = with(R"("plano_convex"
sphere_radius_mm = 7.28
aperture_radius_mm = 6
index = 1.4918
)",
                                  R"("surfaces"
[[lens.surface]]
semi_aperture_mm = 6
distance_mm = 4
index = 1.5
[[lens.surface]]
curvature_per_mm = -0.1
semi_aperture_mm = 6
)");

INSTANTIATE_TEST_SUITE_P(
    Types, BadDescription,
    testing::Values(Bad{with("7.28", "\"7.28\""), "d:8:20", "lens.sphere_radius_mm: is a string; give a number"},
                    Bad{with("7.28", "true"), "d:8:20", "is true or false; give a number"},
                    Bad{with("7.28", "1979-05-27"), "d:8:20", "is a date or time; give a number"},
                    Bad{with("7.28", "[7.28]"), "d:8:20", "is a list; give a number"},
                    Bad{with("[43, 24]", "43"), "d:12:9", "array.count: is an integer; give a list of 2 integers"},
                    Bad{with("[43, 24]", "[43]"), "d:12:9", "has 1 element; give a list of 2 integers"},
                    Bad{with("[43, 24]", "[43, 24.0]"), "d:12:9", "element 1 is a number with a fraction; give an integer"},
                    Bad{with("[0, 0, 2000]", "[0, 'x', 2000]"), "d:16:15", "element 1 is a string; give a number"},
                    Bad{with("\"example\"", "7"), "d:2:8", "name: is an integer; give a string"},
                    Bad{with("[camera]\nposition_mm = [0, 0, 2000]", "[[camera]]"), "d:15:1",
                        "is a list of tables; give a table: [camera]"},
                    Bad{with("schema = 1", "schema = 1\ndiffuser = 3"), "d:2:12", "diffuser: is an integer; give a table"}));

INSTANTIATE_TEST_SUITE_P(Subpixels, BadDescription,
                         testing::Values(Bad{with("[panel]", "[panel]\nsubpixels = 'delta'\nsubpixel_cell = [1, 1]"), "d:5:17",
                                             "panel.subpixel_cell: is given, but panel.subpixels is \"delta\""},
                                         Bad{with("[panel]",
                                                  "[panel]\nsubpixel_cell = [1, 1]\nsubpixels = 'custom'\n"
                                                  "subpixel = [{channel = 'r', pixel = [0, 0], rect = [0, 0, 0, 1]},\n"
                                                  "{channel = 'g', pixel = [0, 0], rect = [0, 0, 0.5, 1]},\n"
                                                  "{channel = 'b', pixel = [0, 0], rect = [0.5, 0, 1, 1]}]"),
                                             "d:6:52", "panel.subpixel.0.rect: is [0, 0, 0, 1] and has no area"},
                                         Bad{with("[panel]",
                                                  "[panel]\nsubpixel_cell = [1, 1]\nsubpixels = 'custom'\n"
                                                  "subpixel = [{channel = 'r', pixel = [0, 0], rect = [0, 0, 0.4, 1]},\n"
                                                  "{channel = 'g', pixel = [0, 0], rect = [0.3, 0, 0.5, 1]},\n"
                                                  "{channel = 'b', pixel = [0, 0], rect = [0.5, 0, 1, 1]}]"),
                                             "d:7:40", "panel.subpixel.1.rect: overlaps panel.subpixel.0"}));

INSTANTIATE_TEST_SUITE_P(
    Keys, BadDescription,
    testing::Values(
        Bad{with("schema = 1\n", ""), "d:1:1", "schema: is missing; the first line of a description is schema = 1"},
        Bad{with("schema = 1", "schema = 2"), "d:1:10", "is 2, allowed is 1"},
        Bad{with("pixel_pitch_mm = 0.13636\n", ""), "d:3:1", "panel.pixel_pitch_mm: is missing"},
        Bad{with("index = 1.4918\n", ""), "d:6:1", "lens.index: is missing"},
        Bad{with("type = \"plano_convex\"\n", ""), "d:6:1", "lens.type: is missing"},
        Bad{with("\"plano_convex\"", "\"plano-convex\""), "d:7:8",
            R"(is "plano-convex", allowed are "plano_convex", "surfaces", "ideal", "pinhole"; did you mean "plano_convex"?)"},
        Bad{with("sphere_radius_mm = 7.28", "sphere_radius_mm = 7.28\nsphere_radius = 1"), "d:9:1",
            "lens.sphere_radius: is unknown; did you mean sphere_radius_mm?"},
        Bad{with("[camera]", "[camera]\nfrane_width_mm = 3"), "d:16:1", "did you mean frame_width_mm?"},
        Bad{with("[camera]", "[camera]\npitch_mm = 3"), "d:16:1", "camera.pitch_mm: is unknown here; it belongs in [array]"},
        Bad{with("pitch_mm = 12.0", "pitch_mm: 12.0"), "d:13:9", R"("pitch_mm: 12.0" is not of the form KEY = VALUE)"},
        Bad{with("pitch_mm = 12.0", "pitch_mm ="), "d:13:11", "pitch_mm: the value is missing"},
        Bad{with("\"plano_convex\"", "plano_convex"), "d:7:8", "type: text is written in quotes: \"plano_convex\""},
        Bad{with("pitch_mm = 12.0", "pitch_mm = [12,\nnan, x]"), "d:14:6", "could not determine value type"},
        Bad{with("pitch_mm = 12.0", "pitch_mm = [12, 9, 3]"), "d:13:12",
            "array.pitch_mm: is a list; give a number, or a list of 2 numbers"},
        Bad{with("pitch_mm = 12.0", "pitch_mm = [12, \"9\"]"), "d:13:12", "element 1 is a string; give a number"},
        Bad{with("pitch_mm = 12.0", "lattice = \"honeycomb\"\npitch_mm = 12"), "d:13:11",
            R"(array.lattice: is "honeycomb", allowed are "square", "rectangle", "hexagon", "brick", "strips")"},
        Bad{with("pitch_mm = 12.0", "pitch_mm = 12.0\naperture = \"square\""), "d:14:12",
            R"(array.aperture: is "square", allowed are "circle", "cell")"},
        Bad{with("[camera]", "[camera]\nqqqqqqqqqqq = 3"), "d:16:1", "is unknown; known are position_mm, target_mm"},
        Bad{with("[camera]", "[camera]\n\"a\\nb\" = 3"), "d:16:1", "camera.a\\u000ab: is unknown"},
        Bad{with("[camera]", "[difuser]\n[camera]"), "d:15:2", "difuser: is unknown; did you mean diffuser?"},
        Bad{with("index = 1.4918", "index = 1.4918\nfocal_length_mm = 15"), "d:11:19",
            "lens.focal_length_mm: has no meaning for a lens of type \"plano_convex\""},
        Bad{example_text + "[[lens.surface]]\nsemi_aperture_mm = 2\n", "d:17:1", "lens.surface: has no meaning"},
        Bad{with("[camera]", "[camera]\nup = [0, 1, 0]\nup = [1, 0, 0]"), "d:17:6", "redefine"}));

INSTANTIATE_TEST_SUITE_P(
    Surfaces, BadDescription,
    testing::Values(
        Bad{with("semi_aperture_mm = 6\ndistance", "distance", surfaces), "d:8:1", "lens.surface.0.semi_aperture_mm: is missing"},
        Bad{with("-0.1", "nan", surfaces), "d:13:20", "lens.surface.1.curvature_per_mm: is nan"},
        Bad{with("-0.1", "-0.1\nconik = 0", surfaces), "d:14:1", "lens.surface.1.conik: is unknown; did you mean conic?"},
        Bad{with("-0.1", "-0.1\neven_asphere = [1e-5, '']", surfaces), "d:14:16", "element 1 is a string"},
        Bad{with("distance_mm = 4", "distance_mm = 1", surfaces), "d:10:15", "cross within the aperture; give at least 2 mm"},
        Bad{with("[array]", "[array]\nsurround = \"glass\"", surfaces), "d:16:12",
            "is \"glass\", allowed are \"opaque\", \"clear\", \"plate\""}));

INSTANTIATE_TEST_SUITE_P(
    Values, BadDescription,
    testing::Values(
        Bad{with("7.28", "nan"), "d:8:20", "lens.sphere_radius_mm: is nan, allowed is 1e-6 to 1e6"},
        Bad{with("7.28", "-inf"), "d:8:20", "is -inf"},
        Bad{with("7.28", "5"), "d:8:20", "R = 5 mm is smaller than the aperture radius r = 6"},
        Bad{with("[43, 24]", "[43, 0]"), "d:12:9", "array.count[1]: is 0"},
        Bad{with("[3840, 2160]", "[100000, 100000]"), "d:4:10", "panel.pixels: 100000 x 100000 = 10000000000"},
        Bad{with("gap_mm = 16.485", ""), "d:11:1", "array.gap_mm: is missing; give array.gap_mm, or array.base_z_mm"},
        Bad{with("[camera]", "[render]\nseed = 9223372036854775808\n[camera]"), "d:16:27", "not representable in 64 bits"},
        Bad{example_text + "up = [0, 0, 1]\n", "d:17:6", "camera.up: lies along the line of sight"},
        Bad{example_text + "[diffuser]\ndistance_mm = -1\nangle_deg = [2, 2]", "d:18:15", "diffuser.distance_mm: is -1"}));

TEST(BadDescriptions, AllFaultsTogetherInTheOrderOfTheFile) {
    try {
        parse_display(
            "schema = 3\n[panel]\npixels = 'a'\n[lens]\ntype = 'ideal'\nfocal_length = 2\n[array]\npitch_mm = "
            "nan\n[render]\nsamples = 0",
            "d");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "d:1:10: schema: is 3, allowed is 1; another version of the program wrote or reads this file\n"
                     "d:2:1: panel.pixel_pitch_mm: is missing\n"
                     "d:3:10: panel.pixels: is a string; give a list of 2 integers\n"
                     "d:4:1: lens.focal_length_mm: is missing\n"
                     "d:6:1: lens.focal_length: is unknown; did you mean focal_length_mm?\n"
                     "d:7:1: array.gap_mm: is missing; give array.gap_mm, or array.base_z_mm, for the distance of the lenses\n"
                     "d:8:12: array.pitch_mm: is nan, allowed is 1e-6 to 1e6\n"
                     "d:10:11: render.samples: is 0, allowed is 1 to 16777216");
    }
}

TEST(BadDescriptions, FloodsAreCutShort) {
    std::string text = example_text + "[render]\n";
    for (int i = 0; i < 20000; ++i) text += "key" + std::to_string(i) + " = 1\n";
    try {
        parse_display(text, "d");
        FAIL() << "accepted";
    } catch (const InputError& error) {
        ASSERT_EQ(error.problems.size(), 51u);
        EXPECT_EQ(error.problems.back().what, "and 19950 more");
    }
}

}  // namespace
}  // namespace lfdsim
