#include "helpers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <limits>

#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

namespace lfdsim {
namespace {

using Imath::Box2i;
using Imath::V2i;

/// All channels hold 100 * y + x, in the data window's own coordinates.
template <class Value>
void save_exr(const std::filesystem::path& path, const Box2i& display, const Box2i& data, Imf::PixelType type,
              const std::vector<std::string>& channels, Imf::Compression compression = Imf::ZIP_COMPRESSION) {
    Imf::Header header(display, data, 1, Imath::V2f(0, 0), 1, Imf::INCREASING_Y, compression);
    const int columns = data.max.x - data.min.x + 1, rows = data.max.y - data.min.y + 1;
    std::vector<Value> values;
    for (int y = data.min.y; y <= data.max.y; ++y)
        for (int x = data.min.x; x <= data.max.x; ++x) values.push_back(Value(float(100 * y + x)));
    Imf::FrameBuffer frame;
    for (const std::string& name : channels) {
        header.channels().insert(name, Imf::Channel(type));
        frame.insert(name, Imf::Slice::Make(type, values.data(), data.min, columns, rows));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(rows);
}

TEST(Exr, FloatComesBackBitForBitWithItsSettings) {
    const test::TemporaryFolder folder;
    Image image = test::random_image(131, 77);
    image.rgb[7] = 1e30f;
    write_image(folder / "a.exr", image,
                {.bits = 8, .encoding = Encoding::srgb, .metadata = {{"seed", "7"}, {"display", "caf\xc3\xa9"}}});
    EXPECT_EQ(read_image(folder / "a.exr", Encoding::srgb).rgb, image.rgb);
    const Imf::InputFile file((folder / "a.exr").c_str());
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("seed").value(), "7");
    EXPECT_EQ(file.header().typedAttribute<Imf::StringAttribute>("display").value(), "caf\xc3\xa9");
}

std::vector<std::string> channels_of(const std::filesystem::path& path) {
    const Imf::InputFile file(path.c_str());
    std::vector<std::string> names;
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) names.emplace_back(c.name());
    return names;
}

TEST(Exr, LayersComeBackBitForBit) {
    const test::TemporaryFolder folder;
    const Image image = test::random_image(40, 90, 1), error = test::random_image(40, 90, 2), inner = test::random_image(40, 90, 3);
    WriteOptions options;
    options.layers = {{"error", error}, {"error.inner", inner}};
    write_image(folder / "a.exr", image, options);
    EXPECT_THAT(channels_of(folder / "a.exr"), testing::UnorderedElementsAre("R", "G", "B", "error.R", "error.G", "error.B",
                                                                             "error.inner.R", "error.inner.G", "error.inner.B"));
    EXPECT_EQ(read_image(folder / "a.exr", Encoding::srgb).rgb, image.rgb);
    EXPECT_EQ(read_layer(folder / "a.exr", "error")->rgb, error.rgb);
    EXPECT_EQ(read_layer(folder / "a.exr", "error.inner")->rgb, inner.rgb);
    EXPECT_EQ(read_layer(folder / "a.exr", "err"), std::nullopt);
    write_image(folder / "a.png", image);
    EXPECT_EQ(read_layer(folder / "a.png", "error"), std::nullopt);
}

TEST(Exr, RefusesDamagedLayers) {
    const test::TemporaryFolder folder;
    const Box2i box(V2i(0, 0), V2i(3, 3));
    const auto message = [&] { return test::input_error([&] { read_layer(folder / "x.exr", "error"); }); };
    save_exr<float>(folder / "x.exr", box, box, Imf::FLOAT, {"R", "G", "B", "error.R", "error.B"});
    EXPECT_NE(message().find("no channel error.G"), std::string::npos) << message();
    Image error(4, 4);
    error.at(1, 2)[0] = std::numeric_limits<float>::infinity();
    WriteOptions options;
    options.layers = {{"error", error}};
    write_image(folder / "x.exr", Image(4, 4), options);
    EXPECT_NE(message().find("channel R at column 1, row 2"), std::string::npos) << message();
    EXPECT_NO_THROW(read_image(folder / "x.exr", Encoding::srgb));
}

// The file is as small as its one channel, and intact.
TEST(Exr, GreyIsRefusedForItsChannel) {
    const test::TemporaryFolder folder;
    const Box2i box(V2i(0, 0), V2i(191, 107));
    save_exr<float>(folder / "y.exr", box, box, Imf::FLOAT, {"Y"}, Imf::NO_COMPRESSION);
    const std::string message = test::input_error([&] { read_image(folder / "y.exr", Encoding::srgb); });
    EXPECT_NE(message.find("has no channel R; R, G, B are needed"), std::string::npos) << message;
}

TEST(Exr, OtherFormatsRefuseLayers) {
    const test::TemporaryFolder folder;
    WriteOptions options;
    options.layers = {{"error", Image(3, 3)}};
    for (const char* name : {"a.png", "a.npy"}) {
        const std::string message = test::input_error([&] { write_image(folder / name, Image(3, 3), options); });
        EXPECT_NE(message.find("layers need an .exr"), std::string::npos) << message;
        EXPECT_FALSE(std::filesystem::exists(folder / name));
        EXPECT_FALSE(keeps_layers(folder / name));
    }
    EXPECT_TRUE(keeps_layers(folder / "a.EXR"));
    const std::vector<std::vector<ImageLayer>> wrong{
        {{"", Image(3, 3)}}, {{"error", Image(3, 4)}}, {{"error", Image(3, 3)}, {"error", Image(3, 3)}}};
    for (const auto& layers : wrong) {
        options.layers = layers;
        EXPECT_THROW(write_image(folder / "a.exr", Image(3, 3), options), std::invalid_argument);
    }
}

TEST(Exr, ReadsHalfAndIntegers) {
    const test::TemporaryFolder folder;
    const Box2i box(V2i(0, 0), V2i(14, 8));  // values up to 814: exact in a half float
    save_exr<half>(folder / "half.exr", box, box, Imf::HALF, {"R", "G", "B"}, Imf::PIZ_COMPRESSION);
    save_exr<unsigned>(folder / "uint.exr", box, box, Imf::UINT, {"R", "G", "B"});
    for (const char* name : {"half.exr", "uint.exr"}) {
        const Image image = read_image(folder / name, Encoding::srgb);
        ASSERT_EQ(image.width, 15);
        ASSERT_EQ(image.height, 9);
        for (int y = 0; y < 9; ++y)
            for (int x = 0; x < 15; ++x) EXPECT_EQ(image.at(x, y)[1], float(100 * y + x)) << name;
    }
}

// The picture is the display window; data beyond it are cut off, and what they do not reach is black.
TEST(Exr, PutsTheDataWindowIntoTheDisplayWindow) {
    const test::TemporaryFolder folder;
    const Box2i display(V2i(10, 20), V2i(29, 119));
    for (const Box2i& data : {Box2i(V2i(15, 30), V2i(20, 99)), Box2i(V2i(0, 0), V2i(40, 150)), Box2i(V2i(5, 100), V2i(12, 130))}) {
        save_exr<float>(folder / "w.exr", display, data, Imf::FLOAT, {"R", "G", "B"});
        const Image image = read_image(folder / "w.exr", Encoding::srgb);
        ASSERT_EQ(image.width, 20);
        ASSERT_EQ(image.height, 100);
        for (int y = 20; y < 120; ++y)
            for (int x = 10; x < 30; ++x)
                ASSERT_EQ(image.at(x - 10, y - 20)[2], data.intersects(V2i(x, y)) ? float(100 * y + x) : 0) << x << ' ' << y;
    }
}

TEST(Exr, RefusesWrongChannelsAndWindows) {
    const test::TemporaryFolder folder;
    const Box2i box(V2i(0, 0), V2i(3, 3));
    const auto message = [&] { return test::input_error([&] { read_image(folder / "x.exr", Encoding::srgb); }); };
    save_exr<float>(folder / "x.exr", box, box, Imf::FLOAT, {"R", "B"});
    EXPECT_NE(message().find("no channel G"), std::string::npos);
    save_exr<float>(folder / "x.exr", box, box, Imf::FLOAT, {"A", "R", "G", "B"});
    EXPECT_NE(message().find("alpha channel"), std::string::npos);
    save_exr<float>(folder / "x.exr", Box2i(V2i(0, 0), V2i(1 << 20, 1 << 20)), box, Imf::FLOAT, {"R", "G", "B"});
    EXPECT_NE(message().find("display window"), std::string::npos);
}

TEST(Exr, FullAlphaIsNone) {
    const test::TemporaryFolder folder;
    const Box2i box(V2i(0, 0), V2i(3, 3));
    const auto save = [&](float last) {
        std::vector<float> light(16, 0.25f), alpha(16, 1.f);
        alpha[14] = last;
        Imf::Header header(4, 4);
        Imf::FrameBuffer frame;
        for (const char* name : {"R", "G", "B", "A"}) {
            header.channels().insert(name, Imf::Channel(Imf::FLOAT));
            frame.insert(name, Imf::Slice::Make(Imf::FLOAT, (*name == 'A' ? alpha : light).data(), box.min, 4, 4));
        }
        Imf::OutputFile file((folder / "x.exr").c_str(), header);
        file.setFrameBuffer(frame);
        file.writePixels(4);
    };
    save(1);
    EXPECT_EQ(read_image(folder / "x.exr", Encoding::srgb).rgb, std::vector<float>(48, 0.25f));
    save(0.5f);
    EXPECT_NE(test::input_error([&] { read_image(folder / "x.exr", Encoding::srgb); }).find("not full at column 2, row 3"),
              std::string::npos);
}

TEST(Exr, RefusesValuesThatNoPanelEmits) {
    const test::TemporaryFolder folder;
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1.0f}) {
        Image image(5, 4);
        image.at(3, 2)[1] = value;
        for (const char* name : {"x.exr", "x.npy"}) {
            write_image(folder / name, image);
            const std::string message = test::input_error([&] { read_panel_image(folder / name, Encoding::linear, 5, 4); });
            EXPECT_NE(message.find("channel G at column 3, row 2"), std::string::npos) << message;
        }
    }
}

}  // namespace
}  // namespace lfdsim
