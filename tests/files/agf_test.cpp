// Glass catalogues in AGF: each formula, each encoding, and every trap that makers' files hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "files/lenses/agf.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;

const std::string bk7 =
    "CC a catalogue\nNM N-BK7 2 517642.251 1.5168 64.17 0 1 -1\nGC step 0.5 available\nED 7.1 8.3 2.51 -0.0009 0\n"
    "CD 1.039612120E+000 6.000698670E-003 2.317923440E-001 2.001791440E-002 1.010469450E+000 1.035606530E+002 0 0 0 0\n"
    "TD 1.86E-006 1.31E-008 -1.37E-011 4.34E-007 6.27E-010 0.17 20\nOD 1.0 2.3 1.0 2.3 2.3 -1\nLD 3.00000000E-001 2.50000000E+000\n"
    "IT 3.0E-001 5.0E-002 2.5E+001\n";

/// The only glass, in a file without doubts.
Glass only(const std::string& text) {
    const GlassCatalogue c = parse_agf(text, "f");
    EXPECT_EQ(c.glasses.size(), 1u);
    EXPECT_TRUE(c.doubts.empty()) << (c.doubts.empty() ? "" : c.doubts[0].problem.what);
    return c.glasses.at(0);
}
std::string fault(const std::string& bytes) {
    try {
        parse_agf(bytes, "f.agf");
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}
std::string doubt(const std::string& text) {
    const GlassCatalogue c = parse_agf(text, "f.agf");
    return c.doubts.size() == 1 ? c.doubts[0].problem.where + ": " + c.doubts[0].problem.what : "not one doubt";
}

std::string utf16(const std::string& ascii, bool big_endian) {
    std::string bytes = big_endian ? "\xfe\xff" : "\xff\xfe";
    for (const char c : ascii) big_endian ? bytes += {'\0', c} : bytes += {c, '\0'};
    return bytes;
}

TEST(Agf, AGlass) {
    const Glass g = only(bk7);
    EXPECT_EQ(g.name, "N-BK7");
    EXPECT_EQ(g.formula, Formula::sellmeier);
    EXPECT_DOUBLE_EQ(g.range_nm[0], 300);
    EXPECT_DOUBLE_EQ(g.range_nm[1], 2500);
    EXPECT_EQ(index_of(g, 550), index_of(shipped_glass("N-BK7")->glass, 550));
}

TEST(Agf, Encodings) {
    const Glass g = only(bk7);
    EXPECT_EQ(only(utf16(bk7, false)), g);
    EXPECT_EQ(only(utf16(bk7, true)), g);
    EXPECT_EQ(only("\xef\xbb\xbf" + bk7), g);
    std::string dos;
    for (const char c : bk7) dos += c == '\n' ? "\r\n" : std::string(1, c);
    EXPECT_EQ(only(dos), g);
    EXPECT_EQ(only("GC M\xfcller\n" + bk7), g);                                              // Latin-1
    EXPECT_EQ(only("NM M\xfc 5 0 1.5 60\nCD 1.5 0 0\nLD 0.4 0.7\n").name, "M\xc3\xbc");      // and in a name
    EXPECT_EQ(only("NM M\xc3\xbc 5 0 1.5 60\nCD 1.5 0 0\nLD 0.4 0.7\n").name, "M\xc3\xbc");  // UTF-8
}

// By hand at half a micrometre, l^2 = 1/4; and how many numbers each formula reads.
TEST(Agf, Formulas) {
    const auto n = [](const char* formula, const char* c) {
        return index_of(only(std::string("NM X ") + formula + " 0 1.0 0.0\nCD " + c + "\nLD 0.3 0.8\n"), 500);
    };
    const double l2 = 0.25, L = 1 / (l2 - 0.028);
    const auto inverse = [&](int k) { return std::pow(4., k); };  // l^-2k
    EXPECT_DOUBLE_EQ(n("1", "2 .1 .01 .001 .0001 .00001"),
                     std::sqrt(2 + 0.025 + .01 * inverse(1) + .001 * inverse(2) + 1e-4 * inverse(3) + 1e-5 * inverse(4)));
    EXPECT_DOUBLE_EQ(n("2.0", "1 .05 .2 .01 .3 -1.75"), std::sqrt(1 + .25 / .2 + .05 / .24 + .075 / 2));
    EXPECT_DOUBLE_EQ(n("3", "1.4 .01 .001 .02 .03 .04"), 1.4 + .01 * L + .001 * L * L + .005 + .03 / 16 + .04 / 64);
    EXPECT_DOUBLE_EQ(n("4", ".2 1 .1 .3 .2"), std::sqrt(1.2 + .25 / .24 + .3 / .21));
    EXPECT_DOUBLE_EQ(n("5", "1.4 .02 .001"), 1.4 + .04 + .001 * std::pow(2, 3.5));
    EXPECT_DOUBLE_EQ(n("6", "1 .05 0 0 0 0 .3 -1.75"), std::sqrt(1 + .25 / .2 + .075 / 2));
    EXPECT_DOUBLE_EQ(n("7", "2 .01 .05 .02"), std::sqrt(2 + .05 - .005));
    EXPECT_DOUBLE_EQ(n("8", "1.5 1 .05 .02"), std::sqrt(1.5 + 1.25 - .005));
    EXPECT_DOUBLE_EQ(n("9", "2 .2 .05 .3 -1.75"), std::sqrt(2 + .05 / .2 + .075 / 2));
    EXPECT_DOUBLE_EQ(n("10", "2 0 0 0 0 0 1e-5 1e-6"), std::sqrt(2 + 1e-5 * inverse(5) + 1e-6 * inverse(6)));
    EXPECT_DOUBLE_EQ(n("11", "1 .05 0 0 0 0 0 0 .3 -1.75"), std::sqrt(1 + .25 / .2 + .075 / 2));
    EXPECT_DOUBLE_EQ(n("12", "2 0 0 0 0 0 .1 .2"), std::sqrt(2 + .1 / 16 + .2 / 64));
    EXPECT_DOUBLE_EQ(n("13", "2 .1 .2 .01 .001 1e-4 1e-5 1e-6 1e-7"),
                     std::sqrt(2 + .025 + .2 / 16 + .01 * inverse(1) + .001 * inverse(2) + 1e-4 * inverse(3) + 1e-5 * inverse(4) +
                               1e-6 * inverse(5) + 1e-7 * inverse(6)));
}

TEST(Agf, DoubtsAreToldAndTheRestIsRead) {
    EXPECT_THAT(doubt("NM A 5 0 1.6 60\nCD 1.5 0 0\nLD .4 .7\n"),
                HasSubstr("f.agf:1: A: n_d is 1.5 by its coefficients, 1.6 by its line NM"));
    EXPECT_EQ(parse_agf("NM A 5 0 1.6 60\nCD 1.5 0 0\nLD .4 .7\n", "f").glasses.size(), 1u);  // doubtful, but there
    EXPECT_EQ(only("NM A 5 0 1.0 0\nCD 1.5 0 0\nLD .4 .7\n").name, "A");                      // n_d = 1: not given
    EXPECT_EQ(only("NM A 5 0\nCD 1.5 0 0\nLD .4 .7\n").name, "A");
    EXPECT_EQ(only("NM IR 5 0 3.0 0\nCD 3.4 0 0\nLD 2 12\n").name, "IR");  // no d line in its range
    EXPECT_THAT(doubt(bk7 + "\n\nNM NEW 2 0 1.5 50\nCD 0 0 0 0 0 0\nLD 0 0\n"),
                HasSubstr("f.agf:12: NEW is left out: it has no line LD"));
    EXPECT_THAT(doubt(bk7 + "NM NEW 1 0 1.5 50\nCD 0 0 0 0 0 0\nLD 0.4 0.7\n"),
                HasSubstr("NEW is left out: its coefficients give no index"));
    EXPECT_THAT(doubt(bk7 + "NM NEW 14 0 1.5 50\nCD 1 0 0 0 0 0\nLD 0.4 0.7\n"), HasSubstr("the format has formulas 1 to 13"));
    EXPECT_THAT(doubt(bk7 + "NM NEW 1 0 1.5 50\n"), HasSubstr("it has no line CD"));
    EXPECT_THAT(doubt(bk7 + "NM NEW 5 0 1.5 50\nCD 1.5 0 0\n"), HasSubstr("it has no line LD"));
}

TEST(Agf, FaultsHaveALine) {
    EXPECT_EQ(fault("NM A 1 0 1.5 60\nCD 1 2 three\n"), "f.agf:2: CD: \"three\" is not a number");
    EXPECT_EQ(fault("NM A 1 0 1.5 60\nCD 1 2 1e999\n"), "f.agf:2: CD: \"1e999\" is not a number");
    EXPECT_EQ(fault("NM A 1 0 1.5 60\nCD 1 nan\n"), "f.agf:2: CD: \"nan\" is not a number");
    EXPECT_EQ(fault("\n\nNM A\n"), "f.agf:3: NM: needs a name and the number of a formula");
    EXPECT_EQ(fault("NM A B\n"), "f.agf:1: NM: \"B\" is not the number of a formula");
    EXPECT_EQ(fault("CD 1 2 3\n" + bk7), "f.agf:1: CD: precedes the first glass, which begins with a line NM");
    EXPECT_EQ(fault("NM " + std::string(65, 'A') + " 1\n"),
              "f.agf:1: NM: \"" + std::string(40, 'A') + "...\" is longer than the 64 bytes allowed");
    EXPECT_EQ(fault(""), "f.agf: has no line NM with a glass, which an AGF catalogue has");
    EXPECT_EQ(fault("schema = 1\n[panel]\n"), "f.agf: has no line NM with a glass, which an AGF catalogue has");
    EXPECT_THAT(fault(std::string("NM A\0B", 6)), HasSubstr("is a binary file"));
    EXPECT_THAT(fault(std::string(largest_agf_bytes + 1, 'x')),
                HasSubstr("has 8388609 bytes, allowed are 8388608; is this a glass catalogue?"));
    std::string many;
    for (std::size_t k = 0; k <= most_glasses; ++k) many += "NM A 5\nCD 1.5 0 0\nLD .4 .7\n";
    EXPECT_THAT(fault(many), HasSubstr("f.agf:30001: NM: is more than the 10000 glasses allowed"));
    std::string wrong;
    for (int k = 0; k < 1000; ++k) wrong += "NM A B\n";
    EXPECT_LT(fault(wrong).size(), 2000u);
}

// Whatever is cut off, the rest is read or refused; nothing is made up.
TEST(Agf, CutFiles) {
    for (const std::string& whole : {bk7, utf16(bk7, false), utf16(bk7, true)})
        for (std::size_t length = 0; length < whole.size(); ++length) {
            try {
                const GlassCatalogue c = parse_agf(std::string_view(whole).substr(0, length), "f");
                EXPECT_LE(c.glasses.size(), 1u);
            } catch (const InputError& error) {
                EXPECT_FALSE(error.problems.empty());
            }
        }
    std::string rubbish;
    for (unsigned k = 0, x = 1; k < 1 << 20; ++k) rubbish += char((x = x * 1664525 + 1013904223) >> 24 | 1);
    EXPECT_NE(fault(rubbish), "");
}

}  // namespace
}  // namespace lfdsim
