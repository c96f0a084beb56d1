// Two displays beside one another: what differs, by how much, and whether that is more than the stated errors.
#include "report/pages/side_by_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "../image/helpers.h"
#include "../optics/example.h"
#include "base/constants.h"

namespace lfdsim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Result result(double shift, bool error = true) {
    Result r;
    r.findings = {{"Edge <a>", "deg", {-20 - shift, 20 + shift}, {}, "", error ? std::vector{0.1, 0.2} : std::vector<double>{}},
                  {"Far", "mm", {10, infinity}, {}},
                  {shift > 0 ? "Second's own" : "First's own", "", {1}, {}}};
    r.plots = {{"plot", shift > 0 ? "Second's plot" : "First's plot", "x", "y", {{"", {0, 1}, {0, 1}}}}};
    r.pictures = {{"picture", "A picture", Image(30, 20)}};
    return r;
}

struct Comparison {
    test::TemporaryFolder place;
    std::vector<MeasuredDisplay> displays;
    const Measure &fov = measure_named("fov"), &dof = measure_named("dof");

    explicit Comparison(double shift, bool error = true) {
        Display one = example(), other = example();
        one.name = "one", other.name = "<other>";
        other.array.gap_mm = 5.25;
        other.diffuser = Diffuser{30, {4, 3}};
        one.diffuser.reset();
        displays.push_back({"one", one, ResultFolder(place / "one", {{"lfdsim", "1.2.3"}})});
        displays.push_back({"_other_", other, ResultFolder(place / "_other_", {{"lfdsim", "1.2.3"}})});
        displays[0].folder.write(fov, result(0), 1);
        displays[1].folder.write(fov, result(shift, error), 1);
        displays[1].folder.write(dof, result(1), 1);
    }
    std::string html(const std::string& missing = "") const {
        return side_by_side_html(displays, differences(displays), "lfdsim analyze 'x y'", missing);
    }
};

Json finding(const Json& all, const std::string& measure, const std::string& what) {
    for (const Json& f : all["findings"])
        if (f["measure"] == measure && f["what"] == what) return f;
    return {};
}

TEST(SideBySide, TellsSettingsThatDifferAndNoOthers) {
    const Json all = differences(Comparison(1).displays);
    EXPECT_EQ(all["displays"], Json({"one", "_other_"}));
    std::vector<std::string> keys;
    for (const Json& row : all["settings"]) keys.push_back(row["key"]);
    EXPECT_THAT(keys, testing::IsSupersetOf({"name", "array.gap_mm", "diffuser.distance_mm", "diffuser.angle_deg"}));
    EXPECT_THAT(keys, Not(testing::Contains("array.pitch_mm")));
    for (const Json& row : all["settings"])
        if (row["key"] == "diffuser.distance_mm") {
            EXPECT_EQ(row["values"], Json({nullptr, 30.0}));
        }
}

TEST(SideBySide, WeighsDifferencesAgainstErrors) {
    const Json edge = finding(differences(Comparison(0.25).displays), "fov", "Edge <a>");  // more than 0.1 + 0.1 at the first end
    EXPECT_EQ(edge["measured"], Json({{-20., 20.}, {-20.25, 20.25}}));
    EXPECT_EQ(edge["difference"], Json::array({{-0.25, 0.25}}));
    EXPECT_EQ(edge["more_than_errors"], Json::array({true}));
    EXPECT_EQ(finding(differences(Comparison(0.125).displays), "fov", "Edge <a>")["more_than_errors"], Json::array({false}));
    EXPECT_EQ(finding(differences(Comparison(1, false).displays), "fov", "Edge <a>")["more_than_errors"], Json::array({nullptr}));
}

TEST(SideBySide, KeepsWhatCannotBeCompared) {
    const Json all = differences(Comparison(1).displays);
    EXPECT_EQ(finding(all, "fov", "Far")["difference"], Json::array({nullptr}));  // no end to subtract
    EXPECT_EQ(finding(all, "fov", "First's own")["measured"], Json::array({{1.}, nullptr}));
    EXPECT_EQ(finding(all, "fov", "Second's own")["measured"], Json::array({nullptr, {1.}}));
    EXPECT_EQ(finding(all, "dof", "Edge <a>")["measured"][0], Json());
}

TEST(SideBySide, PageShowsBoth) {
    const std::string html = Comparison(0.25).html();
    for (const char* text : {"<h1>one beside _other_</h1>", "<mark>&lt;other&gt;</mark>", "array.gap_mm", "Edge &lt;a&gt;",
                             "−20.25 to 20.25°", "<mark>−0.25, +0.25, more than the errors</mark>", "First's plot", "Second's plot",
                             "href=\"_other_/report.html\"", "lfdsim analyze 'x y'"})
        EXPECT_THAT(html, HasSubstr(text));
    EXPECT_LT(html.find("First's plot"), html.find("Second's plot"));
    EXPECT_THAT(html, Not(HasSubstr("incomplete.")));
    EXPECT_FALSE(
        std::regex_search(html, std::regex("(src|href)=\"(?!data:image/png;base64,|#|one/report.html|_other_/report.html)")));
    EXPECT_THAT(Comparison(1).html("The run was <cut>."), HasSubstr("incomplete.</strong> The run was &lt;cut&gt;."));
}

}  // namespace
}  // namespace lfdsim
