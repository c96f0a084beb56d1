// What files state of their colours: sRGB's are taken without a word, others are named.
#include "foreign_png.h"
#include "helpers.h"
#include "image/formats/jpeg_memory.h"

#include <gtest/gtest.h>
#include <zlib.h>
#include <cmath>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

namespace lfdsim {
namespace {

using test::big_endian, test::chunk;

std::string fixed(double number) { return big_endian(std::uint32_t(std::int32_t(std::lround(number * 65536)))); }

using Primaries = std::array<std::array<double, 3>, 3>;  // X, Y, Z relative to D50
constexpr Primaries srgb{{{0.43607, 0.22249, 0.01392}, {0.38515, 0.71687, 0.09708}, {0.14307, 0.06061, 0.71410}}};
constexpr Primaries display_p3{{{0.51512, 0.24120, -0.00105}, {0.29198, 0.69225, 0.04189}, {0.15710, 0.06657, 0.78407}}};

// Tone curves, as ICC profiles hold them.
std::string gamma(double g) { return "curv" + big_endian(0) + big_endian(1) + big_endian(std::uint32_t(std::lround(g * 256)), 2); }
std::string linear() { return "curv" + big_endian(0) + big_endian(0); }
std::string srgb_parameters() {
    return "para" + big_endian(0) + big_endian(3, 2) + big_endian(0, 2) + fixed(2.4) + fixed(1 / 1.055) + fixed(0.055 / 1.055) +
           fixed(1 / 12.92) + fixed(0.04045);
}
std::string srgb_table(int size) {
    std::string text = "curv" + big_endian(0) + big_endian(std::uint32_t(size));
    for (int i = 0; i < size; ++i) {
        const double code = double(i) / (size - 1), light = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
        text += big_endian(std::uint32_t(std::lround(65535 * light)), 2);
    }
    return text;
}

std::string ascii_name(const std::string& name) {  // version 2
    return "desc" + big_endian(0) + big_endian(std::uint32_t(name.size() + 1)) + name + std::string(1, '\0');
}
std::string unicode_name(const std::string& name) {  // version 4
    std::string text = "mluc" + big_endian(0) + big_endian(1) + big_endian(12) + "enUS" +
                       big_endian(std::uint32_t(2 * name.size())) + big_endian(28);
    for (const char c : name) text += std::string(1, '\0') + c;
    return text;
}

std::string profile(const std::string& space, const std::vector<std::pair<std::string, std::string>>& tags) {
    std::string table = big_endian(std::uint32_t(tags.size())), data;
    for (const auto& [name, bytes] : tags) {
        table += name + big_endian(std::uint32_t(132 + 12 * tags.size() + data.size())) + big_endian(std::uint32_t(bytes.size()));
        data += bytes + std::string((4 - bytes.size() % 4) % 4, '\0');
    }
    std::string header(128, '\0');
    header.replace(0, 4, big_endian(std::uint32_t(128 + table.size() + data.size())));
    header.replace(8, 1, "\2");
    header.replace(12, 12, "mntr" + space + "XYZ ");
    header.replace(36, 4, "acsp");
    header.replace(68, 12, fixed(0.9642) + fixed(1) + fixed(0.8249));
    return header + table + data;
}

std::string rgb_profile(const std::string& name, const Primaries& primaries, const std::string& curve) {
    std::vector<std::pair<std::string, std::string>> tags{{"desc", name}, {"rTRC", curve}, {"gTRC", curve}, {"bTRC", curve}};
    for (std::size_t c = 0; c < 3; ++c)
        tags.emplace_back(std::array{"rXYZ", "gXYZ", "bXYZ"}[c],
                          "XYZ " + big_endian(0) + fixed(primaries[c][0]) + fixed(primaries[c][1]) + fixed(primaries[c][2]));
    return profile("RGB ", tags);
}

/// Writes pictures that state their colours.
class Colours : public testing::Test {
  public:
    std::string of_png(const std::vector<std::pair<std::string, std::string>>& chunks, Encoding encoding = Encoding::srgb) {
        test::save_png(folder_ / "a.png", {1, 1, 8, PNG_COLOR_TYPE_RGB, {{10, 20, 30}}});
        std::string bytes = test::load(folder_ / "a.png"), added;
        for (const auto& [name, data] : chunks) added += chunk(name, data);
        test::save(folder_ / "a.png", bytes.insert(33, added));  // after the signature and IHDR
        EXPECT_EQ(read_image(folder_ / "a.png", Encoding::linear).rgb[0], 10 / 255.f);
        return other_colours(folder_ / "a.png", encoding);
    }
    std::string of_png_profile(const std::string& icc) {
        std::string packed(compressBound(icc.size()), '\0');
        uLongf size = packed.size();
        compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(icc.data()), icc.size());
        return of_png({{"iCCP", std::string("profile") + '\0' + '\0' + packed.substr(0, size)}});
    }
    std::string of_jpeg_profile(const std::string& icc) {
        const std::string part = std::string("ICC_PROFILE") + '\0' + '\1' + '\1' + icc;
        std::string bytes = jpeg_bytes(2, 2, std::vector<std::uint8_t>(12, 100), 90);
        test::save(folder_ / "a.jpg", bytes.insert(2, "\xff\xe2" + big_endian(std::uint32_t(part.size() + 2), 2) + part));
        read_image(folder_ / "a.jpg", Encoding::srgb);
        return other_colours(folder_ / "a.jpg", Encoding::srgb);
    }
    std::string of_exr(const Imf::Chromaticities* stated) {
        Imf::Header header(1, 1);
        if (stated) Imf::addChromaticities(header, *stated);
        const float light = 0.5f;
        Imf::FrameBuffer frame;
        for (const char* channel : {"R", "G", "B"}) {
            header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
            frame.insert(channel, Imf::Slice(Imf::FLOAT, const_cast<char*>(reinterpret_cast<const char*>(&light)), 4, 4));
        }
        {
            Imf::OutputFile file((folder_ / "a.exr").c_str(), header);
            file.setFrameBuffer(frame);
            file.writePixels(1);
        }
        return other_colours(folder_ / "a.exr", Encoding::srgb);
    }

