// Calibrations: what is read from them, what is made of it, what is said, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibrations.h"
#include "files/description/display_file.h"
#include "geometry/subpixels.h"

namespace lfdsim {
namespace {

using namespace calibrations;
using testing::Contains;
using testing::HasSubstr;

Json some_unit() { return plain(48.3716, -6.4282, 0.3184, 310, 720, 960, 42); }

std::string calibration_refused(const std::string& text, const CalibrationRequest& request = {}) {
    try {
        import_calibration(parse_calibration(text, "visual.json"), request, "visual.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Calibration, ReadsPlainAndWrappedNumbers) {
    const Json json = some_unit();
    const Calibration wrapped = parse_calibration(json.dump(), "x");
    Json bare;
    for (const auto& [key, content] : json.items()) bare[key] = content.is_object() ? content["value"] : content;
    for (const Calibration& c : {wrapped, parse_calibration(bare.dump(), "x")}) {
        EXPECT_EQ(c.serial, "INVENTED-2");
        EXPECT_EQ(c.pitch_per_inch, 48.3716);
        EXPECT_EQ(c.slope, -6.4282);
        EXPECT_EQ(c.center, 0.3184);
        EXPECT_EQ(c.dpi, 310);
        EXPECT_EQ(c.pixels, (std::array<std::int64_t, 2>{720, 960}));
        EXPECT_EQ(c.view_cone_deg, 42);
        EXPECT_FALSE(c.flip_image_x || c.flip_subpixels);
        EXPECT_THAT(c.notes, testing::IsEmpty());
    }
    EXPECT_TRUE(is_calibration(bare.dump(), "x"));
    EXPECT_FALSE(is_calibration(R"({"surface_group": {"surfaces": []}})", "x"));
    EXPECT_FALSE(is_calibration("[1, 2]", "x"));
}

// As the maker's service and its libraries hand calibrations out: with other things around them, as text, with small letters.
TEST(Calibration, IsFoundWhereverItStands) {
    const Json json = published_unit();
    Json small = json, other = json;
    small["cellPatternMode"] = small["CellPatternMode"];
    small["dPI"] = small["DPI"];
    small.erase("CellPatternMode");
    small.erase("DPI");
    other["serial"] = "ANOTHER";
    Json devices, config, text, coded, twice, two;
    devices["error"] = 0;
    devices["devices"][0]["hwid"] = "X01";
    devices["devices"][0]["calibration"] = json;
    devices["devices"][0]["defaultQuilt"]["tileX"] = 11;
    config["configValue"] = json;
    text["payload"]["0"]["calibration"]["value"] = json.dump();
    coded["data"] = Json(json.dump()).dump();  // a text that is a text in JSON
    twice["a"] = twice["b"] = json;
    two["devices"][0]["calibration"] = json;
    two["devices"][1]["calibration"] = other;
    const Calibration wanted = parse_calibration(json.dump(), "x");
    for (const auto& [wrapped, place] : {std::pair(devices, "devices[0].calibration"),
                                         {config, "configValue"},
                                         {text, "payload.0.calibration.value"},
                                         {coded, "data"},
                                         {small, ""},
                                         {twice, "a"}}) {
        ASSERT_TRUE(is_calibration(wrapped.dump(), "x")) << place;
        const Calibration c = parse_calibration(wrapped.dump(), "x");
        EXPECT_EQ(c.place, place);
        EXPECT_EQ(c.pitch_per_inch, wanted.pitch_per_inch);
        EXPECT_EQ(c.cells, wanted.cells);
        EXPECT_EQ(c.cell_pattern, wanted.cell_pattern);
        EXPECT_EQ(c.view_cone_deg, wanted.view_cone_deg);
        if (c.place.empty())
            EXPECT_EQ(c.notes, wanted.notes);
        else
            EXPECT_THAT(c.notes, Contains(HasSubstr("is under " + c.place)));
    }
    EXPECT_THAT(calibration_refused(two.dump()),
                testing::AllOf(HasSubstr("contains 2 calibrations"), HasSubstr("devices[0].calibration"),
                               HasSubstr("devices[1].calibration (ANOTHER)")));
    Json bad = devices;
    bad["devices"][0]["calibration"].erase("pitch");
    EXPECT_THAT(calibration_refused(bad.dump()), HasSubstr("visual.json: devices[0].calibration: pitch: is missing"));
}

TEST(Calibration, KeepsTheViewConeForQuilts) {
    EXPECT_EQ(imported(some_unit()).display.content.view_cone_deg, 42);
    EXPECT_THAT(write_imported(imported(some_unit()), {}, ""), HasSubstr("view_cone_deg = 42"));
}

TEST(Calibration, MakesPanelLensesAndEye) {
    const Display d = imported(some_unit()).display;
    EXPECT_EQ(d.panel.pixel_pitch_mm, 25.4 / 310);
    EXPECT_EQ(d.panel.subpixels, SubpixelLayout::rgb_stripe);
    const double turn = std::atan(1 / 6.4282);
    EXPECT_NEAR(*d.array.slant_deg * std::acos(-1.) / 180, turn, 1e-12);
    const double tan_cone = std::tan(21 * std::acos(-1.) / 180), g = 25.4 / 48.3716 / (2 * tan_cone * std::cos(turn));
    EXPECT_NEAR(*d.array.gap_mm, g, 1e-6);
    EXPECT_EQ(resolve(d).focal_length_mm, *d.array.gap_mm);  // focused on the panel
    EXPECT_EQ(d.content.viewing_distance_mm, d.camera.position_mm[2]);
    EXPECT_NEAR(960 * d.panel.pixel_pitch_mm / d.content.viewing_distance_mm, 2 * std::tan(7 * std::acos(-1.) / 180), 1e-3);
    EXPECT_NEAR(d.array.pitch_mm[0] * (1 + *d.array.gap_mm / (d.content.viewing_distance_mm - *d.array.gap_mm)), 25.4 / 48.3716,
                1e-12);
    EXPECT_EQ(d.name, "INVENTED-2");

    CalibrationRequest request;
    request.gap_mm = 0.9;
    request.distance_mm = 500;
    request.index = 1.5;
    const Display sheet = imported(some_unit(), request).display;
    const Geometry of_sheet = resolve(sheet);
    EXPECT_TRUE(of_sheet.glued);
    EXPECT_NEAR(of_sheet.gap_mm, 0.9, 2e-6);
    EXPECT_NEAR(of_sheet.focal_length_mm, 0.9, 2e-6);
    EXPECT_NEAR(of_sheet.vertex_plane_mm, 1.5 * 0.9, 2e-6);
}

TEST(Calibration, PutsColoursWhereTheyAre) {
    for (const bool flip_image : {false, true})
        for (const bool flip_subpixels : {false, true}) {
            Json json = some_unit();
            json["flipImageX"]["value"] = flip_image;
            json["flipSubp"]["value"] = flip_subpixels;
            const Display d = imported(json).display;
            EXPECT_EQ(d.panel.subpixels, flip_image != flip_subpixels ? SubpixelLayout::bgr_stripe : SubpixelLayout::rgb_stripe);
        }
    const Display d = imported(published_unit()).display;  // odd columns upside down; rows here run downwards
    const auto place = [&](int channel, int column) { return *centroid(d.panel, channel, column, 7); };
    EXPECT_NEAR(place(0, 4)[0], -0.31, 1e-12);
    EXPECT_NEAR(place(0, 4)[1], -0.25, 1e-12);
    EXPECT_NEAR(place(1, 5)[0], 0.28, 1e-12);
    EXPECT_NEAR(place(1, 5)[1], 0.25, 1e-12);
    EXPECT_NEAR(place(2, 5)[1], -0.25, 1e-12);
    const Subpixel& first = d.panel.custom.front();  // as wide as from red to green, half a pixel high: no two overlap
    EXPECT_NEAR(first.rect[2] - first.rect[0], 0.59, 1e-12);
    EXPECT_NEAR(first.rect[3] - first.rect[1], 0.5, 1e-12);
}

TEST(Calibration, IsReadBackAsItWasWritten) {
    CalibrationRequest glass;
    glass.index = 1.7;
    for (const CalibrationRequest& request : {CalibrationRequest{}, glass})
        for (const Json& json : {some_unit(), published_unit()}) {
            const Imported made = imported(json, request);
            const std::string text = write_imported(made, {}, "lfdsim import");
            EXPECT_EQ(parse_display(text, "text"), made.display) << text;
            for (const std::string& note : made.notes) EXPECT_THAT(text, HasSubstr("# - " + note.substr(0, 40)));
        }
}

TEST(Calibration, SaysWhatItDoesNotRead) {
    Json json = with_cells(some_unit(), 0, {cell(-0.3, 0, 0, 0, 0.3, 0), cell(-0.3, 0, 0, 0, 0.3, 0)});
    json["invView"]["value"] = 0;
    json["flipImageY"]["value"] = 1;
    json["flipSubp"]["value"] = 1;
    json["verticalAngle"]["value"] = 0.2;
    json["fringe"] = {{"value", 0}};
    json["configVersion"] = "9.9";
    const std::vector<std::string> notes = imported(json).notes;
    for (const char* words :
         {"invView is 0", "flipImageY is not read", "flipSubp is not read", "Not read: verticalAngle.", "configVersion is 9.9",
          "Only the first 1 of 2 subpixelCells", "Assumed: the calibration holds for an eye at",
          "Assumed: cylindrical lenses without aberrations", "their sizes, which it does not contain", "viewCone of 42"})
        EXPECT_THAT(notes, Contains(HasSubstr(words)));
}

TEST(Calibration, NamesTheKeyThatIsWrong) {
    for (const char* key : {"pitch", "slope", "center", "DPI", "screenW", "screenH"}) {
        Json json = some_unit();
        json.erase(key);
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr(std::string("visual.json: ") + key + ": is missing"));
        json[key] = {{"value", "12"}};
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr(std::string(key) + ": is a text; give a number"));
        json[key] = Json::array({1, 2});
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr(std::string(key) + ": is a list; give a number"));
        json[key] = {{"value", 1e300}};
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr(std::string(key) + ": is 1e+300; allowed is"));
        std::string text = json.dump();
        text.replace(text.find("1e+300"), 6, "NaN");
        EXPECT_THAT(calibration_refused(text), HasSubstr(std::string(key) + ": is NaN; give a finite number"));
        if (std::string(key) == "center") continue;
        json[key] = {{"value", 0}};
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr(std::string(key) + ": is 0"));
        if (std::string(key) == "slope") continue;
        json[key] = {{"value", -50}};
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr(std::string(key) + ": is -50; allowed is"));
    }
    const struct {
        const char* key;
        Json value;
        std::string message;
    } cases[] = {
        {"screenW", 99.5, "screenW: is 99.5; give a whole number of pixels"},
        {"screenH", 1e9, "screenH: is 1000000000; allowed is 1 to 100000"},
        {"viewCone", 0, "viewCone: is 0; allowed is 1 to 170"},
        {"viewCone", nullptr, "viewCone: is missing, which determines the gap; give --gap-mm"},
        {"flipImageX", 3, "flipImageX: is 3; allowed is 0 to 1"},
        {"flipImageX", "yes", "flipImageX: is a text; give a number"},
        {"pitch", 9000, "pitch: is 9000 lenses per inch, with 0.0344 of the panel's pixels behind each"},
        {"CellPatternMode", 1, "CellPatternMode: is 1, but there are no subpixelCells; give 2, or mode 0"},
        {"CellPatternMode", 7, "CellPatternMode: is 7; allowed is 0 to 4"},
        {"subpixelCells", 5, "subpixelCells: is not a list of 1 to 16 cells"},
        {"subpixelCells", Json::array({1}), "subpixelCells[0].ROffsetX: is missing"},
        {"subpixelCells", Json::array({cell(0, 0, 0, 0, 0.3, 0)}), "subpixelCells: have two subpixels at the same position"},
        {"subpixelCells", Json::array({cell(-9, 0, 0, 0, 0.3, 0)}), "subpixelCells[0].ROffsetX: is -9; allowed is -1 to 1"},
        {"subpixelCells", delta_cells(), "CellPatternMode: is missing, and there are 2 subpixelCells"},
    };
    for (const auto& c : cases) {
        Json json = some_unit();
        json[c.key] = c.value;
        EXPECT_THAT(calibration_refused(json.dump()), HasSubstr("visual.json: " + c.message));
    }
    EXPECT_THAT(calibration_refused(with_cells(some_unit(), 3, delta_cells()).dump()),
                HasSubstr("subpixelCells: has 2, but CellPatternMode 3 repeats 4"));
    EXPECT_THAT(calibration_refused(R"({"slope": 6})"), HasSubstr("pitch: is missing"));
    for (const char* nothing : {"{}", "[]", "7", R"({"configValue": "{"})"})
        EXPECT_THAT(calibration_refused(nothing), HasSubstr("is not a calibration"));
}

