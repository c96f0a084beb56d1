// Files of ray-optics: what is read from them, and what is refused, at which place.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "files/lenses/drawn_lens.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;
using RoaJson = nlohmann::json;

RoaJson object_of(const char* type, const RoaJson& attributes) {
    return {{"__instance_type__", {"module", type}}, {"attributes", attributes}};
}

// A cemented doublet in inches: a glass by name, one by its numbers.
RoaJson roa_doublet() {
    RoaJson interfaces, profiles, gaps;
    const double curvatures[] = {0, 0.4, -0.55, -0.2, 0}, thicknesses[] = {1e10, 0.16, 0.1, 3.8};
    for (int i = 0; i < 5; ++i) {
        interfaces.push_back(object_of("Surface", {{"interact_mode", i % 4 ? "transmit" : "dummy"},
                                                   {"decenter", nullptr},
                                                   {"max_aperture", 0.5},
                                                   {"clear_apertures", RoaJson::array()},
                                                   {"profile_id", std::to_string(i)}}));
        profiles[std::to_string(i)] = object_of("Spherical", {{"cv", curvatures[i]}});
        const RoaJson media[] = {object_of("Air", RoaJson::object()),
                                 object_of("SchottGlass", {{"gname", "N-BK7"}, {"coefs", {1.5}}}),
                                 object_of("ModelGlass", {{"label", ""}, {"n", 1.6727}, {"v", 32.21}})};
        if (i < 4) gaps.push_back(object_of("Gap", {{"thi", thicknesses[i]}, {"medium", media[i % 3]}}));
    }
    return {{"optical_model",
             object_of("OpticalModel",
                       {{"system_spec", object_of("SystemSpec", {{"title", "doublet"}, {"_dimensions", "IN"}})},
                        {"seq_model", object_of("SequentialModel", {{"ifcs", interfaces}, {"gaps", gaps}, {"stop_surface", 1}})},
                        {"optical_spec",
                         object_of("OpticalSpecs", {{"spectral_region", object_of("WvlSpec", {{"wavelengths", {656.3, 587.6}},
                                                                                              {"reference_wvl", 1}})}})},
                        {"profile_dict", profiles}})}};
}

