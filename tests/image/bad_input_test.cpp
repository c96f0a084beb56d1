// Hostile and mistaken files: each must end in an InputError that names the file and says what is wrong.
#include "foreign_png.h"
#include "helpers.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

namespace lfdsim {
namespace {

using test::big_endian, test::chunk;

/// A sound 8-bit RGB header, then an empty IDAT.
std::string png_claiming(std::uint32_t width, std::uint32_t height) {
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\x02\0\0\0", 5)) +
           chunk("IDAT", "");
}

std::string npy_claiming(const std::string& shape) {
    const std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': " + shape + ", }\n";
    return std::string("\x93NUMPY\x01\0", 8) + char(header.size()) + '\0' + header;
}

struct BadFile {
    std::string name, bytes, message;
};

std::vector<BadFile> bad_files() {
    const test::TemporaryFolder folder;
    const Image image = test::random_image(40, 90);
    for (const char* name : {"a.png", "a.exr", "a.npy"}) write_image(folder / name, image);
    const std::string png = test::load(folder / "a.png"), exr = test::load(folder / "a.exr"), npy = test::load(folder / "a.npy");
    const std::string text = "this is a text, and no picture at all\n";
    std::string flipped = png;
    flipped[png.size() / 2] = char(~flipped[png.size() / 2]);
    return {
        {"empty.png", "", "is empty"},
        {"empty.exr", "", "is empty"},
        {"text.png", text, "is not a PNG file"},
        {"text.exr", text, "not an EXR file"},
        {"text.npy", text, "is not an NPY file"},
        {"text.jpg", text, "not a JPEG file"},
        {"exr.png", exr, "is not a PNG file"},
        {"short.png", png.substr(0, 4), "is not a PNG file"},
        {"header.png", png.substr(0, 20), "is damaged"},
        {"half.png", png.substr(0, png.size() / 2), "it ends too early"},
        {"no-end.png", png.substr(0, png.size() - 12), "it ends too early"},
        {"flipped.png", flipped, "is damaged"},
        {"half.exr", exr.substr(0, exr.size() / 2), "is damaged"},
        {"claims.exr",
         std::string("v/1\x01\x02\0\0\0x\0string\0\xf0\xff\xff\x7f"
                     "abc",
                     25),
         "claims 2147483632 bytes"},
        // OpenEXR reads 16 bytes of the box, and then of a text the length that stands behind them.
        {"box.exr",
         std::string("v/1\x01\x02\0\0\0b\0box2i\0\x1d\0\0\0"
                     "................x\0string\0\xf0\xff\xff\x7f",
                     49) +
             '\0',
         "is no box2i of 29 bytes"},
        {"texts.exr", std::string("v/1\x01\x02\0\0\0s\0stringvector\0\x05\0\0\0\xff\0\0\0a\0", 33),
         "is no stringvector of 5 bytes"},
        {"blanks.npy", std::string("\x93NUMPY\x01\0\xa0\x0f", 10) + "{'descr':" + std::string(3991, ' '), "its header is too long"},
        {"half.npy", npy.substr(0, npy.size() / 2), "more than its"},
        {"short.npy", npy.substr(0, npy.size() - 1), "it must be"},
        {"long.npy", npy + "x", "it must be"},
        {"claim.png", png_claiming(100000, 20000), "more than its"},
        {"huge.png", png_claiming(0x7fffffff, 0x7fffffff), "is too large"},
        {"chunk.png", png_claiming(4, 3).substr(0, 33) + "\x40" + std::string(3, '\0') + "tEXtkey",
         "\"tEXt\" claims 1073741824 bytes"},
        {"zero.png", png_claiming(0, 5), "is damaged"},
        {"huge.npy", npy_claiming("(999999999, 999999999, 3)"), "is too large"},
        {"claim.npy", npy_claiming("(1000, 1000, 3)"), "more than its"},
        {"overflow.npy", npy_claiming("(99999999999999999999, 1, 3)"), "must hold"},
        {"picture.bmp", "BM", "unknown image extension \".bmp\""},
        {"picture", "x", "unknown image extension"}};
}

TEST(BadInput, EachFileHasItsMessage) {
    const test::TemporaryFolder folder;
    for (const BadFile& file : bad_files()) {
        test::save(folder / file.name, file.bytes);
        const std::string message = test::input_error([&] { read_image(folder / file.name, Encoding::srgb); });
        EXPECT_NE(message.find(file.message), std::string::npos) << file.name << ": got \"" << message << '"';
        EXPECT_NE(message.find(file.name), std::string::npos) << message;
    }
}

TEST(BadInput, OnlyRegularFilesAreRead) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "folder.png");
    ASSERT_EQ(mkfifo((folder / "pipe.png").c_str(), 0600), 0);
    std::filesystem::create_symlink("/dev/zero", folder / "device.png");
    const auto message = [&](const char* name) { return test::input_error([&] { read_image(folder / name, Encoding::srgb); }); };
    EXPECT_NE(message("folder.png").find("is a folder"), std::string::npos);
    EXPECT_NE(message("pipe.png").find("is not a regular file"), std::string::npos);
    EXPECT_NE(message("device.png").find("is not a regular file"), std::string::npos);
    EXPECT_NE(message("missing.png").find("No such file"), std::string::npos);
}

TEST(BadInput, PanelImageOfAnotherSizeSaysBoth) {
    const test::TemporaryFolder folder;
    write_image(folder / "a.png", test::random_image(8, 6));
    const std::string message = test::input_error([&] { read_panel_image(folder / "a.png", Encoding::srgb, 3840, 2160); });
    EXPECT_NE(message.find("is 8 x 6 pixels, the panel has 3840 x 2160"), std::string::npos) << message;
}

// A fixed number of random changes to sound files: a picture or an InputError, nothing else, and quickly.
TEST(BadInput, RandomDamageNeverEndsBadly) {
    const test::TemporaryFolder folder;
    std::mt19937 engine(20190919);
    const Image image = test::random_image(20, 20);
    for (const char* name : {"a.png", "a.exr", "a.npy"}) {
        write_image(folder / name, image);
        const std::string sound = test::load(folder / name);
        for (int run = 0; run < 300; ++run) {
            std::string bytes = sound;
            const std::size_t reach = run % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 400);  // headers more often
            for (unsigned i = 0, changes = 1 + engine() % 4; i < changes; ++i) bytes[engine() % reach] = char(engine());
            test::save(folder / name, bytes);
            try {
                read_image(folder / name, Encoding::srgb);
            } catch (const InputError&) {
            } catch (const std::exception& error) {
                FAIL() << name << ", run " << run << ": " << error.what();
            }
        }
    }
}

}  // namespace
}  // namespace lfdsim
