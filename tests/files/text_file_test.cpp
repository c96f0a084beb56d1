// Files that are no descriptions, and texts that a parser should not see.
#include "files/description/text_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "files/description/display_file.h"

namespace lfdsim {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

std::string fault_of(const std::function<void()>& action) {
    try {
        action();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}
std::string fault_of_text(const std::string& text) {
    return fault_of([&] { parse_display(text, "x.toml"); });
}

class TextFile : public testing::Test {
  protected:
    void SetUp() override {
        std::string name = (fs::temp_directory_path() / "lfdsim-XXXXXX").string();
        folder = mkdtemp(name.data());
    }
    void TearDown() override { fs::remove_all(folder); }
    std::string fault_of_file(const std::string& bytes) {
        std::ofstream(folder / "d.toml", std::ios::binary) << bytes;
        return fault_of([&] { read_display(folder / "d.toml"); });
    }
    fs::path folder;
};

TEST_F(TextFile, NoFileAtAll) {
    EXPECT_THAT(fault_of([&] { read_display(folder / "none.toml"); }), HasSubstr("none.toml: there is no such file"));
    EXPECT_THAT(fault_of([&] { read_display(folder); }), HasSubstr(folder.string() + ": is a folder"));
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);  // would block whoever opens it
    EXPECT_THAT(fault_of([&] { read_display(folder / "pipe"); }), HasSubstr("is not a regular file"));
    EXPECT_THAT(fault_of([&] { read_display(fs::path(std::string(5000, 'a'))); }), HasSubstr("there is no such file"));
    EXPECT_THAT(fault_of([&] { read_display(""); }), HasSubstr("there is no such file"));
}

TEST_F(TextFile, NoDescription) {
    EXPECT_THAT(fault_of_file(""), HasSubstr("d.toml: is empty"));
    EXPECT_THAT(fault_of_file("\n \t\r\n"), HasSubstr("d.toml: is empty"));
    EXPECT_THAT(fault_of_file(std::string("schema = 1\0", 11)), HasSubstr("d.toml: is a binary file"));
    EXPECT_THAT(fault_of_file("\x89PNG\r\n\x1a\n"), HasSubstr("d.toml:1:1: "));
    EXPECT_THAT(fault_of_file("name = \"\xc3\x28\""), HasSubstr("d.toml:1:8: Encountered invalid utf-8"));
    EXPECT_THAT(fault_of_file("schema = 1\nname = \"cut"), HasSubstr("d.toml:2:"));
}

TEST_F(TextFile, HugeFilesAreNotRead) {
    std::ofstream(folder / "d.toml") << "#";
    fs::resize_file(folder / "d.toml", std::uintmax_t(1) << 40);  // sparse: a terabyte that would not fit into memory
    EXPECT_THAT(fault_of([&] { read_display(folder / "d.toml"); }), HasSubstr("has 1099511627776 bytes, allowed are 1048576"));
    EXPECT_THAT(fault_of_text(std::string((1 << 20) + 1, '#')), HasSubstr("has 1048577 bytes"));
    EXPECT_THAT(fault_of_text(std::string(1 << 20, '#')), HasSubstr("schema: is missing"));
}

TEST(CheckText, Nesting) {
    const std::string brackets(1 << 19, '['), braces = "a={" + std::string(1000, '{');
    EXPECT_THAT(fault_of_text("a = " + brackets), HasSubstr("x.toml:1:21: is nested 17 levels deep, allowed are 16"));
    EXPECT_THAT(fault_of_text(braces), HasSubstr("nested 17 levels"));
    std::string dots = "\n  a";
    for (int i = 0; i < 300000; ++i) dots += ".a";
    EXPECT_THAT(fault_of_text(dots + " = 1"), HasSubstr("x.toml:2:36: is nested 17 levels"));
    EXPECT_THAT(fault_of_text("[" + dots.substr(3) + "]"), HasSubstr("nested 17 levels"));
    for (const std::string quotes :
         {"\"\"\"", "'''"})  // the end of a string of several lines may have one or two quotes of its own
        for (const std::string& own : {quotes.substr(0, 1), quotes.substr(0, 2)})
            EXPECT_THAT(fault_of_text("a = [" + quotes + "b" + own + quotes + ", {" + dots.substr(3) + " = 1}]"),
                        HasSubstr("x.toml:1:"))
                << quotes << own;
    // brackets and dots that are no nesting
    for (const std::string& text : std::vector<std::string>{
             "# [[[[[[[[[[[[[[[[[[[[", "a = '[[[[[[[[[[[[[[[[[[[['", "a = \"\\\"[[[[[[[[[[[[[[[[[[[[\"",
             "a = '''\n'' [[[[[[[[[[[[[[[[[[[[\n'''", "a = \"\"\"\\\"\"\"[[[[[[[[[[[[[[[[[[[[\"\"\"", "a = '...................'",
             "a = [1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5]"})
        EXPECT_NO_THROW(check_text(text, "x.toml")) << text;
}

TEST(CheckText, ByteOrderMarkAndLineEnds) {
    EXPECT_THAT(fault_of_text("\xEF\xBB\xBFschema = 1\r\nnam = 1\r\n"),
                HasSubstr("x.toml:2:1: nam: is unknown; did you mean name?"));
}

}  // namespace
}  // namespace lfdsim
