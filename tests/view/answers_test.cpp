#include "view/answers/answers.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>
#include <cmath>

#include "content/content.h"
#include "files/description/display_file.h"
#include "folder.h"
#include "report/plots/svg_drawing.h"
#include "view/server/messages.h"

namespace lfdsim::view {
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

const fs::path displays = LFDSIM_SOURCE_DIR "/displays";

/// Numbers that are not finite would be null in JSON.
void expect_finite(const Json& json) {
    if (json.is_number_float()) {
        EXPECT_TRUE(std::isfinite(json.get<double>()));
    }
    if (json.is_structured())
        for (const Json& part : json) expect_finite(part);
}

class AnswersTest : public FolderTest {
  protected:
    inline static Panels panels{free_bytes()};
    Library library(std::vector<std::string> set = {}) const {
        return Library({folder / "small.toml", std::move(set), "", "", ""}, folder);
    }
    static Wanted wanted(std::vector<std::string> set = {}) {
        Wanted w;
        w.id = 5;
        w.eye_mm = {0, 0, 600};
        w.size = {160, 90};
        w.set = std::move(set);
        return w;
    }
    static Json ask(const Library& all, const Wanted& w, Ask::What what, const std::string& name = "", bool overwrite = false) {
        const Json json = answer(all, panels, w, {3, what, {0.4, 0.6}, name, overwrite}, nullptr);
        EXPECT_EQ(json["type"], "answer");
        EXPECT_EQ(json["id"], 3);
        expect_finite(json);
        return json;
    }
};

Json control(const Json& message, const std::string& key) {
    for (const Json& c : message["controls"])
        if (c["key"] == key) return c;
    ADD_FAILURE() << "no control " << key;
    return {};
}

// The value of a key as --set takes it.
std::string set(const std::string& key, const Json& value) {
    return key + "=" + (value.is_string() ? value.get<std::string>() : value.dump());
}

TEST(Controls, SlidersOfReadyDisplaysGoWhereTheDisplayIsValid) {
    const Library library({displays / "desktop-asphere.toml", {}, "", "", ""}, displays);
    for (const std::string& name : library.files(read_display(library.start().display)).displays) {
        Wanted described;
        described.display = name;
        const Json message = resolved(library, described);
        ASSERT_EQ(message["type"], "resolved") << name;
        expect_finite(message);
        EXPECT_GT(message["controls"].size(), 30u);
        for (const Json& c : message["controls"]) {
            const std::string key = c["key"];
            Wanted changed = described;
            if (c["form"] == "word" && !c["value"].is_null())
                for (const Json& word : c["words"]) {
                    changed.set = {set(key, word)};
                    EXPECT_NO_THROW(library.display(changed)) << name << " " << changed.set[0];
                }
            if (c["form"] == "list" || c["form"] == "word") continue;
            EXPECT_GT(c["step"], 0) << key;
            for (const Json& value : c["form"] == "pair" ? c["value"] : Json{c["value"].is_null() ? c["suggested"] : c["value"]}) {
                EXPECT_LE(c["low"], value) << name << " " << key;
                EXPECT_GE(c["high"], value) << name << " " << key;
            }
            if (c["value"].is_null()) continue;
            const Json limits = c.value("limits", Json::object());
            for (const char* end : {"low", "high"}) {
                changed.set = {set(key, c["form"] == "pair" ? Json{c[end], c["value"][1]} : c[end])};
                for (const auto& [limited, share] : limits.items())
                    changed.set.push_back(set(limited, std::min(control(message, limited)["value"].get<double>(),
                                                                share.get<double>() * c[end].get<double>())));
                EXPECT_NO_THROW(library.display(changed)) << name << " " << changed.set[0];
            }
        }
    }
}

TEST_F(AnswersTest, SlidersEndWhereTheDisplayDoes) {
    const Json message = resolved(library(), wanted());
    const Json radius = control(message, "lens.sphere_radius_mm"), pitch = control(message, "array.pitch_mm"),
               stop = control(message, "lens.stop_radius_mm"), distance = control(message, "diffuser.distance_mm");
    EXPECT_NEAR(radius["low"], 2.9, 1.1 * radius["step"].get<double>());  // R >= r
    EXPECT_GE(radius["low"], 2.9);
    EXPECT_EQ(radius["high"], 20);  // four times as much
    EXPECT_EQ(radius["label"], "sphere radius");
    EXPECT_EQ(radius["unit"], "mm");
    EXPECT_EQ(radius["table"], "lens");
    EXPECT_EQ(pitch["low"], pitch["value"].get<double>() / 4);  // r follows
    EXPECT_EQ(pitch["limits"], (Json{{"lens.aperture_radius_mm", 0.5}}));
    const Json aperture = control(message, "lens.aperture_radius_mm");  // follows the pitch, not the other way round
    EXPECT_NEAR(aperture["high"], 0.5 * pitch["value"].get<double>(), 1.1 * aperture["step"].get<double>());
    EXPECT_TRUE(stop["value"].is_null());
    EXPECT_EQ(stop["absent"], "none");
    EXPECT_EQ(stop["suggested"], 2.9);
    EXPECT_EQ(distance["low"], 15);
    EXPECT_EQ(control(message, "array.count")["form"], "pair");
    EXPECT_EQ(control(message, "render.seed")["form"], "integer");
    EXPECT_THAT(control(message, "array.surround")["words"], ElementsAre("opaque", "clear", "plate"));
    for (const Json& c : message["controls"])
        for (const char* other : {"content.model", "camera.position_mm", "camera.resolution"}) EXPECT_NE(c["key"], other);
}

// A scene: objects have sliders, but no files; another model that is shown takes their place; a saved one names its files anew.
TEST_F(AnswersTest, ScenesHaveControlsAndAreSaved) {
    fs::create_directories(folder / "scenes");
    std::ifstream from(folder / "small.toml");
    std::ofstream(folder / "scenes/scene.toml")
        << from.rdbuf() << "\n[[content.object]]\nimage = \"../wall.png\"\nwidth_mm = 40\n[[content.object]]\nmodel = "
        << "\"built-in:spheres\"\nheight_mm = 30\nposition_mm = [1, 2, 3]\n";
    const Library all({folder / "scenes/scene.toml", {"content.model=none"}, "", "", ""}, folder);
    const Json message = resolved(all, wanted());
    EXPECT_EQ(control(message, "content.object.0.width_mm")["value"], 40);
    EXPECT_EQ(control(message, "content.object.1.position_mm")["value"], (Json{1, 2, 3}));
    EXPECT_EQ(control(message, "content.object.1.shading")["words"], (Json{"file", "smooth", "flat"}));
    EXPECT_EQ(control(message, "content.light.ambient")["high"], 1);
    for (const Json& c : message["controls"])
        for (const char* other :
             {"content.object.0.image", "content.object.0.height_mm", "content.object.1.model", "content.object.1.colour"})
            EXPECT_NE(c["key"], other);

    const Display moved = all.display(wanted({"content.object.1.yaw_deg=5"}));
    EXPECT_EQ(moved.content.objects[1].yaw_deg, 5);
    Wanted other = wanted();
    other.shown = {Shown::Kind::model, "built-in:spheres", false};
    EXPECT_TRUE(all.display(other).content.objects.empty());

    EXPECT_EQ(ask(all, wanted(), Ask::What::save, "saved.toml")["problems"], Json::array());
    EXPECT_EQ(parse_display(std::string(ask(all, wanted(), Ask::What::toml)["text"]), "text").content.objects[0].image,
              fs::absolute(folder / "wall.png").lexically_normal().string());
    const Display saved = read_display(folder / "saved.toml");
    EXPECT_EQ(saved.content.objects[0].image, (folder / "wall.png").string());
    EXPECT_EQ(saved.content.objects[1].model, "built-in:spheres");
}

// As `lfdsim view small.toml`: the folder is the one that the program was started in, and its description has no folder's name.
TEST_F(AnswersTest, AreSavedWhereTheProgramWasStarted) {
    const fs::path before = fs::current_path();
    fs::current_path(folder);
    std::ofstream("cup.obj") << "v 0 0 0\n";
    std::ofstream("errors.csv") << "i,j,dx_mm,dy_mm,dz_mm,tilt_x_deg,tilt_y_deg,curvature\n0,0,0.1,0,0,0,0,0\n";
    fs::create_directories("sub");
    for (const char* served : {".", "./", "sub/.."}) {
        const Library all({"small.toml", {"content.model=cup.obj", "errors.table=errors.csv"}, "", "", ""}, served);
        EXPECT_EQ(parse_display(std::string(ask(all, wanted(), Ask::What::toml)["text"]), "text").content.model, "cup.obj");
        EXPECT_EQ(ask(all, wanted(), Ask::What::save, "mine.toml", true)["problems"], Json::array()) << served;
        EXPECT_EQ(ask(all, wanted(), Ask::What::save, "sub/mine.toml", true)["problems"], Json::array()) << served;
        for (const char* saved : {"mine.toml", "sub/mine.toml"}) {
            const Display read = read_display(saved);
            EXPECT_TRUE(fs::equivalent(read.content.model, "cup.obj")) << saved;
            EXPECT_TRUE(fs::equivalent(read.errors.table, "errors.csv")) << saved;
        }
    }
    fs::current_path(before);
}

TEST_F(AnswersTest, SlidersStayWhileOneIsDragged) {
    const Json one = control(resolved(library(), wanted()), "array.gap_mm");
    const Json other = control(resolved(library(), wanted({"array.gap_mm=10.7"})), "array.gap_mm");
    EXPECT_EQ(other["value"], 10.7);
    for (const char* part : {"low", "high", "step"}) EXPECT_EQ(one[part], other[part]);
    const Json far = control(resolved(library(), wanted({"array.gap_mm=500"})), "array.gap_mm");  // a number may be typed
    EXPECT_EQ(far["high"], 500);
    EXPECT_EQ(control(resolved(library(), wanted({"content.viewing_distance_mm=inf"})), "content.viewing_distance_mm")["value"],
              "infinite");
}

TEST_F(AnswersTest, ADiffuserCanBePutIn) {
    const Library all = library({"diffuser=none"});
    const Json message = resolved(all, wanted());
    const Json distance = control(message, "diffuser.distance_mm"), angle = control(message, "diffuser.angle_deg");
    EXPECT_TRUE(distance["value"].is_null() && angle["value"].is_null());
    const Display display =
        all.display(wanted({set("diffuser.distance_mm", distance["suggested"]), set("diffuser.angle_deg", angle["suggested"])}));
    EXPECT_TRUE(display.diffuser);
}

TEST_F(AnswersTest, SurfacesHaveControlsOfTheirOwn) {
    const Library ready({displays / "desktop-asphere.toml", {}, "", "", ""}, displays);
    const Json curvature = control(resolved(ready, Wanted{}), "lens.surface.1.curvature_per_mm");
    EXPECT_EQ(curvature["value"], -0.129517);
    EXPECT_EQ(curvature["unit"], "1/mm");
    EXPECT_EQ(curvature["table"], "lens.surface.1");
    EXPECT_EQ(control(resolved(ready, Wanted{}), "lens.surface.1.even_asphere")["form"], "list");
}

TEST_F(AnswersTest, FiguresAreThoseOfTheory) {
    const Json message = resolved(library({"array.gap_mm=12"}), wanted());
    const Display display = library({"array.gap_mm=12"}).display(wanted());
    bool found = false;
    for (const Json& figure : message["theory"])
        if (figure["name"] == "fov_deg") {
            found = true;
            EXPECT_EQ(figure["value"], theory(display, resolve(display)).along[0].fov_deg);
            EXPECT_EQ(figure["label"], "field of view of one lens, in which an eye may move");
            EXPECT_EQ(figure["unit"], "degrees");
            EXPECT_EQ(figure["doc"], "2 atan(p / 2g)");
        }
    EXPECT_TRUE(found);
    EXPECT_EQ(message["name"], "small");
    EXPECT_EQ(message["id"], 5);
    const Json wide = resolved(library({"array.lattice=rectangle", "array.pitch_mm=[24,20]"}), wanted());
    for (const Json& figure : wide["theory"])
        if (figure["name"] == "fov_deg") {
            EXPECT_EQ(figure["value"].size(), 2u);  // along x and y
            EXPECT_GT(figure["value"][0], figure["value"][1]);
        }
    Wanted aside = wanted();
    aside.eye_mm = {500, 0, 330};
    EXPECT_THAT(resolved(library(), aside)["warnings"].dump(), HasSubstr("outside the field of view"));
    const Library ready({displays / "desktop-ideal.toml", {}, "", "", ""}, displays);
    const double f = *ready.display(Wanted{}).array.gap_mm;
    Wanted collimated;
    collimated.set = {"lens.focal_length_mm=" + Json(f).dump()};
    EXPECT_THAT(resolved(ready, collimated)["theory"].dump(), HasSubstr("\"value\":\"infinite\""));
}

// A PNG that states its tone curve has the chunk gAMA behind its header, which ends at byte 33.
TEST_F(AnswersTest, APictureOfOtherColoursIsWarnedOf) {
    const fs::path file = folder / "panel.png";
    write_image(file, Image(210, 150));
    Wanted w = wanted();
    w.shown = {Shown::Kind::panel_image, "panel.png"};
    EXPECT_THAT(resolved(library(), w)["warnings"].dump(), Not(HasSubstr("panel.png")));
    std::string bytes = lfdsim::test::load(file);
    bytes.insert(33, std::string("\0\0\0\4gAMA\0\1\x86\xa0\x31\xe8\x96\x5f", 16));
    lfdsim::test::save(file, bytes);
    EXPECT_THAT(resolved(library(), w)["warnings"][0], HasSubstr("panel.png: "));
    EXPECT_THAT(resolved(library(), wanted())["warnings"].dump(), Not(HasSubstr("panel.png")));
    lfdsim::test::save(file, "no picture");
    EXPECT_EQ(resolved(library(), w)["type"], "resolved");
}

TEST_F(AnswersTest, ProblemsAreToldByKey) {
    const Json message = resolved(library(), wanted({"array.gap_mm=-3", "lens.index=nan"}));
    EXPECT_EQ(message["type"], "problems");
    EXPECT_EQ(message["id"], 5);
    ASSERT_EQ(message["problems"].size(), 2u);
    EXPECT_EQ(message["problems"][0]["key"], "lens.index");
    EXPECT_EQ(message["problems"][1]["key"], "array.gap_mm");
    EXPECT_THAT(ask(library(), wanted({"array.gap_mm=-3"}), Ask::What::probe)["problems"][0]["what"].get<std::string>(),
                StartsWith("is -3"));
}

TEST_F(AnswersTest, SideViewsSayWhereTheyDraw) {
    const Library all = library();
    for (const char* name : {"display", "lens"}) {
        const Json side = ask(all, wanted(), Ask::What::side, name), frame = side["frame"];
        const std::string svg = side["svg"];
        EXPECT_THAT(svg, StartsWith("<svg"));
        const double left = frame["box"][0], top = frame["box"][1], width = frame["box"][2], height = frame["box"][3];
        const auto x = [&](double z) {
            return left +
                   width * (z - frame["z_low"].get<double>()) / (frame["z_high"].get<double>() - frame["z_low"].get<double>());
        };
        const auto y = [&](double mm) {
            return top +
                   height * (frame["y_high"].get<double>() - mm) / (frame["y_high"].get<double>() - frame["y_low"].get<double>());
        };
        // the panel's line, 75 mm high; the close-up is a drawing within the drawing, cut off at its border
        const bool lens = name == std::string("lens");
        const double high = lens ? frame["y_high"].get<double>() : 37.5, low = lens ? frame["y_low"].get<double>() : -37.5;
        const std::string at = px(x(0) - (lens ? left : 0)), upper = px(y(high) - (lens ? top : 0)),
                          lower = px(y(low) - (lens ? top : 0));
        const std::string down = fmt::format("M{0} {1} {0} {2}", at, upper, lower),
                          up = fmt::format("M{0} {2} {0} {1}", at, upper, lower);
        EXPECT_TRUE(svg.find(down) != svg.npos || svg.find(up) != svg.npos) << down << "\n" << svg;
    }
}

TEST_F(AnswersTest, PlotsAreDrawnAndStop) {
    const Library all = library();
    Wanted aside = wanted();
    aside.eye_mm = {100, 0, 590};
    const std::string fov = ask(all, aside, Ask::What::plot, "fov")["svg"], spot = ask(all, aside, Ask::What::plot, "spot")["svg"];
    EXPECT_THAT(fov, HasSubstr("2 atan(p' / 2g)"));
    EXPECT_THAT(fov, HasSubstr("eye"));
    EXPECT_THAT(spot, HasSubstr("central depth plane"));
    EXPECT_THAT(spot, HasSubstr("with the diffuser"));
    int asked = 0;
    const Json stopped = answer(all, panels, aside, {3, Ask::What::plot, {}, "fov", false}, [&] { return ++asked > 3; });
    EXPECT_EQ(stopped["problems"][0]["what"], "was stopped");
    EXPECT_FALSE(stopped.contains("svg"));
    EXPECT_THAT(ask(all, wanted({"panel.pixels=[30000, 20000]"}), Ask::What::plot, "fov")["problems"][0]["key"].get<std::string>(),
                "panel.pixels");
}

TEST_F(AnswersTest, PlotsAreRenderedOnTheDeviceOfTheCommandLine) {
    const Library elsewhere({folder / "small.toml", {}, "", "", "", "abacus"}, folder);
    EXPECT_EQ(ask(elsewhere, wanted(), Ask::What::plot, "fov")["problems"][0]["key"], "--device");
}

// A medium has the control of what gives its index.
TEST_F(AnswersTest, GlassIsAWord) {
    const Json plain = resolved(library(), wanted());
    for (const Json& c : plain["controls"]) EXPECT_FALSE(c["key"].get<std::string>().ends_with(".glass"));
    EXPECT_EQ(control(plain, "lens.index")["form"], "number");
    const Json glassy = resolved(library({"lens.index=none", "lens.glass=PMMA"}), wanted({"lens.glass=PC"}));
    const Json glass = control(glassy, "lens.glass");
    EXPECT_EQ(glass["value"], "PC");
    EXPECT_EQ(glass["form"], "word");
    EXPECT_THAT(glass["words"].dump(), HasSubstr("\"N-BK7\""));
    EXPECT_EQ(control(glassy, "panel.wavelengths_nm")["unit"], "nm");
    for (const Json& message : {glassy, resolved(library({"lens.index=none", "lens.glass={ nd = 1.5, vd = 60 }"}), wanted())})
        for (const Json& c : message["controls"]) EXPECT_NE(c["key"], "lens.index");
}

TEST_F(AnswersTest, DescriptionsAreSaved) {
    const Library all = library({"array.rotation_deg=1"});
    Wanted changed = wanted({"array.gap_mm=10.5"});
    const std::string text = ask(all, changed, Ask::What::toml)["text"];
    EXPECT_EQ(write_display(parse_display(text, "text")), write_display(all.display(changed)));

    changed.shown = {Shown::Kind::model, "models/cup.obj", false};
    fs::create_directories(folder / "models/mine");
    std::ofstream(folder / "models/cup.obj") << "v 0 0 0\n";
    EXPECT_EQ(ask(all, changed, Ask::What::save, "models/new.toml")["problems"], Json::array());
    EXPECT_EQ(parse_display(std::string(ask(all, changed, Ask::What::toml)["text"]), "text").content.model, "models/cup.obj");
    Wanted read = changed;
    read.set = {"content.tilt_deg=0"};
    read.display = "models/new.toml";
    const Library plain = library();
    Display expected = all.display(changed);
    expected.content.model = (folder / "models/cup.obj").string();
    EXPECT_EQ(write_display(plain.display(read)), write_display(expected));  // its model, too, named from where it is
    EXPECT_EQ(ask(all, changed, Ask::What::save, "models/mine/deep.toml")["problems"], Json::array());
    EXPECT_EQ(read_display(folder / "models/mine/deep.toml").content.model, (folder / "models/cup.obj").string());

    const Json again = ask(all, wanted(), Ask::What::save, "models/new.toml");
    EXPECT_THAT(again["problems"][0]["what"].get<std::string>(), StartsWith("exists already"));
    EXPECT_EQ(write_display(plain.display(read)), write_display(expected));  // as it was
    EXPECT_EQ(ask(all, wanted(), Ask::What::save, "models/new.toml", true)["problems"], Json::array());
    EXPECT_EQ(plain.display(read).array.gap_mm, 11);
    EXPECT_NE(ask(all, wanted(), Ask::What::save, "../new.toml")["problems"], Json::array());
    EXPECT_NE(ask(all, wanted({"array.gap_mm=-1"}), Ask::What::save, "bad.toml")["problems"], Json::array());
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) files += entry.is_regular_file();
    EXPECT_EQ(files, 4);  // small, cup, new, deep; nothing is left over
    const Json found = ask(all, wanted(), Ask::What::files);
    EXPECT_THAT(found["displays"], ElementsAre("models/mine/deep.toml", "models/new.toml", "small.toml"));
    EXPECT_THAT(found["models"], ElementsAre("models/cup.obj"));
    EXPECT_EQ(ask(all, wanted(), Ask::What::exr)["problems"][0]["key"], "exr");
}