TEST(Calibration, RefusesKeysGivenTwice) {
    const std::string whole = some_unit().dump(), more = "{\"pitch\": 50, ";
    EXPECT_THAT(calibration_refused(more + whole.substr(1)), HasSubstr("visual.json: pitch: is given twice"));
    EXPECT_THAT(calibration_refused("{\"a\": [1, {\"b\": 1, \"b\": 2}]}"), HasSubstr("visual.json: a[1].b: is given twice"));
    Json both = some_unit();
    both["Pitch"] = both["pitch"];
    EXPECT_THAT(calibration_refused(both.dump()), HasSubstr("visual.json: pitch: is given twice, as pitch and Pitch"));
    const Json within = {{"devices", Json::array({{{"calibration", more + whole.substr(1)}}})}};
    EXPECT_THAT(calibration_refused(within.dump()), HasSubstr("visual.json: devices[0].calibration: pitch: is given twice"));
}

TEST(Calibration, RefusesWhatTheRequestMakesImpossible) {
    CalibrationRequest request;
    request.distance_mm = 0.5;
    EXPECT_THAT(calibration_refused(some_unit().dump(), request), HasSubstr("--distance-mm: the eye is 0.5 mm from the panel"));
    request = {};
    request.index = 1.2;
    EXPECT_THAT(calibration_refused(some_unit().dump(), request),
                HasSubstr("--index: is 1.2: cylinders that focus 0.6922 mm away"));
    request.index = 1.38;  // what the message says is enough
    EXPECT_THAT(calibration_refused(some_unit().dump(), request), "");
}

TEST(Calibration, StandsHostileFiles) {
    const std::string whole = published_unit().dump();
    for (std::size_t end = 0; end < whole.size(); end += 11)
        EXPECT_THAT(calibration_refused(whole.substr(0, end)), HasSubstr("visual.json: is not JSON: parse error at line")) << end;
    const std::size_t deep = 250000;
    EXPECT_THAT(calibration_refused(R"({"pitch": )" + std::string(deep, '[') + std::string(deep, ']') + "}"),
                HasSubstr("pitch: is a list; give a number"));
    EXPECT_THAT(calibration_refused(R"({"a": )" + std::string(deep, '[') + std::string(deep, ']') + "}"),
                HasSubstr("is not a calibration"));
    EXPECT_THAT(calibration_refused(std::string((1 << 20) + 1, ' ')), HasSubstr("1048576"));
    EXPECT_THAT(calibration_refused(R"({"pitch": 1e999})"), HasSubstr("is not JSON"));
}

}  // namespace
}  // namespace lfdsim
