#include "view/answers/library.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>
#include <fstream>
#include <nlohmann/json.hpp>

#include "display/keys.h"
#include "files/description/display_file.h"
#include "image/formats/image_file.h"
#include "view/answers/hidden_paths.h"

namespace lfdsim::view {
namespace {
namespace fs = std::filesystem;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using FileKind = Library::FileKind;

const std::string ready_displays = LFDSIM_SOURCE_DIR "/displays";

// A served folder with all kinds of things in it, and a secret beside it.
class LibraryTest : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "lfdsim-library-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        root = name;
        folder = root / "served";
        fs::create_directories(folder / "models/deep/a/b/c/d");
        for (const char* at : {"secret.toml", "served/mine.toml", "served/models/monkey.blend", "served/models/Cup.OBJ",
                               "served/.hidden.toml", "served/notes.txt", "served/panel.png", "served/models/deep/a/b/c/near.ply",
                               "served/models/deep/a/b/c/d/e/far.ply", "served/bad\xff.toml"}) {
            fs::create_directories((root / at).parent_path());
            std::ofstream(root / at) << "schema = 1\n";
        }
        fs::create_symlink("../secret.toml", folder / "out.toml");
        fs::create_directory_symlink("..", folder / "up");
        fs::create_symlink("mine.toml", folder / "in.toml");
        fs::create_symlink("nothing.toml", folder / "broken.toml");
        ASSERT_EQ(mkfifo((folder / "pipe.toml").c_str(), 0600), 0);
        fs::create_directory(folder / "folder.toml");
    }
    void TearDown() override { fs::remove_all(root); }

    static Start start(std::vector<std::string> set = {}) {
        return {ready_displays + "/desktop-asphere.toml", std::move(set), "", "", ""};
    }
    Library library() const { return Library(start(), folder); }

    fs::path root, folder;
};

template <class Call>
Problem problem_of(Call call) {
    try {
        call();
    } catch (const InputError& error) {
        return error.problems.front();
    }
    return {"none", "none"};
}

TEST_F(LibraryTest, FindsFilesOfTheFolderAlone) {
    const Library all = library();
    EXPECT_TRUE(fs::equivalent(all.file("mine.toml", FileKind::display), folder / "mine.toml"));
    EXPECT_TRUE(fs::equivalent(all.file("models/monkey.blend", FileKind::model), folder / "models/monkey.blend"));
    EXPECT_TRUE(fs::equivalent(all.file("in.toml", FileKind::display), folder / "mine.toml"));
    const std::string secret = (root / "secret.toml").string(), nul("mine.toml\0x", 11);
    for (const std::string& name : {std::string(),
                                    std::string("."),
                                    std::string(".."),
                                    std::string("/"),
                                    secret,
                                    std::string("../secret.toml"),
                                    std::string("models/../mine.toml"),
                                    std::string("models/../../secret.toml"),
                                    std::string("./mine.toml"),
                                    std::string("mine.toml/"),
                                    std::string("%2e%2e/secret.toml"),
                                    std::string("..%2fsecret.toml"),
                                    nul,
                                    std::string("out.toml"),
                                    std::string("up/secret.toml"),
                                    std::string("broken.toml"),
                                    std::string("pipe.toml"),
                                    std::string("folder.toml"),
                                    std::string("models"),
                                    std::string(".hidden.toml"),
                                    std::string("bad\xff.toml"),
                                    std::string(100000, 'a'),
                                    std::string("nothing.toml")})
        EXPECT_THROW(static_cast<void>(all.file(name, FileKind::display)), InputError) << name.substr(0, 100);
}

TEST_F(LibraryTest, NewFilesAreDescriptionsInTheFolder) {
    const Library all = library();
    EXPECT_EQ(all.new_file("new.toml"), folder / "new.toml");
    EXPECT_EQ(all.new_file("models/new.toml"), folder / "models/new.toml");
    EXPECT_EQ(all.new_file("mine.toml"), folder / "mine.toml");  // to replace it or not is the caller's affair
    for (const char* name :
         {"", "new.txt", "new", ".toml", "../new.toml", "/tmp/new.toml", "none/new.toml", "up/new.toml", "out.toml", "in.toml",
          "broken.toml", "pipe.toml", "folder.toml", "mine.toml/new.toml", "gpj.\u202enew.toml", "new\x1b[2J.toml"})
        EXPECT_THROW(all.new_file(name), InputError) << name;
}