// Whatever a page sets, an answer comes, and it is JSON.
RC_GTEST_FIXTURE_PROP(AnswersTest, ComeToAnySetting, ()) {
    const Library all = library();
    const Json message = resolved(all, wanted());
    Wanted odd = wanted();
    const int changes = *rc::gen::inRange(1, 4);
    for (int k = 0; k < changes; ++k) {
        const Json c = *rc::gen::elementOf(std::vector<Json>(message["controls"].begin(), message["controls"].end()));
        const std::string number =
            *rc::gen::element<std::string>("0", "-1", "1e-310", "1e308", "9223372036854775807", "1e-6", "1e-3", "0.3", "1", "3",
                                           "7.5", "90", "179.9", "1e6", "1e300", "2147483647", "inf", "nan", "none");
        const bool pair = c["form"] == "pair";
        odd.set.push_back(c["key"].get<std::string>() + "=" + (pair ? "[" + number + ", " + number + "]" : number));
    }
    odd.eye_mm = {*rc::gen::element(0., 50., -1e6), 10, *rc::gen::element(600., 100., 1e6)};
    const Json answered = resolved(all, odd);
    RC_ASSERT(answered["type"] == "resolved" || answered["type"] == "problems");
    expect_finite(answered);
    ask(all, odd, Ask::What::probe);
    const bool near = *rc::gen::arbitrary<bool>();
    ask(all, odd, Ask::What::side, near ? "lens" : "display");
    ask(all, odd, Ask::What::plot, "spot");
    ask(all, odd, Ask::What::toml);
}

}  // namespace
}  // namespace lfdsim::view
