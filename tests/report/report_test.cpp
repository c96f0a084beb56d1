// The folder of results and the report of it: what is shown, what is missing, and that nothing of it comes from elsewhere.
#include "report/pages/report.h"
#include "report/pages/report_parts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <regex>
#include <sstream>

#include "../image/helpers.h"
#include "../optics/example.h"
#include "base/constants.h"
#include "report/drawings/side_view.h"
#include "report/folder/run_settings.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;
using testing::Not;

const Json settings{{"lfdsim", "1.2.3"}, {"model", "a<b>.obj"}};

Result result() {
    Result r;
    r.figures = {{"edge_deg", 20.5}};
    r.findings = {
        {"Edge & rim", "deg", {-20.5, 21}, {-20, 20}, "because"}, {"Open", "mm", {3, nan}, {}, ""}, {"Closed", "", {nan}, {1}}};
    r.remarks = {"A remark <with> marks."};
    r.tables = {{"table", {{"x_mm", {0, 1}}, {"y", {2, nan}}}}};
    r.plots = {{"plot", "The plot's title", "x", "y", {{"", {0, 1}, {0, 1}}}}};
    r.maps = {{"map", "The map's title", "x", "y", "v", 0, 1, 0, 1, 2, 1, {0, 1}, 0, 1}};
    r.pictures = {{"picture", "A \"picture\"", Image(1400, 7)}, {"small", "Small", Image(30, 20)}};
    r.animations = {{"turn", "Turning", {Image(8, 6), Image(8, 6)}}};
    return r;
}

Subject subject() {
    Display d = example();
    d.name = "<Display> & co";
    return Subject(d, std::nullopt, {});
}

struct Case {
    test::TemporaryFolder place;
    ResultFolder folder{place.path(), settings};
    Subject shown = subject();
    const Measure &fov = measure_named("fov"), &dof = measure_named("dof");

    std::string report(bool interrupted = false) const {
        return report_html(shown, folder, {"lfdsim analyze 'x y'", "name = \"d\"", {&fov, &dof}, {}, interrupted});
    }
};

int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
    return n;
}

TEST(ReportText, RoundingErrorsAreNoFigures) {
    EXPECT_EQ(digits_of(-1.5e-16), "0");
    EXPECT_EQ(digits_of(0.31416), "0.3142");
    EXPECT_EQ(error_text({7.9e-11, 0}, {-0.07887, 0}), "");  // too small for the digits of its value
    EXPECT_EQ(error_text({0.5, 2}, {-5.2, 1e6}), " ± 0.5");  // that of the other value is
    EXPECT_EQ(error_text({2e-6}, {nullptr}), " ± 2e-06");
    EXPECT_EQ(error_text({1e-16}, {1e-17}), "");
    EXPECT_EQ(error_text(nullptr, {1.}), "");
}

TEST(Report, ShowsWhatTheFolderHolds) {
    const Case c;
    c.folder.write(c.fov, result(), 1.25);
    c.folder.write(c.dof, Result{}, 2);
    const std::string html = c.report();
    for (const char* text :
         {"<h1>&lt;Display&gt; &amp; co</h1>", "lfdsim 1.2.3", "Edge &amp; rim", "<td>−20.5 to 21°</td><td>−20 to 20°</td>",
          "<td>3 to not found mm</td><td>–</td>", "<td>not found</td><td>1</td>", "A remark &lt;with&gt; marks.",
          "The plot's title", "A &quot;picture&quot;", "Turning", "edge_deg", "table.csv", "a&lt;b&gt;.obj", "name = &quot;d&quot;",
          "From the panel to the eye"})
        EXPECT_THAT(html, HasSubstr(text));
    EXPECT_THAT(html, HasSubstr(std::string(c.fov.says)));
    // In short first, and the table once.
    EXPECT_THAT(html, HasSubstr("<a href=\"#fov\">Field of view</a></th><td class=\"remark\">Edge &amp; rim</td><td>−20.5 to "
                                "21°</td><td>−20 to 20°</td></tr>"));
    EXPECT_LT(html.find("id=\"verdict\""), html.find("id=\"summary\""));
    EXPECT_EQ(count(html, "<td>−20.5 to 21°</td>"), 2);  // and in the table of all
    EXPECT_THAT(html, HasSubstr("Source: "));
    EXPECT_THAT(html, Not(HasSubstr("incomplete.")));
    EXPECT_EQ(count(html, "<svg xmlns"), 2 + 2);  // views from the side; plot, map
    EXPECT_EQ(count(html, "<img "), 3 + 2);
    EXPECT_EQ(html, c.report());
}