// What is in a file of another kind is nobody's affair, and no part of it comes into an error.
TEST_F(LibraryTest, ReadsNothingOfOtherKinds) {
    const Library all = library();
    const std::string secret = "hunter2";
    for (const char* name : {"notes.md", "key.pem", "settings.toml", "broken_settings.toml", "list.toml", "photo.png", "cup.obj"})
        std::ofstream(folder / name) << "password = \"" << secret << "\"\n[" << secret << "]\n= = " << secret << "\n";
    for (const FileKind kind : {FileKind::display, FileKind::model, FileKind::picture})
        for (const char* name :
             {"notes.md", "key.pem", "settings.toml", "broken_settings.toml", "notes.txt", "photo.png", "cup.obj"}) {
            if ((kind == FileKind::picture && name == std::string("photo.png")) ||
                (kind == FileKind::model && name == std::string("cup.obj")))
                continue;
            const Problem problem = problem_of([&] { static_cast<void>(all.file(name, kind)); });
            EXPECT_THAT(problem.what, AnyOf(HasSubstr("those end in"), HasSubstr("those begin with schema = 1"))) << name;
            EXPECT_THAT(problem.where + problem.what, Not(HasSubstr(secret)));
        }
    for (const char* name : {"notes.md", "settings.toml", "broken_settings.toml", "notes.txt"}) {
        Wanted wanted;
        wanted.display = name;
        const Problem problem = problem_of([&] { static_cast<void>(all.display(wanted)); });
        EXPECT_THAT(problem.where, HasSubstr(name));
        EXPECT_THAT(problem.where + problem.what, Not(HasSubstr(secret)));
    }
}

TEST_F(LibraryTest, ListsWhatCanBeShown) {
    const Display started = read_display(start().display);
    std::ofstream(folder / "broken_display.toml") << "schema = 1\n[panel]\n";
    std::ofstream(folder / "settings.toml") << "[tool]\n";
    fs::copy_file(start().display, folder / "good.toml");
    fs::copy_file(start().display, folder / "models/good too.toml");
    write_image(folder / "small.png", Image(8, 8));
    write_image(folder / "whole.png", Image(int(started.panel.pixels[0]), int(started.panel.pixels[1])));
    const Library::Files files = library().files(started);
    EXPECT_THAT(files.displays, ElementsAre("good.toml", "models/good too.toml"));
    EXPECT_THAT(files.models, ElementsAre("models/Cup.OBJ", "models/deep/a/b/c/near.ply", "models/monkey.blend"));
    EXPECT_THAT(files.pictures, ElementsAre("whole.png"));
    for (int i = 0; i < 1100; ++i) std::ofstream(folder / ("many" + std::to_string(i) + ".obj"));
    const Library::Files many = library().files(started);
    EXPECT_EQ(many.displays.size() + many.models.size() + many.pictures.size(), 1000u);
}

TEST_F(LibraryTest, NeedsAFolder) {
    EXPECT_THROW(Library(start(), root / "none"), InputError);
    EXPECT_THROW(Library(start(), folder / "mine.toml"), InputError);
}

TEST_F(LibraryTest, OverridesComeInOrderAndReadBack) {
    const Library all(start({"array.gap_mm=17", "camera.position_mm=[1, 2, 1000]"}), folder);
    Wanted wanted;
    wanted.set = {"array.gap_mm=16.9"};
    wanted.eye_mm = {0.1, -1e-7, 1999.9999999999998};
    wanted.size = {640, 360};
    const Library::Description description = all.description(wanted);
    const Display display = all.display(wanted);
    EXPECT_EQ(display, read_display(description.file, description.set));
    EXPECT_EQ(display.array.gap_mm, 16.9);
    EXPECT_EQ(display.camera.position_mm, wanted.eye_mm);
    EXPECT_THAT(display.camera.resolution, ElementsAre(640, 360));
}

