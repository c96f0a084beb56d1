// Files of Zemax's format: what is read from them, and what is refused, at which line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/constants.h"
#include "files/lenses/drawn_lens.h"
#include "published_lenses.h"

namespace lfdsim {
namespace {

using published::tessar;
using testing::HasSubstr;

std::string zmx_refused(const std::string& bytes) {
    try {
        parse_zmx(bytes, "lens.zmx");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

std::string zmx_with(std::string text, const std::string& old, const std::string& replacement) {
    const std::size_t at = text.find(old);
    EXPECT_NE(at, text.npos) << old;
    return text.replace(at, old.size(), replacement);
}

std::string zmx_in_utf16(const std::string& ascii, bool big_endian, bool marked) {
    std::string bytes = !marked ? "" : big_endian ? "\xfe\xff" : "\xff\xfe";
    for (const char c : ascii) bytes += big_endian ? std::string{'\0', c} : std::string{c, '\0'};
    return bytes;
}

TEST(Zmx, ReadsALens) {
    const DrawnLens lens = parse_zmx(tessar, "lens.zmx");
    ASSERT_EQ(lens.surfaces.size(), 10u);
    EXPECT_TRUE(std::isinf(lens.surfaces[0].distance_mm));
    EXPECT_DOUBLE_EQ(lens.surfaces[1].curvature_per_mm, 0.750243 / 25.4);
    EXPECT_DOUBLE_EQ(lens.surfaces[8].distance_mm, 3.4025 * 25.4);
    EXPECT_EQ(lens.surfaces[1].medium.glass, "N-SK15");
    EXPECT_TRUE(lens.surfaces[2].medium.is_air());
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(lens.surfaces[i].is_stop, i == 5);
    EXPECT_EQ(lens.surfaces[3].place, "lens.zmx:19: surface 3");
    EXPECT_EQ(lens.beam.f_number, 4.5);
    EXPECT_DOUBLE_EQ(*lens.beam.field_slope, std::tan(20.5 * degree));
    EXPECT_NEAR(*lens.beam.wavelength_nm, 587.5618, 1e-9);
    EXPECT_THAT(lens.notes, testing::IsEmpty());
}

TEST(Zmx, ReadsEveryEncodingAndLineEnd) {
    const DrawnLens plain = parse_zmx(tessar, "lens.zmx");
    std::string dos;
    for (const char c : tessar) dos += c == '\n' ? std::string("\r\n") : std::string(1, c);
    for (const std::string& bytes :
         {dos, "\xef\xbb\xbf" + dos, zmx_in_utf16(dos, false, true), zmx_in_utf16(dos, true, true), zmx_in_utf16(dos, false, false),
          zmx_in_utf16(dos, true, false), zmx_with(tessar, "MODE SEQ", "NOTE 0 \xd8 30 mm")}) {
        const DrawnLens lens = parse_zmx(bytes, "lens.zmx");
        ASSERT_EQ(lens.surfaces.size(), 10u);
        for (std::size_t i = 0; i < 10; ++i) {
            EXPECT_EQ(lens.surfaces[i].place, plain.surfaces[i].place);
            EXPECT_EQ(lens.surfaces[i].curvature_per_mm, plain.surfaces[i].curvature_per_mm);
            EXPECT_EQ(lens.surfaces[i].medium, plain.surfaces[i].medium);
        }
    }
}

// Of a glass with a name the numbers are fillers, 1.5 and 40. A glass of its own has them, and one that is taken from another
// surface has its name, or else its numbers.
TEST(Zmx, TellsAGlassFromItsFiller) {
    const auto medium = [](const std::string& glass) {
        return parse_zmx(zmx_with(tessar, "GLAS F2 0 0 1.5 4.0E+1", "GLAS " + glass), "x").surfaces[3].medium;
    };
    EXPECT_EQ(medium("F2"), (DrawnMedium{"F2", 1, {}}));
    EXPECT_EQ(medium("F2 0 0 1.62 36.4"), (DrawnMedium{"F2", 1, {}}));
    EXPECT_EQ(medium("F2 2 1 1.5 4.0E+1"), (DrawnMedium{"F2", 1, {}}));
    EXPECT_EQ(medium("F2 1 0 1.62 36.4"), (DrawnMedium{"", 1.62, 36.4}));
    EXPECT_EQ(medium("___BLANK 2 1 1.583 30.3"), (DrawnMedium{"", 1.583, 30.3}));
    EXPECT_EQ(medium("___BLANK 1 0 1,583 30,3"), (DrawnMedium{"", 1.583, 30.3}));  // a decimal comma
    EXPECT_EQ(medium("___BLANK 1 0 1.583 0"), (DrawnMedium{"", 1.583, {}}));
}

TEST(Zmx, ReadsAspheresAndApertures) {
    const std::string asphere = zmx_with(
        tessar, "  TYPE STANDARD\n", "  TYPE EVENASPH\n  PARM 2 1.5E-3\n  PARM 8 -2\n  CONI -0.5\n  DIAM 0.5\n  FLAP 0 0.4 0\n");
    const DrawnSurface s = parse_zmx(asphere, "x").surfaces[1];
    ASSERT_EQ(s.even_asphere.size(), 7u);
    EXPECT_DOUBLE_EQ(s.even_asphere[0], 1.5e-3 / std::pow(25.4, 3));
    EXPECT_DOUBLE_EQ(s.even_asphere[6], -2 / std::pow(25.4, 15));
    EXPECT_EQ(s.conic, -0.5);
    EXPECT_DOUBLE_EQ(*s.semi_aperture_mm, 0.4 * 25.4);
    EXPECT_TRUE(s.is_hole);
}

// A term in r^2 alone, or beside a paraboloid, is a paraboloid; beside any other conic it is none.
TEST(Zmx, FoldsATermInR2WhereItCan) {
    const std::string flat = zmx_with(published::hyperboloid, "  TYPE EVENASPH\n", "  TYPE EVENASPH\n  PARM 1 0.01\n");
    const DrawnSurface s = parse_zmx(flat, "x").surfaces[1];
    EXPECT_DOUBLE_EQ(s.curvature_per_mm, 0.02);
    EXPECT_EQ(s.conic, -1);
    EXPECT_THAT(zmx_refused(zmx_with(tessar, "  TYPE STANDARD\n", "  TYPE EVENASPH\n  PARM 1 0.01\n")),
                HasSubstr("lens.zmx:11: surface 1 has PARM 1 = 0.01, a term in r^2"));
}

// A field point of two angles has the slope of both; of the points in the lines only as many count as FTYP says.
TEST(Zmx, ReadsFieldsOfTwoAnglesThatAreInUse) {
    const auto slope = [](const std::string& lines) {
        return *parse_zmx(zmx_with(tessar, "FTYP 0 0 3 1 0 0 0\nYFLN 0 10 20.5\n", lines), "x").beam.field_slope;
    };
    EXPECT_DOUBLE_EQ(slope("FTYP 0\nXFLN 0 12\nYFLN 0 -9 14\n"), std::hypot(std::tan(12 * degree), std::tan(9 * degree)));
    EXPECT_DOUBLE_EQ(slope("YFLN 0 14 20\nXFLN 5 0 0\nFTYP 0 0 2 1 0 0 0\n"), std::tan(14 * degree));
    EXPECT_EQ(slope("FTYP 0 0 1 3 0 0 0\nYFLN 0 14 0 0\n"), 0);
}

TEST(Zmx, NamesWhatCannotBeImported) {
    const struct {
        std::string old, replacement, message;
    } cases[] = {
        {"  TYPE STANDARD", "  TYPE COORDBRK", "lens.zmx:11: surface 1 is of type COORDBRK, which cannot be imported"},
        {"  TYPE STANDARD", "  TYPE TOROIDAL", "lens.zmx:11: surface 1 is of type TOROIDAL"},
        {"  TYPE STANDARD", "  TYPE DGRATING", "lens.zmx:11: surface 1 is of type DGRATING"},
        {"GLAS F2 0 0", "GLAS MIRROR 0 0", "lens.zmx:22: surface 3: is a mirror"},
        {"GLAS F2 0 0", "GLAS F2 4 0", "lens.zmx:22: surface 3: glass F2 has an offset"},
        {"GLAS F2 0 0", "GLAS ___BLANK 0 0", "lens.zmx:22: surface 3: GLAS names no glass"},
        {"  STOP", "  OBDC 0 1.5", "lens.zmx:27: surface 5: OBDC shifts or tilts it"},
        {"  STOP", "  SCBD 1 0 0 0 0 90", "lens.zmx:27: surface 5: SCBD shifts or tilts it"},
        {"  STOP", "  SQAP 1 2", "lens.zmx:27: surface 5: SQAP is an aperture other than a circle"},
        {"  STOP", "  CLAP 0.1 2 0", "lens.zmx:27: surface 5: CLAP has a central obscuration"},
        {"MODE SEQ", "MODE NSC", "lens.zmx:1: MODE NSC"},
        {"MODE SEQ", "MNUM 3 1", "lens.zmx:1: MNUM 3: has 3 configurations"},
        {"UNIT IN", "UNIT FURLONG", "lens.zmx:2: UNIT FURLONG is unknown"},
        {"CURV -0.478080", "CURV nan", "lens.zmx:20: surface 3: CURV \"nan\" is not a finite number"},
        {"CURV -0.478080", "CURV 1e999", "lens.zmx:20: surface 3: CURV \"1e999\" is not a finite number"},
        {"CURV -0.478080", "CURV", "lens.zmx:20: surface 3: CURV has 0 of its values; the line is cut"},
        {"  CURV -0.478080\n", "", "lens.zmx:19: surface 3 has no CURV"},
        {"  DISZ 0.09\n", "", "lens.zmx:19: surface 3 has no DISZ"},
        {"CURV -0.478080", "CURV -0.478080\n  CURV 0.1", "lens.zmx:21: surface 3: CURV is given twice"},
        {"UNIT IN", "UNIT IN\nUNIT MM", "lens.zmx:3: UNIT is given twice"},
        {"SURF 5", "SURF 6", "lens.zmx:26: SURF 6, where surface 5 should begin"},
        {"SURF 0\n", "", "lens.zmx:8: CURV precedes the first SURF"},
    };
    for (const auto& c : cases) EXPECT_THAT(zmx_refused(zmx_with(tessar, c.old, c.replacement)), HasSubstr(c.message));
    EXPECT_THAT(zmx_refused(""), HasSubstr("no line begins with SURF"));
    EXPECT_THAT(zmx_refused("schema = 1\n"), HasSubstr("no line begins with SURF"));
    EXPECT_THAT(zmx_refused(std::string(1 << 20, '\xff')), HasSubstr("no line begins with SURF"));
}

TEST(Zmx, TellsWhereAFileIsCut) {
    const std::string whole = "VERS 1\n" + tessar;
    const std::size_t surfaces = whole.find("SURF 0"), image = whole.find("SURF 9");
    EXPECT_EQ(zmx_refused(whole), "");
    for (std::size_t end = surfaces + 6; end < image; ++end)
        EXPECT_THAT(zmx_refused(whole.substr(0, end)), testing::AnyOf(HasSubstr("lens.zmx:"), HasSubstr("SURF"))) << end;
    EXPECT_EQ(zmx_refused(whole + "TOL TOFF 0"), "");  // behind the surfaces nothing of the lens can be missing
    EXPECT_THAT(zmx_refused(whole.substr(0, image)), HasSubstr("ends with surface 8, which is not the image"));
    EXPECT_THAT(zmx_refused(whole.substr(0, whole.size() - 1)), HasSubstr("lens.zmx:44: ends in the middle of this line"));
}

TEST(Zmx, RefusesMoreThanAnyoneCanFix) {
    std::string wrong = tessar;
    for (int i = 0; i < 1000; ++i) wrong += "  CURV x\n";
    EXPECT_EQ(std::ranges::count(zmx_refused(wrong), '\n'), 19);
    std::string many;
    for (int i = 0; i < 20000; ++i) many += "SURF " + std::to_string(i) + "\n  CURV 0\n  DISZ 0\n";
    EXPECT_THAT(zmx_refused(many), HasSubstr("has more than 1000 surfaces"));
}

TEST(Zmx, SaysWhatItDidNotRead) {
    const std::string text = zmx_with(
        zmx_with(zmx_with(tessar, "UNIT IN X W X CM MR CPMM\n", "HIDE 0\nWHAT 1\n"), "  STOP\n", "  STOP\n  COAT AR\n  MEMA 1\n"),
        "PWAV 1", "PWAV 1\nNOTE 0 all");
    const DrawnLens lens = parse_zmx(text + "EFLY 1 2 3\n", "x");
    EXPECT_THAT(lens.notes, testing::ElementsAre(HasSubstr("no unit of length"), HasSubstr("coatings of surfaces 5"),
                                                 HasSubstr("were not read: WHAT (line 3)")));
}

}  // namespace
}  // namespace lfdsim
