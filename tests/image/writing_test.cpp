// Writing is all or nothing.
#include "helpers.h"

#include <gtest/gtest.h>
#include <png.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <atomic>
#include <csignal>

namespace lfdsim {
namespace {

const char* const formats[] = {"a.png", "a.exr", "a.npy"};

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename().string());
    return names;
}

TEST(Writing, ReplacesAFileAndLeavesNothingElse) {
    const test::TemporaryFolder folder;
    test::save(folder / "a.png", "old");
    const Image image = test::random_image(9, 9);
    write_image(folder / "a.png", image);
    EXPECT_EQ(read_image(folder / "a.png", Encoding::srgb).width, 9);
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"a.png"});
}

/// A full disk must give a std::runtime_error that is no InputError, keep the old file and leave no other.
void expect_old_file_kept(const std::filesystem::path& folder) {
    const Image image = test::random_image(300, 300);  // at least 250 kB in each format: random values do not compress
    for (const char* name : formats) {
        test::save(folder / name, "old");
        try {
            write_image(folder / name, image);
            ADD_FAILURE() << name << " was written";
        } catch (const InputError& error) {
            ADD_FAILURE() << error.what();
        } catch (const std::runtime_error& error) {
            EXPECT_NE(std::string(error.what()).find("cannot be written"), std::string::npos) << error.what();
        }
        EXPECT_EQ(test::load(folder / name), "old");
        EXPECT_EQ(names_in(folder), std::vector<std::string>{name});
        std::filesystem::remove(folder / name);
    }
}

// The limit on a file's size fails writes as a full disk does, and needs no rights.
TEST(Writing, FailedWriteKeepsTheOldFile) {
    const test::TemporaryFolder folder;
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit tight{64 * 1024, before.rlim_max};
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &tight);
    expect_old_file_kept(folder.path());
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
}