TEST_F(LibraryTest, EyesStandBesideOneAnother) {
    const Library all = library();
    Wanted wanted;
    wanted.eye_mm = {300, 100, 1500};
    wanted.eye_distance_mm = 60;
    wanted.set = {"camera.target_mm=[10, 0, 0]", "camera.up=[0.1, 1, 0]"};
    const Camera left = all.display(wanted, -1).camera, middle = all.display(wanted).camera, right = all.display(wanted, 1).camera;
    Vec3d across{}, view{};
    double length = 0, along = 0, up = 0;
    for (std::size_t a = 0; a < 3; ++a) {
        EXPECT_NEAR(0.5 * (left.position_mm[a] + right.position_mm[a]), wanted.eye_mm[a], 1e-9);
        across[a] = right.position_mm[a] - left.position_mm[a];
        view[a] = middle.target_mm[a] - middle.position_mm[a];
        length += across[a] * across[a];
        along += across[a] * view[a];
        up += across[a] * middle.up[a];
    }
    EXPECT_NEAR(std::sqrt(length), 60, 1e-9);
    EXPECT_NEAR(along, 0, 1e-6);
    EXPECT_NEAR(up, 0, 1e-9);
    EXPECT_GT(across[0], 0);
}

TEST_F(LibraryTest, WhatIsWrongIsToldByKey) {
    const Library all = library();
    const auto problem_with = [&](std::string set) {
        Wanted wanted;
        wanted.set = {std::move(set)};
        return problem_of([&] { all.display(wanted); });
    };
    EXPECT_EQ(problem_with("array.gap_mm=-1").where, "array.gap_mm");
    EXPECT_THAT(problem_with("array.gap_mm=-1").what, StartsWith("is -1"));
    EXPECT_EQ(problem_with("array.gap=17").where, "array.gap");
    EXPECT_EQ(problem_with("array.offset_mm=[0, 1e9]").where, "array.offset_mm");
    EXPECT_THAT(problem_with("array.offset_mm=[0, 1e9]").what, StartsWith("element [1] is 1000000000"));
    EXPECT_EQ(problem_with("diffuser={distance_mm=300}").where, "diffuser.angle_deg");
    EXPECT_EQ(problem_with("array.gap_mm=[").where, "array.gap_mm");
    EXPECT_EQ(problem_with("array.gap_mm").where, "array.gap_mm");
    EXPECT_THAT(problem_with("array.pitch_mm=2").where, HasSubstr("desktop-asphere.toml:"));
    EXPECT_EQ(problem_with("array.gap_mm=17\n[content]\nmodel=\"/etc/passwd\"").where, "array.gap_mm");
    for (const char* set : {"content.model=a.blend", "content={model=\"/etc/passwd\"}", "content=none", "content.model.x=1",
                            "camera.position_mm=[0,0,1]", "camera.position_mm.2=1", "camera=none", "camera.resolution=[9,9]",
                            "camera.resolution.0=9", "glass_catalogues=[\"/etc/passwd\"]", "glass_catalogues.0=a.agf",
                            "content.object=none", "content.object.0.model=/etc/passwd", "content.object.0.image=/etc/passwd",
                            "content.object.0={image=\"a.png\"}", "content.object=[{image=\"/etc/passwd\"}]"})
        EXPECT_THAT(problem_with(set).what, StartsWith("cannot be set")) << set;
    Wanted inside_display;
    inside_display.eye_mm = {0, 0, 1};
    EXPECT_EQ(problem_of([&] { all.display(inside_display); }).where, "camera.position_mm");
}

// Every key of the table is set to the name of a file whose first line an error could quote, in every form that an override has.
// What a visitor is told is the same whether there is such a file or not.
TEST_F(LibraryTest, NoKeyOpensAVisitorsFile) {
    const std::string secret = (root / "secret.csv").string();
    const Library all = library();
    const auto told = [&](const std::string& set) {
        Wanted wanted;
        wanted.set = {set};
        std::string text;
        try {
            all.display(wanted);
            text = "nothing";
        } catch (const InputError& error) {
            for (const Problem& p : error.problems) text += p.where + ": " + p.what + '\n';
        }
        return text;
    };
    int files = 0;
    std::vector<std::string> overrides, of_files;
    for (const FormatTable& table : format_tables()) {
        for (const FormatTable::Value& value : table.values) {
            const std::string name(value.key.name), in = table.path;
            const std::string path = in.empty() ? name : in + (table.is == PartKind::list ? ".0." : ".") + name;
            std::vector<std::array<std::string, 2>> forms;  // before and after the file's name
            for (const char* quote : {"", "\"", "'"}) forms.push_back({path + "=" + quote, quote});
            forms.push_back({path + "=[\"", "\"]"});
            forms.push_back({path + ".0=\"", "\""});
            forms.push_back({path + ".0=", ""});
            forms.push_back({path + "={x=\"", "\"}"});
            for (std::string outer = value.key.names_file ? path : ""; !(outer = table_of_path(outer)).empty();) {
                for (const std::string& key : {path.substr(outer.size() + 1), "\"" + name + "\"", name}) {
                    forms.push_back({outer + "={" + key + "=\"", "\"}"});
                    forms.push_back({outer + "=[{" + key + "=\"", "\"}]"});
                    forms.push_back({outer + "={" + key + "=[\"", "\"]}"});
                }
            }
            files += value.key.names_file;
            for (const auto& [before, after] : forms)
                (value.key.names_file ? of_files : overrides).push_back(before + secret + after);
        }
    }
    for (const std::string& set : of_files) EXPECT_THAT(told(set), HasSubstr("cannot be set"));
    std::vector<std::string> of_none;
    for (const std::string& set : overrides) of_none.push_back(told(set));
    std::ofstream(secret) << "password=hunter2,b\n";
    for (std::size_t k = 0; k < overrides.size(); ++k) {
        const std::string says = told(overrides[k]);
        EXPECT_THAT(says, testing::Not(HasSubstr("hunter2")));
        EXPECT_EQ(says, of_none[k]);
    }
    EXPECT_EQ(files, 6);  // content.model, a model and an image of objects, errors.table, glass_catalogues
}