// The first screen has the verdict, the headline figures and pictures; all else is folded, but not on paper.
TEST(Report, FoldsAllButTheFirstScreen) {
    const Case c;
    c.folder.write(c.fov, result(), 1);
    c.folder.write(c.dof, Result{}, 2);
    const std::string html = c.report(), folded = "<div class=\"folded\">";
    const std::size_t main = html.find("<main>"), first = html.find(folded);
    for (const char* early : {"id=\"verdict\"", "<td>−20.5 to 21°</td>", "<img "})
        EXPECT_LT(html.find(early, main), first) << early;
    EXPECT_EQ(count(html, folded), 5);  // all figures, the display, two measures, settings
    EXPECT_EQ(count(html, "<details class=\"fold\">"), 5);
    for (const char* late : {"The plot's title", "A remark", "<pre>", "<svg xmlns"})
        EXPECT_GT(html.find(late, main), first) << late;
    const std::size_t print = html.find("@media print");
    EXPECT_THAT(html.substr(print, html.find("</style>") - print), HasSubstr(".fold + .folded { display: block !important; }"));
}

TEST(Report, NeedsNoOtherFile) {
    const Case c;
    c.folder.write(c.fov, result(), 1);
    std::string html = c.report();
    const std::string name_of_format = "http://www.w3.org/2000/svg";
    for (std::size_t at = html.find(name_of_format); at != html.npos; at = html.find(name_of_format))
        html.erase(at, name_of_format.size());
    EXPECT_THAT(html, Not(HasSubstr("://")));
    EXPECT_THAT(html, Not(HasSubstr("<script")));
    EXPECT_THAT(html, Not(HasSubstr("<link")));
    EXPECT_FALSE(std::regex_search(html, std::regex("(src|href)=\"(?!data:image/png;base64,|#)")));
}

TEST(Report, ReducesWidePictures) {
    const Case c;
    c.folder.write(c.fov, result(), 1);
    std::vector<int> widths;
    const std::string html = c.report();
    // Of a PNG in base64, bytes 18 and 19 hold the width as far as it matters.
    const std::regex image("<img [^>]*base64,([^\"]{40})");
    for (std::sregex_iterator it(html.begin(), html.end(), image), end; it != end; ++it) {
        const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/",
                          code = (*it)[1].str().substr(24, 4);
        std::uint32_t three = 0;  // bytes 18 .. 20
        for (const char digit : code) three = three << 6 | std::uint32_t(digits.find(digit));
        widths.push_back(int(three >> 8));
    }
    EXPECT_THAT(widths, testing::ElementsAre(240, 30, 1000, 30, 8));
}

TEST(Report, SaysWhatIsMissing) {
    const Case c;
    c.folder.write(c.fov, result(), 1);
    EXPECT_TRUE(has_results(c.folder));
    const std::string html = c.report(true);
    EXPECT_THAT(html, HasSubstr("This report is incomplete."));
    EXPECT_THAT(html, HasSubstr("The run was interrupted. Missing: Depth of field (dof)."));
    EXPECT_LT(html.find("This report is incomplete."), html.find("<main>"));
    const std::string failed = report_html(c.shown, c.folder, {"", "", {&c.fov, &c.dof}, {{&c.dof, "a < b"}}});
    EXPECT_THAT(failed, HasSubstr("This report is incomplete."));
    EXPECT_THAT(failed, HasSubstr("Depth of field (dof) could not be measured: a &lt; b"));
    EXPECT_THAT(failed, Not(HasSubstr("Missing:")));
}

TEST(Report, NamesAPictureThatCannotBeShown) {
    const Case c;
    c.folder.write(c.fov, result(), 1);
    test::save(c.place / "picture.png", "no picture");
    test::save(c.place / "plot.svg", "<html>");
    const std::string html = c.report();
    EXPECT_THAT(html, HasSubstr("picture.png cannot be shown"));
    EXPECT_THAT(html, HasSubstr("plot.svg cannot be shown"));
}