TEST(Writing, FullDiskKeepsTheOldFile) {
    const test::TemporaryFolder folder;
    if (mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=64k") != 0) GTEST_SKIP() << "mounting a small disk needs root";
    expect_old_file_kept(folder.path());
    umount(folder.path().c_str());
}

TEST(Writing, RefusedPlacesAndNames) {
    const test::TemporaryFolder folder;
    std::filesystem::create_directory(folder / "folder.png");
    const struct {
        std::filesystem::path path;
        const char* message;
    } cases[] = {{folder / "missing/a.png", "does not exist"},
                 {folder / "folder.png", "is a folder"},
                 {folder / "a.tiff", "unknown image extension \".tiff\"; .png, .exr and .npy can be written"},
                 {folder / "a.jpg", "can be written"},
                 {folder / "noextension", "can be written"},
                 {"", "unknown image extension"}};
    for (const auto& c : cases) {
        for (const auto& action : {std::function<void()>([&] { check_writable(c.path); }),
                                   std::function<void()>([&] { write_image(c.path, test::random_image(2, 2)); })})
            EXPECT_NE(test::input_error(action).find(c.message), std::string::npos) << c.path << ": " << test::input_error(action);
    }
    EXPECT_EQ(names_in(folder.path()), std::vector<std::string>{"folder.png"});
}

TEST(Writing, FolderWithoutPermission) {
    const test::TemporaryFolder folder;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    const uid_t user = geteuid();
    if (user == 0 && seteuid(65534) != 0) GTEST_SKIP() << "cannot become nobody, and root may write anywhere";
    const std::string message = test::input_error([&] { check_writable(folder / "a.png"); });
    const std::string writing = test::input_error([&] { write_image(folder / "a.png", test::random_image(2, 2)); });
    ASSERT_EQ(seteuid(user), 0);
    EXPECT_NE(message.find("cannot be written: Permission denied"), std::string::npos) << message;
    EXPECT_EQ(writing, message);
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
}

TEST(Writing, CheckLeavesNothing) {
    const test::TemporaryFolder folder;
    for (const char* name : {"a.png", "a.EXR", "b.Npy"}) EXPECT_NO_THROW(check_writable(folder / name));
    EXPECT_TRUE(names_in(folder.path()).empty());
    EXPECT_NO_THROW(check_writable("relative.png"));  // in the current folder
}

TEST(Writing, SettingsCanBeReadBack) {
    const test::TemporaryFolder folder;
    const Metadata metadata{{"command", "lfdsim"}, {"display", "caf\xc3\xa9"}, {"empty", ""}};
    for (const char* name : formats)
        write_image(folder / name, test::random_image(3, 3), {.bits = 8, .encoding = Encoding::srgb, .metadata = metadata});
    EXPECT_EQ(read_metadata(folder / "a.png"), metadata);
    EXPECT_EQ(read_metadata(folder / "a.exr"), metadata);
    EXPECT_EQ(read_metadata(folder / "a.npy"), Metadata{});
    for (const char* name : {"a.png", "a.exr"}) {
        test::save(folder / name, "no picture");
        EXPECT_NE(test::input_error([&] { read_metadata(folder / name); }), "") << name;
    }
}

/// Counts what it is told.
struct Counter : Job {
    void stage(std::string_view stage_name, std::int64_t stage_units) override { name = stage_name, units = stage_units, done = 0; }
    void advance(std::int64_t more) override { done += more; }
    std::string name;
    std::int64_t units = 0;
    std::atomic<std::int64_t> done{0};
};

// A picture of 2^24 pixels, which takes a while; its rows are counted. A smaller one is not worth a word.
TEST(Writing, LargePicturesShowProgress) {
    const test::TemporaryFolder folder;
    for (const char* name : formats) {
        Counter writing, reading, small;
        write_image(folder / name, Image(1 << 14, 1 << 10), {}, &writing);
        EXPECT_EQ(writing.name, "writing") << name;
        read_panel_image(folder / name, Encoding::srgb, 1 << 14, 1 << 10, &reading);
        EXPECT_EQ(reading.name, "reading") << name;
        for (const Counter* counter : {&writing, &reading}) {
            EXPECT_EQ(counter->units, 1 << 10) << name << ' ' << counter->name;
            EXPECT_EQ(counter->done, 1 << 10) << name << ' ' << counter->name;
        }
        write_image(folder / name, Image(64, 64), {}, &small);
        EXPECT_EQ(small.name, "") << name;
    }
}

TEST(Writing, RefusesOtherDepths) {
    const test::TemporaryFolder folder;
    EXPECT_THROW(write_image(folder / "a.png", test::random_image(2, 2), {.bits = 12, .encoding = Encoding::srgb, .metadata = {}}),
                 InputError);
}

// What other programs find in our PNG: encoding chunks and texts, plain ASCII as tEXt, the rest as UTF-8 in iTXt.
TEST(Writing, PngCarriesItsSettings) {
    const test::TemporaryFolder folder;
    const Metadata metadata{{"Samples", "100"}, {"Display", "caf\xc3\xa9.toml"}};
    for (const Encoding encoding : {Encoding::srgb, Encoding::linear}) {
        write_image(folder / "a.png", test::random_image(2, 2), {.bits = 8, .encoding = encoding, .metadata = metadata});
        std::FILE* const file = std::fopen((folder / "a.png").c_str(), "rb");
        png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
        png_infop info = png_create_info_struct(png);
        png_init_io(png, file);
        png_read_info(png, info);
        EXPECT_EQ(png_get_valid(png, info, PNG_INFO_sRGB) != 0, encoding == Encoding::srgb);
        double gamma = 0;
        png_get_gAMA(png, info, &gamma);
        EXPECT_NEAR(gamma, encoding == Encoding::srgb ? 0.45455 : 1, 1e-9);
        png_textp texts = nullptr;
        ASSERT_EQ(png_get_text(png, info, &texts, nullptr), 2);
        Metadata found;
        for (int i = 0; i < 2; ++i) found[texts[i].key] = texts[i].text;
        EXPECT_EQ(found, metadata);
        png_destroy_read_struct(&png, &info, nullptr);
        std::fclose(file);
    }
}

}  // namespace
}  // namespace lfdsim
