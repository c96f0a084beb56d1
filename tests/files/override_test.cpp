// --set key=value: what it changes, and what it says when it cannot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "example.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;

Display set(std::vector<std::string> overrides) { return parse_display(example_text, "d", overrides); }

std::string fault_of(std::vector<std::string> overrides) {
    try {
        set(std::move(overrides));
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(Override, ValuesOfEveryKind) {
    EXPECT_EQ(set({"array.pitch_mm=13"}).array.pitch_mm[0], 13);
    EXPECT_EQ(set({"array.count=[3, 4]"}).array.count->at(1), 4);
    EXPECT_EQ(set({"array.count.0=5"}).array.count->at(0), 5);
    EXPECT_EQ(set({"lens.facing=panel"}).lens.as<PlanoConvex>().facing, Facing::panel);
    EXPECT_EQ(set({"lens.facing=\"panel\""}).lens.as<PlanoConvex>().facing, Facing::panel);
    EXPECT_EQ(set({"render.fresnel=none"}).render.fresnel, Fresnel::none);
    EXPECT_EQ(set({"name=a = b"}).name, "a = b");
    EXPECT_EQ(set({"name=\\ \"\t\xc3\xa9"}).name, "\\ \"\t\xc3\xa9");
    EXPECT_EQ(set({"name="}).name, "");
    EXPECT_EQ(set({"content.model=../my model.glb"}).content.model, "../my model.glb");
    EXPECT_EQ(set({"render.samples=7", "render.samples=8"}).render.samples, 8);
    EXPECT_EQ(set({"content.viewing_distance_mm=inf"}).content.viewing_distance_mm, INFINITY);
    const Display d = set({"diffuser={distance_mm=3, angle_deg=[1, 2]}", "diffuser.profile=gaussian"});
    EXPECT_EQ(d.diffuser->angle_deg[1], 2);
    EXPECT_EQ(d.diffuser->profile, Profile::gaussian);
}

// A sweep of the gap would compare pictures of different scenes if the model moved with the central depth plane.
TEST(Override, LeaveTheModelWhereItStood) {
    const std::string no_depth = example_text + "\n[content]\nviewing_distance_mm = 2000.0\n";
    const auto depth = [&](const std::vector<std::string>& overrides) {
        return resolve(parse_display(no_depth, "d", overrides)).content_depth_mm;
    };
    const double written = depth({});
    EXPECT_NE(written, 0);
    EXPECT_EQ(depth({"array.gap_mm=9.0"}), written);
    EXPECT_EQ(depth({"camera.position_mm=[0, 0, 900]", "panel.pixel_pitch_mm=0.2"}), written);
    EXPECT_EQ(depth({"array.gap_mm=9.0", "content.depth_mm=7"}), 7);
    // It returns there when its depth is taken away, whichever change comes first, at once or one after the other, and also where
    // the description had another depth.
    EXPECT_EQ(depth({"array.gap_mm=9.0", "content.depth_mm=none"}), written);
    const std::vector<std::string> gap{"array.gap_mm=9.0"}, none{"content.depth_mm=none"};
    for (const Display& d : {parse_display(no_depth, "d"), parse_display(no_depth + "depth_mm = 7\n", "d")})
        for (const Display& moved :
             {changed(d, {gap[0], none[0]}), changed(changed(d, gap), none), changed(changed(d, none), gap)}) {
            EXPECT_EQ(resolve(moved).content_depth_mm, written);
            EXPECT_EQ(resolve(parse_display(write_display(moved), "d")).content_depth_mm, written);
        }
}

// Objects have places of their own, which the default depth of a model does not move.
TEST(Override, LeaveObjectsWhereTheyStand) {
    const Display d = parse_display(example_text, "d");
    const std::string objects = "content.object=[{model='built-in:spheres', height_mm=5.0, position_mm=[0, 0, 3]}]";
    EXPECT_EQ(resolve(changed(changed(d, {"array.gap_mm=9.0"}), {objects})).content_depth_mm, 3);
    EXPECT_EQ(resolve(changed(changed(d, {objects}), {"array.gap_mm=9.0", "content.object=none"})).content_depth_mm,
              resolve(d).content_depth_mm);
}

TEST(Override, NoneTakesAway) {
    EXPECT_FALSE(set({"diffuser={distance_mm=3, angle_deg=[1, 2]}", "diffuser=none"}).diffuser);
    const Display d = set({"array.gap_mm=none", "array.base_z_mm=12", "camera.pupil_diameter_mm=none"});
    EXPECT_FALSE(d.array.gap_mm);
    EXPECT_EQ(d.array.base_z_mm, 12);
    const Display without = set({"name=x", "content.model=a.obj", "errors.table=none", "name=none", "content.model=none",
                                 "content.inverse.start=none", "render.estimator=none", "panel.subpixels=none"});
    EXPECT_EQ(without.name, "");
    EXPECT_EQ(without.content.model, "");
    EXPECT_EQ(without.errors.table, "");
    EXPECT_EQ(without.content.inverse.start, "");
    EXPECT_EQ(without.render.estimator, Render().estimator);
    EXPECT_EQ(set({"content.model=./none"}).content.model, "./none");
    EXPECT_EQ(set({"content.model=\"none\""}).content.model, "none");
    EXPECT_THAT(fault_of({"lens.type=none"}), HasSubstr("lens.type: is missing"));
    EXPECT_THAT(fault_of({"panel=none"}), HasSubstr("d:1:1: panel.pixels: is missing"));
}

TEST(Override, EmptyNamesOfFilesAreFaults) {
    for (const std::string set : {"errors.table=", "content.model=", "content.inverse.start=\"\"", "glass_catalogues=[\"\"]"})
        EXPECT_THAT(fault_of({set}), HasSubstr("--set " + set + ": " + set.substr(0, set.find('=')) + ": has an empty text"));
}

TEST(Override, Surfaces) {
    const std::vector<std::string> lens{
        "lens={type=\"surfaces\", surface=[{semi_aperture_mm=6, distance_mm=4, index=1.5}, {semi_aperture_mm=6}]}"};
    std::vector<std::string> all = lens;
    all.push_back("lens.surface.1.curvature_per_mm=-0.1");
    EXPECT_EQ(set(all).lens.as<SurfaceLens>().surfaces.at(1).curvature_per_mm, -0.1);
    all.back() = "lens.surface.2.conic=0";
    EXPECT_THAT(fault_of(all), HasSubstr("--set lens.surface.2.conic=0: there is no element 2"));
}

TEST(Override, FaultsNameTheOption) {
    EXPECT_EQ(fault_of({"array.pitch=13"}), "--set array.pitch=13: array.pitch: is unknown; did you mean pitch_mm?");
    EXPECT_EQ(fault_of({"lens.index=0.5"}), "--set lens.index=0.5: lens.index: is 0.5, allowed is 1 to 4");
    EXPECT_THAT(fault_of({"lens.facing=up"}),
                HasSubstr("--set lens.facing=up: lens.facing: is \"up\", allowed are \"viewer\", \"panel\""));
    EXPECT_THAT(fault_of({"diffuser.distance_mm=3"}), HasSubstr("--set diffuser.distance_mm=3: diffuser.angle_deg: is missing"));
    EXPECT_THAT(fault_of({"array.pitch_mm"}), HasSubstr("--set array.pitch_mm: is not of the form key=value"));
    EXPECT_THAT(fault_of({"=3"}), HasSubstr("is not of the form key=value"));
    EXPECT_THAT(fault_of({"name=a\xff"}), HasSubstr("the value is not TOML"));  // as no file may have it
    EXPECT_THAT(fault_of({"array.pitch_mm=abc"}), HasSubstr("--set array.pitch_mm=abc: the value is not TOML"));
    EXPECT_THAT(fault_of({"array.pitch_mm="}), HasSubstr("the value is not TOML: the value is missing"));
    EXPECT_THAT(fault_of({"model=x.obj"}), HasSubstr("model: is unknown here; it belongs in [content]"));
    EXPECT_THAT(fault_of({"diffuser=off"}), HasSubstr("diffuser: is a string; give a table"));
    EXPECT_THAT(fault_of({"camera.name=x"}), HasSubstr("it belongs in the file's beginning, before all tables"));
    EXPECT_THAT(fault_of({"gap_mm=3"}), HasSubstr("gap_mm: is unknown here; it belongs in [array] or [errors]"));
    EXPECT_THAT(fault_of({"array.pitch_mm=13\nx=3"}), HasSubstr("is more than one value"));
    EXPECT_THAT(fault_of({"array.pitch_mm.x=3"}), HasSubstr("pitch_mm is a value, and has no parts"));
    EXPECT_THAT(fault_of({"a.b.c.d.e=3"}), HasSubstr("the key has 5 parts, allowed are 4"));
    EXPECT_THAT(fault_of({"array.count.7=3"}), HasSubstr("there is no element 7"));
    EXPECT_THAT(fault_of({"content.object.0.depth_mm=3"}), HasSubstr("there is no element 0"));  // there is no list
    EXPECT_THAT(fault_of({"content.object.0={}"}), HasSubstr("there is no element 0"));
    EXPECT_THAT(fault_of({"array.count.0=none"}), HasSubstr("cannot be removed"));
    EXPECT_THAT(fault_of({"..=3"}), HasSubstr("--set ..=3: "));
    EXPECT_THAT(fault_of({"lens=" + std::string(100, '[')}), HasSubstr("nested"));
    EXPECT_THAT(fault_of({"bad", "worse"}), HasSubstr("--set worse"));
}

// Numbers as people write them: the message has what to write.
TEST(Override, HintsForNumbers) {
    const auto hint = [](const std::string& override_text, const char* remedy) {
        const std::string fault = fault_of({"lens.surface=[{}]", override_text});
        EXPECT_THAT(fault, HasSubstr("the value is not TOML: ")) << override_text;
        EXPECT_THAT(fault, testing::EndsWith(remedy)) << override_text;
    };
    hint("lens.index=.6", "write 0.6");
    hint("lens.index=-.6", "write -0.6");
    hint("lens.index=6.", "write 6");
    hint("lens.index=01.5", "write 1.5");
    hint("array.pitch_mm=1.866mm", "numbers carry no unit, array.pitch_mm is in mm; write 1.866");
    hint("array.pitch_mm=1.866 mm", "write 1.866");
    hint("array.pitch_mm=1.866cm", "array.pitch_mm is in mm; write the number in it");
    hint("content.yaw_deg=90\u00b0", "write 90");
    hint("lens.index=1.5x", "the value is a number without a unit; write 1.5");
    hint("array.pitch_mm=1,5", "the decimal sign is a point; write 1.5");
    hint("array.pitch_mm=1e", "the exponent is missing; write a number such as 1e3");
    hint("array.pitch_mm=1e+", "the exponent is missing; write a number such as 1e3");
    hint("array.pitch_mm=\"0.5", "numbers are written without quotes: 0.5");
    hint("array.pitch_mm=+-", "give a number such as 12.5 or 1e3");
    for (const char* const written : {"11, 6", "11 6", "11x6", "[11x6]", "[11 6]"})
        hint(std::string("array.count=") + written, "a list is written in brackets, with commas: [11, 6]");
    hint("lens.surface.0.conic=.5", "write 0.5");
}

// A model named in the file lies beside the file, one named on the command line beside its user.
TEST(Override, ModelPaths) {
    const std::filesystem::path folder = std::filesystem::path(LFDSIM_BINARY_DIR) / "model-paths";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "d.toml") << example_text << "[content]\nmodel = \"../meshes/a.glb\"\n";
    EXPECT_EQ(read_display(folder / "d.toml").content.model, (folder.parent_path() / "meshes/a.glb").string());
    EXPECT_EQ(read_display(folder / "d.toml", {"content.model=b.glb"}).content.model, "b.glb");
    EXPECT_EQ(read_display(folder / "d.toml", {"content.model=/c.glb"}).content.model, "/c.glb");
    std::ofstream(folder / "e.toml") << example_text << "[content]\nmodel = \"/meshes/a.glb\"\n";
    EXPECT_EQ(read_display(folder / "e.toml").content.model, "/meshes/a.glb");
}

TEST(Override, ObjectPaths) {
    const std::filesystem::path folder = std::filesystem::path(LFDSIM_BINARY_DIR) / "object-paths";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "d.toml")
        << example_text
        << "[[content.object]]\nmodel = \"a.glb\"\nheight_mm = 1\n[[content.object]]\nimage = "
           "\"../b.png\"\nwidth_mm = 2\n[[content.object]]\nmodel = \"built-in:spheres\"\nunit_mm = 3\n";
    const auto objects = [&](const std::vector<std::string>& set) { return read_display(folder / "d.toml", set).content.objects; };
    EXPECT_EQ(objects({})[0].model, (folder / "a.glb").string());
    EXPECT_EQ(objects({})[0].image, "");
    EXPECT_EQ(objects({})[1].image, (folder.parent_path() / "b.png").string());
    EXPECT_EQ(objects({})[2].model, "built-in:spheres");
    EXPECT_EQ(objects({"content.object.0.model=c.glb"})[0].model, "c.glb");
    EXPECT_EQ(objects({"content.object.1.image=/d.png"})[1].image, "/d.png");
    EXPECT_EQ(objects({"content.object.2.position_mm=[1, 2, 3]"})[2].position_mm, (Vec3d{1, 2, 3}));
    EXPECT_TRUE(objects({"content.object=none"}).empty());
}

// Lists are read to their own ends, not to that of the shortest.
TEST(Override, LongListsAreReadWhole) {
    std::string text = example_text;
    for (int k = 0; k < 64; ++k) text += "[[content.object]]\nmodel = \"a.obj\"\nheight_mm = " + std::to_string(k + 1) + "\n";
    ASSERT_EQ(parse_display(text, "d").content.objects.size(), 64u);
    EXPECT_EQ(parse_display(text, "d").content.objects[63].height_mm, 64);
    text += "[[content.object]]\nmodel = \"a.obj\"\nheight_mm = 65\n";
    EXPECT_THROW(parse_display(text, "d"), InputError);
}

}  // namespace
}  // namespace lfdsim
