// Files of Optiland: what is read from them, and what is refused, at which place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/constants.h"
#include "files/lenses/drawn_lens.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;
using Json = nlohmann::json;

Json frame(const Json& z) {
    return {{"x", 0.0}, {"y", 0.0}, {"z", z}, {"rx", 0.0}, {"ry", 0.0}, {"rz", 0.0}, {"reference_cs", nullptr}};
}

Json surface(double z, const Json& radius, const Json& material, bool is_stop = false) {
    return {{"type", "Surface"},
            {"geometry", {{"type", "StandardGeometry"}, {"cs", frame(z)}, {"radius", radius}, {"conic", 0.0}}},
            {"material_post", material},
            {"is_stop", is_stop},
            {"aperture", nullptr},
            {"interaction_model",
             {{"type", "RefractiveReflectiveModel"}, {"is_reflective", false}, {"coating", nullptr}, {"bsdf", nullptr}}}};
}

const Json air = {{"type", "IdealMaterial"}, {"index", 1.0}, {"absorp", 0.0}};

// A cemented doublet: a glass by name, one by its numbers.
Json doublet() {
    Json object = surface(0, "inf", air);
    object["type"] = "ObjectSurface";
    object["geometry"] = {{"type", "Plane"}, {"cs", frame("-inf")}, {"radius", "inf"}};
    return {
        {"version", 1.0},
        {"name", "doublet"},
        {"aperture", {{"type", "EPD"}, {"value", 20.0}}},
        {"fields",
         {{"fields", {{{"x", 0}, {"y", 0}}, {{"x", 0}, {"y", -3.5}}}}, {"field_definition", {{"field_type", "AngleField"}}}}},
        {"wavelengths",
         {{"wavelengths",
           {{{"value", 0.48}, {"is_primary", false}, {"unit", "um"}}, {{"value", 0.55}, {"is_primary", true}, {"unit", "um"}}}}}},
        {"surface_group",
         {{"surfaces",
           {object, surface(0, 62.8, {{"type", "Material"}, {"name", "N-BK7"}, {"reference", "schott"}}, true),
            surface(4, -45.7, {{"type", "AbbeMaterial"}, {"index", 1.6727}, {"abbe", 32.21}}), surface(6.5, -128.2, air),
            surface(103.6, "inf", air)}}}}};
}

// As Python writes it: infinities are bare words, which JSON has not.
std::string saved(const Json& json) {
    std::string text = json.dump(4);
    for (const auto& [word, bare] : {std::pair{"\"inf\"", "Infinity"}, {"\"-inf\"", "-Infinity"}, {"\"nan\"", "NaN"}})
        for (std::size_t at = 0; (at = text.find(word, at)) != text.npos;) text.replace(at, std::string_view(word).size(), bare);
    return text;
}

