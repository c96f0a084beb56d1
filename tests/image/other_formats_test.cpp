// EXR, NPY and JPEG.
#include "helpers.h"
#include "image/compare/above_white.h"
#include "image/formats/encoding.h"
#include "image/formats/jpeg_memory.h"
#include "image/formats/upright.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include <jpeglib.h>

namespace lfdsim {
namespace {

TEST(Npy, FloatComesBackBitForBit) {
    const test::TemporaryFolder folder;
    Image image = test::random_image(31, 17);
    image.rgb[5] = -3e30f;  // a difference or a camera's raw picture may be negative: only panels cannot
    write_image(folder / "a.npy", image);
    EXPECT_EQ(read_image(folder / "a.npy", Encoding::srgb).rgb, image.rgb);
    EXPECT_EQ(std::filesystem::file_size(folder / "a.npy"), 128u + 31 * 17 * 12);
}

/// Four bytes of a number, the least significant first, or last.
std::string bytes_of(float value, bool little) {
    std::string bytes(reinterpret_cast<const char*>(&value), 4);
    if (!little) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

// Rows from below, in either order of bytes, grey or in colour.
TEST(Pfm, RowsBeginAtTheBottom) {
    const test::TemporaryFolder folder;
    for (const bool little : {true, false}) {
        std::string grey = std::string("Pf\n2 3\n") + (little ? "-1.0\n" : "1.0\n"),
                    colour = std::string("PF 1 2 ") + (little ? "-1 " : "1 ");
        for (int i = 0; i < 6; ++i) grey += bytes_of(float(i) - 2.5f, little), colour += bytes_of(float(i), little);
        test::save(folder / "g.pfm", grey);
        test::save(folder / "c.pfm", colour);
        const Image a = read_image(folder / "g.pfm", Encoding::srgb), b = read_image(folder / "c.pfm", Encoding::srgb);
        ASSERT_EQ(a.width, 2);
        ASSERT_EQ(a.height, 3);
        EXPECT_EQ(a.at(0, 2)[0], -2.5f);
        EXPECT_EQ(a.at(1, 2)[2], -1.5f);
        EXPECT_EQ(a.at(1, 0)[1], 2.5f);
        EXPECT_EQ(b.rgb, (std::vector<float>{3, 4, 5, 0, 1, 2}));
    }
}

TEST(Pfm, RefusesWhatIsDamaged) {
    const test::TemporaryFolder folder;
    const std::string data = bytes_of(1, true);
    for (const std::string& text :
         {std::string("P6\n1 1\n-1\n") + data, std::string("Pf\n1 1\n-1\n"), "Pf\n1 1\n-1\n" + data + "x", "Pf\n1 2\n-1\n" + data,
          "Pf\n0 1\n-1\n" + data, "Pf\n-1 1\n-1\n" + data, "Pf\n99999999999999999999 1\n-1\n" + data, "Pf\n1 1\n0\n" + data,
          "Pf\n1 1\nnan\n" + data, std::string("Pf"), "Pf\n1 1\n-1\n" + bytes_of(std::numeric_limits<float>::infinity(), true)}) {
        test::save(folder / "bad.pfm", text);
        EXPECT_THROW(read_image(folder / "bad.pfm", Encoding::srgb), InputError) << text;
    }
}

/// An NPY file as numpy.save writes it.
std::string npy(const std::string& header, const std::string& data) {
    std::string text = "\x93NUMPY\x01";
    text += '\0';
    text += char(header.size() & 255);
    text += char(header.size() >> 8);
    return text + header + data;
}

TEST(Npy, ReadsDouble) {
    const test::TemporaryFolder folder;
    const double pixel[3] = {0.1, 0.2, 1e10};
    test::save(folder / "d.npy", npy("{'descr': '<f8', 'fortran_order': False, 'shape': (1, 1, 3), }\n",
                                     std::string(reinterpret_cast<const char*>(pixel), sizeof pixel)));
    EXPECT_EQ(read_image(folder / "d.npy", Encoding::srgb).rgb, (std::vector<float>{0.1f, 0.2f, 1e10f}));
}

// As arrays of these types are in Python: codes, of 8 or 16 bits.
TEST(Npy, WholeNumbersAreCodes) {
    const test::TemporaryFolder folder;
    const std::uint8_t bytes[3] = {0, 128, 255};
    const std::uint16_t shorts[3] = {0, 32768, 65535};
    const std::string shape = " 'fortran_order': False, 'shape': (1, 1, 3), }\n";
    test::save(folder / "b.npy", npy("{'descr': '|u1'," + shape, std::string(reinterpret_cast<const char*>(bytes), sizeof bytes)));
    test::save(folder / "s.npy",
               npy("{'descr': '<u2'," + shape, std::string(reinterpret_cast<const char*>(shorts), sizeof shorts)));
    for (const Encoding encoding : {Encoding::srgb, Encoding::linear}) {
        const std::vector<float>&of_bytes = decode_table(encoding, 8), &of_shorts = decode_table(encoding, 16);
        EXPECT_EQ(read_image(folder / "b.npy", encoding).rgb, (std::vector<float>{0, of_bytes[128], 1}));
        EXPECT_EQ(read_image(folder / "s.npy", encoding).rgb, (std::vector<float>{0, of_shorts[32768], 1}));
    }
    EXPECT_TRUE(holds_codes(folder / "b.npy"));
    write_image(folder / "f.npy", Image(1, 1));
    EXPECT_FALSE(holds_codes(folder / "f.npy"));
}

TEST(CutOff, IsSaidFromAThousandthOfTheLightOn) {
    Image image(100, 20), white(100, 20);
    image.rgb[3] = 1.004f;  // within half a code of white
    image.rgb[7] = 2.5f;
    std::fill(white.rgb.begin(), white.rgb.end(), 1.f);
    CutOff cut, more;
    cut.add(image);
    EXPECT_EQ(cut.cut, 1);
    EXPECT_EQ(cut.text(),
              "0.05 % of the pixels are brighter than white, the brightest 2.5 times, and are cut off to white: 43 % of the light "
              "is lost");
    more.add(white);
    more += cut;
    EXPECT_EQ(more.pixels_share(), 1. / 4000);
    EXPECT_NEAR(more.light_share(), 1.504 / 6003.504, 1e-9);
    EXPECT_EQ(more.text(), "");
    EXPECT_EQ(CutOff().text(), "");
}

// Light above white on a panel is doubted, and codes anywhere; a display's picture may be some times as bright as its mean white.
TEST(AboveWhite, DoubtsCodesAndPanelsThatShineTooBright) {
    const auto doubt = [](std::vector<float> light, LightOf of) {
        return above_white(light.data(), std::int64_t(light.size() / 3), 3, of);
    };
    for (const LightOf of : {LightOf::panel, LightOf::picture}) {
        EXPECT_EQ(doubt({0, 0.5f, 1}, of), "");
        EXPECT_NE(doubt({0, 128, 64}, of).find("up to 128"), std::string::npos);
        EXPECT_NE(doubt({0, 128, 64}, of).find("uint8"), std::string::npos);
        EXPECT_NE(doubt({0, 40000, 64}, of).find("uint16"), std::string::npos);
        EXPECT_NE(doubt({0, 17.3f, 64.1f}, of).find("codes"), std::string::npos);
    }
    EXPECT_NE(doubt({0, 2.5f, 1}, LightOf::panel).find("2.5 times as bright"), std::string::npos);
    EXPECT_EQ(doubt({0, 2.5f, 1}, LightOf::picture), "");
}

TEST(Npy, RefusesOtherArrays) {
    const test::TemporaryFolder folder;
    const std::string zeros(12, '\0');
    for (const char* header : {"{'descr': '>f4', 'fortran_order': False, 'shape': (1, 1, 3), }",
                               "{'descr': '<f4', 'fortran_order': True, 'shape': (1, 1, 3), }",
                               "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 3), }",
                               "{'descr': '<f4', 'fortran_order': False, 'shape': (1, 1, 4), }",
                               "{'descr': '|O', 'fortran_order': False, 'shape': (1, 1, 3), }"}) {
        test::save(folder / "x.npy", npy(header, zeros));
        const std::string message = test::input_error([&] { read_image(folder / "x.npy", Encoding::srgb); });
        EXPECT_NE(message.find("shape (rows, columns, 3)"), std::string::npos) << header << message;
    }
}

/// From `codes`, or where there are none of one colour.
void save_jpeg(const std::filesystem::path& path, int width, int height, int components, int progressive,
               std::vector<JSAMPLE> codes = {}, int quality = 100) {
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr error{};
    jpeg.err = jpeg_std_error(&error);
    jpeg_create_compress(&jpeg);
    jpeg_stdio_dest(&jpeg, file);
    jpeg.image_width = JDIMENSION(width);
    jpeg.image_height = JDIMENSION(height);
    jpeg.input_components = components;
    jpeg.in_color_space = components == 1 ? JCS_GRAYSCALE : components == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    if (progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (int i = int(codes.size()); i < width * height * components; ++i) codes.push_back(i % components == 0 ? 200 : 60);
    for (int y = 0; y < height; ++y) {
        JSAMPROW row = codes.data() + y * width * components;
        jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::fclose(file);
}

// A constant colour survives the cosine transform; what is left is rounding, below two codes at quality 100.
TEST(Jpeg, ReadsGrayAndColour) {
    const test::TemporaryFolder folder;
    for (const int progressive : {0, 1})
        for (const int components : {1, 3}) {
            save_jpeg(folder / "a.JPG", 21, 19, components, progressive);
            const Image image = read_image(folder / "a.JPG", Encoding::linear);
            ASSERT_EQ(image.width, 21);
            ASSERT_EQ(image.height, 19);
            for (std::size_t i = 0; i < image.rgb.size(); ++i)
                EXPECT_NEAR(image.rgb[i] * 255, components == 1 || i % 3 == 0 ? 200 : 60, 2.1);
        }
}

// Strips compressed apart hold the same pixels as a picture compressed as a whole.
TEST(Jpeg, WrittenInStripsIsTheSamePicture) {
    const test::TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair(1, 1), std::pair(37, 128), std::pair(50, 129), std::pair(19, 1400)}) {
        const std::vector<std::uint8_t> codes = encode8(test::random_image(width, height), Encoding::srgb);
        save_jpeg(folder / "whole.jpg", width, height, 3, 0, codes, 80);
        test::save(folder / "strips.jpg", jpeg_bytes(width, height, codes, 80));
        EXPECT_EQ(read_image(folder / "strips.jpg", Encoding::linear).rgb, read_image(folder / "whole.jpg", Encoding::linear).rgb)
            << width << " x " << height;
    }
}

TEST(Jpeg, RefusesFourColours) {
    const test::TemporaryFolder folder;
    save_jpeg(folder / "cmyk.jpg", 16, 16, 4, 0);
    EXPECT_NE(test::input_error([&] { read_image(folder / "cmyk.jpg", Encoding::srgb); }).find("4 colour components"),
              std::string::npos);
}

// libjpeg only warns of lost data and fills with gray; a panel image with gray in place of data is wrong.
TEST(Jpeg, RefusesATruncatedFile) {
    const test::TemporaryFolder folder;
    save_jpeg(folder / "a.jpg", 300, 300, 3, 0);
    const std::string whole = test::load(folder / "a.jpg");
    test::save(folder / "half.jpg", whole.substr(0, whole.size() / 2));
    EXPECT_NE(test::input_error([&] { read_image(folder / "half.jpg", Encoding::srgb); }).find("is damaged"), std::string::npos);
}

// A file with this APP1 marker says so.
int orientation_of(const test::TemporaryFolder& folder, const std::string& marker) {
    save_jpeg(folder / "a.jpg", 16, 16, 3, 0);
    const std::size_t length = marker.size() + 2;
    const std::string head{char(0xff), char(0xe1), char(length >> 8), char(length & 0xff)};
    const std::string whole = test::load(folder / "a.jpg");
    test::save(folder / "a.jpg", whole.substr(0, 2) + head + marker + whole.substr(2));
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen((folder / "a.jpg").c_str(), "rb"), std::fclose);
    return read_orientation(file.get());
}

TEST(Jpeg, TellsHowTheCameraWasHeld) {
    using namespace std::string_literals;
    const test::TemporaryFolder folder;
    const std::string before = "\x0e\x01\x02\0\x01\0\0\0\0\0\0\0"s;  // another tag
    const std::string little = "Exif\0\0II*\0\x08\0\0\0\x02\0"s + before + "\x12\x01\x03\0\x01\0\0\0\x08\0\0\0\0\0\0\0"s;
    const std::string big = "Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"s;
    EXPECT_EQ(orientation_of(folder, little), 8);
    EXPECT_EQ(orientation_of(folder, big), 6);
    EXPECT_EQ(orientation_of(folder, "http://ns.adobe.com/xap/1.0/"), 1);
    for (std::size_t length = 0; length < big.size() - 6; ++length)  // cut off before the number
        EXPECT_EQ(orientation_of(folder, big.substr(0, length)), 1) << length;
    std::string far = big, many = little, odd = big;
    far[10] = '\x7f';   // the directory lies beyond the marker
    many[14] = '\xff';  // it has more entries than there is room for, and
    many[28] = 0;       // none of them is the one
    odd[25] = 9;        // no such orientation
    for (const std::string& marker : {far, many, odd}) EXPECT_EQ(orientation_of(folder, marker), 1);
}

}  // namespace
}  // namespace lfdsim