TEST(Folder, KnowsWhatIsFinishedWithTheSameSettings) {
    const Case c;
    EXPECT_FALSE(has_results(c.folder));
    const Json written = c.folder.write(c.fov, result(), 1);
    EXPECT_TRUE(c.folder.has(c.fov));
    EXPECT_FALSE(c.folder.has(c.dof));
    EXPECT_EQ(c.folder.read(c.fov).at("edge_deg"), 20.5);
    for (const char* list : {"plots", "maps", "animations"}) EXPECT_EQ(written.at("report").at(list).size(), 1u) << list;
    EXPECT_FALSE(ResultFolder(c.place.path(), {{"lfdsim", "1.2.4"}}).has(c.fov));
    EXPECT_EQ(test::load(c.place / "table.csv"), "x_mm,y\n0,2\n1,\n");
    std::filesystem::remove(c.place / "map.svg");
    EXPECT_FALSE(c.folder.has(c.fov));
}

// Run settings tell when a model was changed as a date, not in ticks of a file system's clock.
TEST(Folder, TellsWhenAModelWasChanged) {
    const std::string file = ::testing::TempDir() + "changed.obj";
    std::ofstream(file) << "v 0 0 0\n";
    const auto now = std::time(nullptr);
    const Json told = stamp(file);
    EXPECT_EQ(told.at("bytes"), 8);
    std::tm date = {};
    std::istringstream(told.at("changed").get<std::string>()) >> std::get_time(&date, "%Y-%m-%dT%H:%M:%S");
    EXPECT_NEAR(double(timegm(&date)), double(now), 100) << told;
}

TEST(Folder, TrustsNoFileThatLiesElsewhere) {
    const Case c;
    c.folder.write(c.fov, result(), 1);
    std::string text = test::load(c.place / "fov.json");
    test::save(c.place / "fov.json", std::regex_replace(text, std::regex("table.csv"), "../table.csv"));
    test::save(c.place.path().parent_path() / "table.csv", "");
    EXPECT_FALSE(c.folder.has(c.fov));
    std::filesystem::remove(c.place.path().parent_path() / "table.csv");
    test::save(c.place / "fov.json", text.substr(0, text.size() / 2));
    EXPECT_FALSE(c.folder.has(c.fov));
}

TEST(Folder, BoundsAnimations) {
    const Case c;
    Result r;
    r.animations = {{"long", "", std::vector<Image>(10, Image(1000, 900))}};
    c.folder.write(c.fov, r, 1);
    const Image first = read_image(c.place / "long.png", Encoding::srgb);
    EXPECT_LE(10. * first.width * first.height, 8e6);
    EXPECT_GT(10. * first.width * first.height, 7.5e6);
}

/// All kinds of displays can be drawn; no number in the drawing is none.
TEST(SideView, DrawsAnyDisplay) {
    const auto with = [](auto change) {
        Display d = example();
        change(d);
        return d;
    };
    const Display displays[] = {
        example(),
        with([](Display& d) {
            d.diffuser = Diffuser{30, {4, 3}};
        }),
        with([](Display& d) {
            d.lens = {IdealLens{2, 6}, {}};
        }),
        with([](Display& d) {
            d.lens = {IdealLens{2, 7}, {}};
        }),
        with([](Display& d) { d.array.gap_mm = 4; }),  // virtual
        with([](Display& d) {
            d.diffuser = Diffuser{30, {179, 179}};
        }),
        with([](Display& d) { d.array.surround = Surround::plate; }),
        with([](Display& d) {
            d.array.surround = Surround::clear, d.array.aperture = Aperture::cell,
            d.lens.as<PlanoConvex>().aperture_radius_mm.reset();
        }),
        with([](Display& d) { d.lens.as<PlanoConvex>().facing = Facing::panel, d.lens.stop_radius_mm = 0.5; }),
        with([](Display& d) {
            d.array.rotation_deg = 30, d.array.offset_mm = {3, -2}, d.array.count = {1, 1};
        }),
        with([](Display& d) {
            d.camera.position_mm = {0, 50, 1e6};
        }),
    };
    for (const Display& d : displays) {
        ASSERT_TRUE(validate(d).empty()) << validate(d)[0].where << validate(d)[0].what;
        const Subject s(d, std::nullopt, {});
        for (const std::string& svg : {side_view_svg(s), lens_view_svg(s)}) {
            EXPECT_THAT(svg, Not(HasSubstr("nan")));
            EXPECT_THAT(svg, Not(HasSubstr("inf ")));
            EXPECT_GT(count(svg, "stroke=\"#d55e00\""), 2);
            EXPECT_GT(count(svg, "stroke=\"#1f7fc0\""), 2);
        }
    }
}

}  // namespace
}  // namespace lfdsim