std::string optiland_refused(const std::string& text) {
    try {
        parse_optiland(text, "lens.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string optiland_refused_with(const std::function<void(Json& all, Json& surfaces)>& change) {
    Json json = doublet();
    change(json, json["surface_group"]["surfaces"]);
    return optiland_refused(saved(json));
}

TEST(Optiland, ReadsALens) {
    const DrawnLens lens = parse_optiland(saved(doublet()), "lens.json");
    EXPECT_EQ(lens.title, "doublet");
    ASSERT_EQ(lens.surfaces.size(), 5u);
    EXPECT_TRUE(std::isinf(lens.surfaces[0].distance_mm));
    EXPECT_EQ(lens.surfaces[1].curvature_per_mm, 1 / 62.8);
    EXPECT_EQ(lens.surfaces[1].distance_mm, 4);
    EXPECT_EQ(lens.surfaces[1].medium, (DrawnMedium{"N-BK7", 1, {}}));
    EXPECT_TRUE(lens.surfaces[1].is_stop);
    EXPECT_EQ(lens.surfaces[2].medium, (DrawnMedium{"", 1.6727, 32.21}));
    EXPECT_EQ(lens.surfaces[3].distance_mm, 103.6 - 6.5);
    EXPECT_EQ(lens.surfaces[4].curvature_per_mm, 0);
    EXPECT_EQ(lens.surfaces[2].place, "lens.json: surface_group.surfaces[2]");
    EXPECT_EQ(lens.beam.entrance_pupil_mm, 20);
    EXPECT_DOUBLE_EQ(*lens.beam.field_slope, std::tan(3.5 * degree));
    EXPECT_NEAR(*lens.beam.wavelength_nm, 550, 1e-9);
    EXPECT_THAT(lens.notes, testing::IsEmpty());
}

TEST(Optiland, ReadsAspheresAndApertures) {
    Json json = doublet();
    Json& s = json["surface_group"]["surfaces"][1];
    s["geometry"]["type"] = "EvenAsphere";
    s["geometry"]["conic"] = -1.0;
    s["geometry"]["coefficients"] = {1e-3, 2e-5, 0.0};
    s["aperture"] = {{"type", "RadialAperture"}, {"r_max", 11.5}, {"r_min", 0}};
    const DrawnSurface read = parse_optiland(saved(json), "x").surfaces[1];
    EXPECT_DOUBLE_EQ(read.curvature_per_mm, 1 / 62.8 + 2e-3);
    EXPECT_THAT(read.even_asphere, testing::ElementsAre(2e-5));
    EXPECT_EQ(read.semi_aperture_mm, 11.5);
    EXPECT_TRUE(read.is_hole);
    json["aperture"] = {{"type", "float_by_stop_size"}, {"value", 9.0}};
    s["aperture"] = nullptr;
    EXPECT_EQ(parse_optiland(saved(json), "x").surfaces[1].semi_aperture_mm, 4.5);
}

TEST(Optiland, ReadsFieldsOfTwoAnglesOrHeights) {
    Json json = doublet();
    json["fields"]["fields"][0] = {{"x", -3}, {"y", 2}};
    EXPECT_DOUBLE_EQ(*parse_optiland(saved(json), "x").beam.field_slope, std::hypot(std::tan(3 * degree), std::tan(2 * degree)));
    json["fields"]["field_definition"]["field_type"] = "ObjectHeightField";
    const DrawnBeam beam = parse_optiland(saved(json), "x").beam;
    EXPECT_DOUBLE_EQ(*beam.object_height_mm, std::hypot(3, 2));
    EXPECT_FALSE(beam.field_slope);
    json["fields"]["telecentric"] = true;
    EXPECT_FALSE(parse_optiland(saved(json), "x").beam.object_height_mm);
}

TEST(Optiland, NamesWhatCannotBeImported) {
    const struct {
        std::function<void(Json&, Json&)> change;
        std::string message;
    } cases[] = {
        {[](Json&, Json& s) { s[2]["geometry"]["type"] = "ToroidalGeometry"; }, "[2].geometry: is of type ToroidalGeometry"},
        {[](Json&, Json& s) { s[2]["geometry"]["type"] = "OddAsphere"; }, "[2].geometry: is of type OddAsphere"},
        {[](Json&, Json& s) { s[2]["geometry"]["cs"]["rx"] = 0.1; }, "[2].geometry.cs: rx = 0.1: is shifted or tilted"},
        {[](Json&, Json& s) { s[2]["geometry"]["cs"]["reference_cs"] = frame(0); }, "[2].geometry.cs: has a reference_cs"},
        {[](Json&, Json& s) { s[2]["geometry"]["cs"].erase("z"); }, "[2].geometry.cs.z: is missing"},
        {[](Json&, Json& s) { s[2]["geometry"]["cs"]["z"] = "nan"; }, "[2].geometry.cs.z: is NaN; give a finite number"},
        {[](Json&, Json& s) { s[2]["geometry"]["cs"]["z"] = "inf"; }, "[2].geometry.cs.z: is infinite; give a finite number"},
        {[](Json&, Json& s) { s[2]["geometry"]["radius"] = 0; }, "[2].geometry.radius: is 0"},
        {[](Json&, Json& s) { s[2]["geometry"]["radius"] = "wide"; }, "[2].geometry.radius: is a text; give a number"},
        {[](Json&, Json& s) { s[2]["interaction_model"]["is_reflective"] = true; }, "[2]: is a mirror"},
        {[](Json&, Json& s) { s[2]["interaction_model"]["type"] = "ThinLensInteractionModel"; }, "[2]: acts as a ThinLens"},
        {[](Json&, Json& s) { s[2]["interaction_model"]["bsdf"] = Json::object(); }, "[2]: scatters light"},
        {[](Json&, Json& s) { s[2]["type"] = "ParaxialSurface"; }, "[2]: is of type ParaxialSurface"},
        {[](Json&, Json& s) { s[2]["material_post"]["type"] = "Mirror"; }, "[2].material_post: is of type Mirror"},
        {[](Json&, Json& s) { s[1]["material_post"].erase("name"); }, "[1].material_post: has no name"},
        {[](Json&, Json& s) {
             s[2]["aperture"] = {{"type", "RectangularAperture"}};
         },
         "[2].aperture: is of type RectangularAperture"},
        {[](Json&, Json& s) {
             s[2]["aperture"] = {{"type", "RadialAperture"}, {"r_min", 1}, {"r_max", 2}};
         },
         "has a central obscuration"},
        {[](Json&, Json& s) { s[2] = 5; }, "[2]: is of type null"},
        {[](Json&, Json& s) {
             s = Json::array({1, 2});
         },
         "surface_group.surfaces is not a list of 3 to 1000"},
        {[](Json& all, Json&) { all = Json::array(); }, "is this a saved lens?"},
    };
    for (const auto& c : cases) EXPECT_THAT(optiland_refused_with(c.change), HasSubstr(c.message));
}

TEST(Optiland, SaysWhereAFileIsCutOrNoJson) {
    const std::string whole = saved(doublet());
    for (std::size_t end = 0; end < whole.size(); end += 7)
        EXPECT_THAT(optiland_refused(whole.substr(0, end)), HasSubstr("lens.json: is not JSON: parse error at line")) << end;
    EXPECT_THAT(optiland_refused("{\n  \"a\": Infinity x}"), HasSubstr("line 2, column 17"));  // also behind a bare word
    EXPECT_THAT(optiland_refused(std::string(1 << 20, '[')), HasSubstr("parse error"));
    EXPECT_THAT(optiland_refused(std::string((1 << 20) + 1, ' ')), HasSubstr("1048576"));
}

TEST(Optiland, ChangesNoWordWithinAString) {
    Json json = doublet();
    json["name"] = "\\ \"Infinity\" NaN";
    EXPECT_EQ(parse_optiland(saved(json), "x").title, "\\ \"Infinity\" NaN");
}

}  // namespace
}  // namespace lfdsim