std::string roa_refused(const std::function<void(RoaJson& model, RoaJson& surface)>& change) {
    RoaJson json = roa_doublet();
    RoaJson& model = json["optical_model"]["attributes"];
    change(model, model["seq_model"]["attributes"]["ifcs"][2]["attributes"]);
    try {
        parse_rayoptics(json.dump(), "lens.roa");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(RayOptics, ReadsALens) {
    const DrawnLens lens = parse_rayoptics(roa_doublet().dump(), "lens.roa");
    EXPECT_EQ(lens.title, "doublet");
    ASSERT_EQ(lens.surfaces.size(), 5u);
    EXPECT_DOUBLE_EQ(lens.surfaces[2].curvature_per_mm, -0.55 / 25.4);
    EXPECT_DOUBLE_EQ(lens.surfaces[1].distance_mm, 0.16 * 25.4);
    EXPECT_DOUBLE_EQ(*lens.surfaces[1].semi_aperture_mm, 0.5 * 25.4);
    EXPECT_FALSE(lens.surfaces[1].is_hole);
    EXPECT_EQ(lens.surfaces[1].medium, (DrawnMedium{"N-BK7", 1, {}}));
    EXPECT_EQ(lens.surfaces[2].medium, (DrawnMedium{"", 1.6727, 32.21}));
    EXPECT_TRUE(lens.surfaces[3].medium.is_air());
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(lens.surfaces[i].is_stop, i == 1);
    EXPECT_EQ(lens.surfaces[2].place, "lens.roa: ifcs[2]");
    EXPECT_EQ(lens.beam.wavelength_nm, 587.6);
}

TEST(RayOptics, ReadsAspheresAndApertures) {
    RoaJson json = roa_doublet();
    RoaJson& model = json["optical_model"]["attributes"];
    model["system_spec"]["attributes"]["_dimensions"] = "mm";
    RoaJson& profiles = model["profile_dict"];
    profiles["1"] = object_of("EvenPolynomial", {{"cv", 0.4}, {"cc", -1}, {"coefs", {0.01, 2e-3, 0, 3e-5, 0}}});
    profiles["2"] = object_of("RadialPolynomial", {{"cv", 0.3}, {"ec", 0.25}, {"coefs", {0, 0, 0, 2e-3, 0, 1e-4}}});
    model["seq_model"]["attributes"]["ifcs"][1]["attributes"]["clear_apertures"] =
        RoaJson::array({object_of("Circular", {{"radius", 0.45}, {"x_offset", 0.0}})});
    const DrawnLens lens = parse_rayoptics(json.dump(), "lens.roa");
    EXPECT_DOUBLE_EQ(lens.surfaces[1].curvature_per_mm, 0.42);
    EXPECT_THAT(lens.surfaces[1].even_asphere, testing::ElementsAre(2e-3, 0, 3e-5));
    EXPECT_EQ(lens.surfaces[1].semi_aperture_mm, 0.45);
    EXPECT_TRUE(lens.surfaces[1].is_hole);
    EXPECT_EQ(lens.surfaces[2].conic, -0.75);
    EXPECT_THAT(lens.surfaces[2].even_asphere, testing::ElementsAre(2e-3, 1e-4));
}

TEST(RayOptics, NamesWhatCannotBeImported) {
    const struct {
        std::function<void(RoaJson&, RoaJson&)> change;
        std::string message;
    } cases[] = {
        {[](RoaJson&, RoaJson& s) { s["interact_mode"] = "reflect"; }, "lens.roa: ifcs[2]: is to reflect light"},
        {[](RoaJson&, RoaJson& s) { s["decenter"] = object_of("DecenterData", {}); }, "ifcs[2]: is shifted or tilted"},
        {[](RoaJson&, RoaJson& s) { s["phase_element"] = object_of("HolographicElement", {}); }, "ifcs[2]: has a phase element"},
        {[](RoaJson&, RoaJson& s) { s["profile_id"] = "9"; }, "ifcs[2]: has a profile of type null"},
        {[](RoaJson& m, RoaJson&) {
             m["profile_dict"]["2"] = object_of("YToroid", {{"cv", 1}});
         },
         "has a profile of type YToroid"},
        {[](RoaJson& m, RoaJson&) { m["profile_dict"]["2"] = object_of("Spherical", RoaJson::object()); },
         "ifcs[2].cv: is missing"},
        {[](RoaJson& m, RoaJson&) {
             m["profile_dict"]["2"] = object_of("RadialPolynomial", {{"cv", 1}, {"coefs", {0, 0, 1}}});
         },
         "ifcs[2]: has a term in r^3"},
        {[](RoaJson& m, RoaJson&) {
             m["profile_dict"]["2"] = object_of("EvenPolynomial", {{"cv", 1}, {"cc", 0.5}, {"coefs", {1}}});
         },
         "ifcs[2]: has the term 1 r^2 beside the conic constant 0.5"},
        {[](RoaJson&, RoaJson& s) { s["clear_apertures"] = RoaJson::array({object_of("Rectangular", {})}); },
         "has an aperture of type Rectangular"},
        {[](RoaJson&, RoaJson& s) {
             s["clear_apertures"] = RoaJson::array({object_of("Circular", {{"radius", 1}, {"y_offset", 1}})});
         },
         "has a decentred aperture"},
        {[](RoaJson& m, RoaJson&) { m["seq_model"]["attributes"]["ifcs"][2]["__instance_type__"][1] = "ThinLens"; },
         "ifcs[2]: is of type ThinLens"},
        {[](RoaJson& m, RoaJson&) {
             m["seq_model"]["attributes"]["gaps"][1]["attributes"]["medium"] = object_of("InterpolatedGlass", {{"label", "x"}});
         },
         "gaps[1]: has a medium of type InterpolatedGlass"},
        {[](RoaJson& m, RoaJson&) { m["seq_model"]["attributes"]["gaps"].erase(0); }, "seq_model.gaps is not a list of 4 to 1000"},
        {[](RoaJson& m, RoaJson&) { m.erase("seq_model"); }, "seq_model.ifcs is not a list of 3 to 1000: is this a saved lens?"},
        {[](RoaJson& m, RoaJson&) { m["system_spec"]["attributes"]["_dimensions"] = "yd"; },
         "system_spec._dimensions: yd is unknown"},
    };
    for (const auto& c : cases) EXPECT_THAT(roa_refused(c.change), HasSubstr(c.message));
}

}  // namespace
}  // namespace lfdsim
