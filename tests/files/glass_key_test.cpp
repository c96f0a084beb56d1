// Glasses in descriptions: every form reads, writes and reads back; every mistake is told once, with its place and a remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "display/colour.h"
#include "example.h"
#include "files/description/display_file.h"
#include "geometry/geometry.h"

namespace lfdsim {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string glassy(const std::string& glass) { return with("index = 1.4918", "glass = " + glass); }

const Glass& lens_glass(const Display& d) { return *d.lens.as<PlanoConvex>().glass; }

TEST(GlassKey, EveryFormReadsBackTheSame) {
    for (const char* form : {"\"N-BK7\"", "'pmma'", "{ nd = 1.4918, vd = 57.4 }", "{ cauchy = [1.48, 0.0042, 1e-5] }",
                             "{ sellmeier = [1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653] }",
                             "{ name = \"PMMA\", power_series = [2.2, 0, 0.01, -2], range_nm = [400, 700] }",
                             "{ conrady = [1.48, 0.01, 0.001] }", "{ herzberger = [1.5, 0.01, 1e-4, 0, 0, 0] }",
                             "{ resonances = [1.2, 1, 0.01] }", "{ sellmeier_2 = [0.2, 1, 0.1, 0.3, 0.2] }",
                             "{ handbook_1 = [2.2, 0.01, 0.02, 0.01] }", "{ handbook_2 = [1.2, 1, 0.01, 0.01] }"}) {
        const Display d = parse_display(glassy(form), "d");
        EXPECT_EQ(parse_display(write_display(d), "written"), d) << form;
        EXPECT_TRUE(disperses(d));
        if (lens_glass(d).name.empty()) {
            EXPECT_THAT(form, HasSubstr("{ " + std::string(key_of(lens_glass(d).formula)) + " = "));
        }
        EXPECT_FALSE(d.lens.as<PlanoConvex>().index);
    }
    const Display d = parse_display(glassy("\"PMMA\""), "d");
    EXPECT_EQ(lens_glass(d), shipped_glass("PMMA")->glass);
    EXPECT_NEAR(index_of(lens_glass(parse_display(glassy("{ nd = 1.5, vd = 50 }"), "d")), 587.5618), 1.5, 1e-15);
    // six numbers of Schott's, as the catalogue has them
    const std::string bk7 = "{ sellmeier = [1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653] }";
    EXPECT_EQ(index_of(lens_glass(parse_display(glassy(bk7), "d")), 500), index_of(shipped_glass("N-BK7")->glass, 500));
}

TEST(GlassKey, OfLayersAndSurfaces) {
    const Display d = parse_display(with("type = \"plano_convex\"\nsphere_radius_mm = 7.28\naperture_radius_mm = 6\nindex = 1.4918",
                                         "type = \"surfaces\"\nsurface = [{semi_aperture_mm = 6, distance_mm = 4, glass = \"PC\"}, "
                                         "{semi_aperture_mm = 6, curvature_per_mm = -0.1}]") +
                                        "[[panel.layer]]\nthickness_mm = 1\nglass = \"S-BSL7\"\n",
                                    "d");
    EXPECT_EQ(d.panel.layers[0].glass, shipped_glass("S-BSL7")->glass);
    EXPECT_EQ(d.lens.as<SurfaceLens>().surfaces[0].glass, shipped_glass("PC")->glass);
    EXPECT_EQ(resolve(d).surfaces[0].index_above, index_of(shipped_glass("PC")->glass, 549.1));
    EXPECT_EQ(parse_display(write_display(d), "written"), d);
}

TEST(GlassKey, Overrides) {
    const auto set = [](std::vector<std::string> overrides) { return parse_display(example_text, "d", overrides); };
    EXPECT_EQ(lens_glass(set({"lens.index=none", "lens.glass=PC"})).name, "PC");
    EXPECT_EQ(lens_glass(set({"lens.index=none", "lens.glass=\"PC\""})).name, "PC");
    EXPECT_EQ(lens_glass(set({"lens.index=none", "lens.glass={ nd = 1.5, vd = 60 }"})).coefficients, (std::vector{1.5, 60.}));
    EXPECT_EQ(set({"lens.index=none", "lens.glass=PC", "lens.glass=none", "lens.index=1.6"}).lens.as<PlanoConvex>().index, 1.6);
    const Display d =
        set({"panel.wavelengths_nm=[630, 530, 450]", "panel.primary_widths_nm=[20, 30, 20]", "render.wavelength_samples=5"});
    EXPECT_EQ(d.panel.wavelengths_nm, (Vec3d{630, 530, 450}));
    EXPECT_EQ(wavelengths_of(d, 0).size(), 5u);
    EXPECT_EQ(write_display(parse_display(write_display(d), "written")), write_display(d));
}

struct Mistake {
    const char* glass;
    const char* says;
};

TEST(GlassKey, MistakesAreToldOnce) {
    for (const Mistake& m : {
             Mistake{"\"N-BK8\"", "d:10:9: lens.glass: no catalogue has a glass \"N-BK8\"; did you mean N-BK7"},
             {"\"qqqqqqqqqqqqqqq\"", "no catalogue has a glass \"qqqqqqqqqqqqqqq\"; `lfdsim glass` lists"},
             {"\"\"", "lens.glass: is empty; give the name of a glass"},
             {"1.5", "is a number with a fraction; give the name of a glass, { sellmeier ="},
             {"{}", "is an empty table; give { sellmeier ="},
             {"{ n = 1.5 }", "has the unknown key n; give { sellmeier ="},
             {"{ nd = 1.5 }", "lens.glass: vd is missing"},
             {"{ vd = 50 }", "lens.glass: nd is missing"},
             {"{ nd = 1.5, vd = 0 }", "vd = 0; an Abbe number is more than 0"},
             {"{ nd = 1.5, vd = \"60\" }", "vd is a string; give a number"},
             {"{ nd = 0.5, vd = 60 }", "has an index of 0.50"},
             {"{ nd = 5, vd = 60 }", "allowed is 1 to 4"},
             {"{ nd = 1.5, vd = 60, cauchy = [1, 2, 3] }", "has more than one formula"},
             {"{ cauchy = [] }", "cauchy has 0 elements; give a list of 3 numbers"},
             {"{ cauchy = [1.5, 0.01] }", "cauchy has 2 elements; give a list of 3 numbers"},
             {"{ sellmeier = [1, 0.01, 1, 0.02, 1] }", "sellmeier has 5 elements; give pairs B, C, as a list of 6 numbers"},
             {"{ power_series = [2.2] }", "power_series has 1 element; give pairs of a coefficient and a power"},
             {"{ name = \"MINE\" }", "has no formula"},
             {"{ name = 5, nd = 1.5, vd = 60 }", "name is an integer; give a string"},
             {"{ nd = 1.5, vd = 60, range_nm = [700, 400] }", "range_nm is not two wavelengths, the shorter first"},
             {"{ nd = 1.5, vd = 60, range_nm = [400, 600] }", "the glass is valid from 400 to 600 nm, but is used at 611.4 nm"},
             {"{ sellmeier = [1, 0.3, 0, 0, 0, 0] }", "the glass has an index of"},
             {"{ cauchy = [1.5, \"x\", 0] }", "cauchy element 1 is a string"},
             {"{ cauchy = [nan, 0, 0] }", "has an index of nan"},
             {"\"PC\"\nindex = 1.5", "both lens.index and lens.glass given; leave one out"},
         }) {
        try {
            parse_display(glassy(m.glass), "d");
            ADD_FAILURE() << m.glass << " is accepted";
        } catch (const InputError& error) {
            ASSERT_EQ(error.problems.size(), 1u) << error.what();
            EXPECT_THAT(error.what(), HasSubstr(m.says));
        }
    }
}

// A catalogue in a file's folder, one given on the command line, and what is wrong with them.
TEST(GlassKey, Catalogues) {
    const fs::path folder = fs::path(testing::TempDir()) / "lfdsim-glass-catalogues";
    fs::create_directories(folder / "deeper");
    const auto write = [&](const char* name, const std::string& text) { std::ofstream(folder / name) << text; };
    write("mine.agf",
          "NM MYGLASS 5 0 1.5 60\nCD 1.48 0.01 0.001 0 0 0\nLD 0.4 0.7\nNM PMMA 5 0 1 0\nCD 1.9 0.01 0 0 0 0\nLD 0.4 0.7\n");
    write("bad.agf", "NM X 1 0 1.5 60\nCD 1 2 x\n");
    const auto with_catalogues = [](const std::string& list, const std::string& glass) {
        return with("name = \"example\"", "glass_catalogues = " + list, glassy(glass));
    };
    write("d.toml", with_catalogues("[\"mine.agf\"]", "\"myglass\""));
    const Display d = read_display(folder / "d.toml");
    EXPECT_EQ(lens_glass(d).name, "MYGLASS");
    EXPECT_DOUBLE_EQ(index_of(lens_glass(d), 500), 1.48 + 0.02 + 0.001 * std::pow(2, 3.5));
    EXPECT_EQ(d.glass_catalogues, std::vector{(folder / "mine.agf").string()});
    // what a picture says of itself can be read without the catalogue
    Display alone = parse_display(write_display(d), "written");
    EXPECT_TRUE(alone.glass_catalogues.empty());
    alone.glass_catalogues = d.glass_catalogues;
    EXPECT_EQ(alone, d);
    // the user's glass before the one that ships
    EXPECT_NEAR(index_of(lens_glass(read_display(folder / "d.toml", {"lens.glass=PMMA"})), 500), 1.92, 1e-12);
    const auto fault = [&](const std::vector<std::string>& set) -> std::string {
        try {
            read_display(folder / "d.toml", set);
            return "";
        } catch (const InputError& error) {
            EXPECT_EQ(error.problems.size(), 1u) << error.what();
            return error.what();
        }
    };
    const std::string in_folder = "glass_catalogues=[\"" + (folder / "bad.agf").string() + "\"]";
    EXPECT_THAT(fault({in_folder}), HasSubstr("bad.agf:2: CD: \"x\" is not a number"));
    EXPECT_THAT(fault({"glass_catalogues=[\"none.agf\"]"}), HasSubstr("none.agf: there is no such file"));
    EXPECT_THAT(fault({"glass_catalogues=\"mine.agf\""}), HasSubstr("glass_catalogues: is a string; give a list of strings"));
    EXPECT_THAT(fault({"glass_catalogues=[1]"}), HasSubstr("element 0 is an integer; give a string"));
    EXPECT_THAT(fault({"glass_catalogues=[\"a\",\"a\",\"a\",\"a\",\"a\",\"a\",\"a\",\"a\",\"a\"]"}),
                HasSubstr("has 9 files, allowed are 8"));
    EXPECT_THAT(fault({"lens.glass=myglas"}), HasSubstr("did you mean MYGLASS"));
    fs::remove_all(folder);
}

}  // namespace
}  // namespace lfdsim
