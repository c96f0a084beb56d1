// Text that a terminal or a page would obey is escaped, all other text is left as it is.
#include "base/printable.h"

#include <gtest/gtest.h>
#include <string>

namespace lfdsim {
namespace {

std::string utf8(char32_t c) {
    if (c < 0x80) return {char(c)};
    if (c < 0x800) return {char(0xc0 | c >> 6), char(0x80 | (c & 0x3f))};
    if (c < 0x10000) return {char(0xe0 | c >> 12), char(0x80 | (c >> 6 & 0x3f)), char(0x80 | (c & 0x3f))};
    return {char(0xf0 | c >> 18), char(0x80 | (c >> 12 & 0x3f)), char(0x80 | (c >> 6 & 0x3f)), char(0x80 | (c & 0x3f))};
}

TEST(Printable, EscapesWhatATerminalObeys) {
    EXPECT_EQ(printable("\x1b[31mred\x07\n\t\x7f"), "\\u001b[31mred\\u0007\\u000a\\u0009\\u007f");
    EXPECT_EQ(printable_lines("a\n\tb\r\x1b"), "a\n\tb\\u000d\\u001b");
    EXPECT_EQ(printable(utf8(0x9b) + utf8(0x202e) + utf8(0x2066) + utf8(0x200b) + utf8(0xfeff)),
              "\\u009b\\u202e\\u2066\\u200b\\ufeff");
    EXPECT_EQ(printable(utf8(0xe0041)), "\\udb40\\udc41");  // as JSON writes it
    EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\u0000b");
}

TEST(Printable, LeavesAllOtherText) {
    for (const char32_t c : {0x20, 0x7e, 0xa0, 0xe9, 0xb5, 0x3b1, 0x5d0, 0x627, 0x4e2d, 0x2192, 0xfffd, 0x1f600, 0x10ffff}) {
        EXPECT_EQ(printable(utf8(c)), utf8(c)) << std::hex << std::uint32_t(c);
        EXPECT_TRUE(is_printable(utf8(c)));
    }
    EXPECT_EQ(printable("C:\\u001b \"quoted\""), "C:\\u001b \"quoted\"");
    EXPECT_EQ(printable(""), "");
}

TEST(Printable, ShowsBytesThatAreNotUtf8) {
    EXPECT_EQ(printable("a\xff\xc3("), "a\\xff\\xc3(");
    EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");                    // an overlong form of NUL
    EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
    EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
    EXPECT_EQ(printable("\xe2\x80"), "\\xe2\\x80");                    // cut off
    EXPECT_EQ(printable("\x9b"), "\\x9b");                             // C1 as a terminal of Latin-1 takes it
}

TEST(Printable, BoundsQuotesAndMessages) {
    EXPECT_EQ(shortened("short\n"), "short\\u000a");
    EXPECT_EQ(shortened(std::string(41, 'a')), std::string(40, 'a') + "...");
    EXPECT_EQ(shortened(std::string(39, 'a') + utf8(0x4e2d)), std::string(39, 'a') + "...");
    EXPECT_EQ(bounded(std::string(900, 'a')), std::string(900, 'a'));
    const std::string all = bounded("file: " + std::string(16384, 'a') + "; give another");
    EXPECT_LT(all.size(), 900u);
    EXPECT_TRUE(all.starts_with("file: aaa") && all.ends_with("aaa; give another") && all.find("bytes ...]") != all.npos) << all;
    for (std::size_t n = 890; n < 910; ++n) {
        std::string text;
        while (text.size() < n) text += utf8(0x4e2d);
        EXPECT_TRUE(is_printable(bounded(text)));
    }
}

}  // namespace
}  // namespace lfdsim