// Every text in the table is the name of a file, unless the table says that it is none.
TEST(KeysOfFiles, AreAllTextsButLabels) {
    for (const FormatTable& table : format_tables())
        for (const FormatTable::Value& value : table.values) {
            const bool text = std::holds_alternative<const std::string*>(value.fresh) ||
                              std::holds_alternative<const std::vector<std::string>*>(value.fresh);
            EXPECT_EQ(value.key.names_file, text && value.key.name != "name") << table.path << " " << value.key.name;
        }
    for (const char* path : {"errors", "errors.table", "errors.table.0", "content.object.00.model", "content.object", "content",
                             "content.object.3", "glass_catalogues.1"})
        EXPECT_TRUE(decides_a_file(path)) << path;
    for (const char* path :
         {"errors.gap_mm", "error", "errors.table_mm", "content.object.0.width_mm", "content.light", "name", "lens", ""})
        EXPECT_FALSE(decides_a_file(path)) << path;
}

// A link out of the folder tells nothing of what is there.
TEST_F(LibraryTest, LinksOutTellNothing) {
    const Library all = library();
    const auto what = [&](const char* name) {
        return problem_of([&] { static_cast<void>(all.file(name, FileKind::display)); }).what;
    };
    EXPECT_EQ(what("up/secret.toml"), what("up/nothing.toml"));
    EXPECT_EQ(what("out.toml"), what("nothing.toml"));
}

TEST(HiddenPaths, LeaveNoAbsolutePath) {
    const HiddenPaths hidden("/srv/my displays", {"/home/me/it's \"mine\"", "/"});
    const auto shown = [&](const std::string& text) {
        return nlohmann::json::parse(hidden.without(nlohmann::json{{"what", text}}.dump()))["what"].get<std::string>();
    };
    EXPECT_EQ(shown("/srv/my displays/tablet.toml:3:1"), "tablet.toml:3:1");
    EXPECT_EQ(shown("lfdsim render '/srv/my displays/sub/tablet.toml' -o view.png"), "lfdsim render 'sub/tablet.toml' -o view.png");
    EXPECT_EQ(shown("model = \"/home/me/it's \"mine\"/a b/cup.obj\""), "model = \"\u2026/a b/cup.obj\"");
    EXPECT_EQ(shown("/data/with blanks/cup.obj: there is no such file"), "\u2026/cup.obj: there is no such file");
    EXPECT_EQ(shown("cannot start /usr/libexec/read-model, see docs/view.md"), "cannot start \u2026/read-model, see docs/view.md");
    EXPECT_EQ(shown("first\n/etc/passwd"), "first\n\u2026/passwd");
    EXPECT_EQ(shown("--set content.model=/a/b.obj --model=\"/c/d/\""), "--set content.model=\u2026/b.obj --model=\"\u2026/d/\"");
    for (const char* same : {"a / b", "from p'/2 on", "1/mm", "2 atan(p / 2g)", "../x/y.obj", "http://localhost/x",
                             "<text x='1'/></text>", "R >= r/2", ""})
        EXPECT_EQ(shown(same), same);
    for (const FormatTable& table : format_tables())
        for (const FormatTable::Value& value : table.values) EXPECT_EQ(shown(std::string(value.key.doc)), value.key.doc);
}

}  // namespace
}  // namespace lfdsim::view