  protected:
    const test::TemporaryFolder folder_;
};

void expect_names(const std::string& warning, const std::string& name, const std::string& what) {
    EXPECT_NE(warning.find("states " + name), std::string::npos) << warning;
    EXPECT_NE(warning.find(what), std::string::npos) << warning;
}

TEST_F(Colours, OfProfilesAreComparedWithThoseOfSrgb) {
    for (const auto& of : {&Colours::of_png_profile, &Colours::of_jpeg_profile}) {
        for (const std::string& curve : {srgb_parameters(), srgb_table(1024), srgb_table(1025), gamma(2.2)})
            EXPECT_EQ((this->*of)(rgb_profile(ascii_name("sRGB IEC61966-2.1"), srgb, curve)), "");
        expect_names((this->*of)(rgb_profile(unicode_name("Display P3"), display_p3, srgb_parameters())),
                     "the ICC profile \"Display P3\"", "its primaries are not those of sRGB");
        expect_names((this->*of)(rgb_profile(ascii_name("Linear"), srgb, linear())), "the ICC profile \"Linear\"",
                     "its curve is not that of sRGB");
        expect_names((this->*of)(rgb_profile(ascii_name("old"), display_p3, gamma(1.8))), "the ICC profile \"old\"",
                     "neither its primaries nor its curve");
    }
    EXPECT_EQ(of_jpeg_profile(profile("GRAY", {{"desc", ascii_name("gray")}, {"kTRC", gamma(2.2)}})), "");
    expect_names(of_jpeg_profile(profile("GRAY", {{"desc", ascii_name("gray")}, {"kTRC", gamma(1.5)}})), "the ICC profile \"gray\"",
                 "its curve");
    expect_names(of_jpeg_profile(profile("RGB ", {{"desc", ascii_name("a table\x1b[1m")}, {"A2B0", linear()}})),
                 "the ICC profile \"a table?[1m\"", "neither");
}

// Nothing of a profile is read beyond its end, whatever its sizes and offsets say.
TEST_F(Colours, OfDamagedProfilesAreOthers) {
    const std::string whole = rgb_profile(unicode_name("Display P3"), display_p3, srgb_table(100));
    for (std::size_t size = 1; size < whole.size(); size += 7) EXPECT_NE(of_jpeg_profile(whole.substr(0, size)), "");
    for (std::size_t at = 128; at + 4 <= 360; at += 4)
        for (const char byte : {'\xff', '\0'}) of_jpeg_profile(std::string(whole).replace(at, 4, std::string(4, byte)));
}

TEST_F(Colours, OfPngsChunks) {
    const std::string gamma_of_srgb = big_endian(45455), gamma_1 = big_endian(100000);
    const auto primaries = [](std::array<std::uint32_t, 8> xy) {
        std::string text;
        for (const std::uint32_t value : xy) text += big_endian(value);
        return text;
    };
    const std::string of_srgb = primaries({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000});
    const std::string of_p3 = primaries({31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000});
    EXPECT_EQ(of_png({}), "");
    EXPECT_EQ(of_png({{"sRGB", std::string(1, '\0')}}), "");
    EXPECT_EQ(of_png({{"gAMA", gamma_of_srgb}, {"cHRM", of_srgb}}), "");
    expect_names(of_png({{"gAMA", gamma_1}}), "gAMA 1", "its curve is not that of sRGB");
    EXPECT_EQ(of_png({{"gAMA", gamma_1}}, Encoding::linear), "");
    expect_names(of_png({{"gAMA", gamma_of_srgb}, {"cHRM", of_p3}}), "gAMA 0.45455 and cHRM",
                 "its primaries are not those of sRGB");
    EXPECT_EQ(
        of_png({{"tEXt", std::string("a\0b", 3)}, {"tEXt", std::string("c\0d", 3)}, {"cICP", {1, 13, 0, 1}}, {"gAMA", gamma_1}}),
        "");
    expect_names(of_png({{"cICP", {9, 16, 0, 1}}, {"sRGB", std::string(1, '\0')}}), "cICP 9, 16", "neither");
    expect_names(of_png({{"cICP", {12, 13, 0, 1}}}), "cICP 12, 13", "its primaries");
}

// The program's own files warn only where they are read otherwise than they were written.
TEST_F(Colours, OfOwnFiles) {
    for (const Encoding written : {Encoding::srgb, Encoding::linear}) {
        write_image(folder_ / "own.png", Image(1, 1), {.bits = 8, .encoding = written, .metadata = {}});
        EXPECT_EQ(other_colours(folder_ / "own.png", Encoding::srgb).empty(), written == Encoding::srgb);
        EXPECT_EQ(other_colours(folder_ / "own.png", Encoding::linear), "");
    }
}

TEST_F(Colours, OfChromaticitiesOfExr) {
    const Imf::Chromaticities bt709, aces({0.713f, 0.293f}, {0.165f, 0.830f}, {0.128f, 0.044f}, {0.32168f, 0.33767f});
    EXPECT_EQ(of_exr(nullptr), "");
    EXPECT_EQ(of_exr(&bt709), "");
    expect_names(of_exr(&aces), "chromaticities", "its primaries are not those of sRGB");
}

}  // namespace
}  // namespace lfdsim
