// The page as it is built into the program.
#include "view/server/page.h"

#include <gtest/gtest.h>
#include <regex>

namespace lfdsim {
namespace {

std::size_t count(const std::string& text, const std::string& pattern) {
    const std::regex sought(pattern);
    return std::size_t(std::distance(std::sregex_iterator(text.begin(), text.end(), sought), std::sregex_iterator()));
}

TEST(Page, IsWholeAndAsksForNothingElse) {
    const std::string page = view::page();
    EXPECT_EQ(page.find("<!doctype html>"), 0);
    EXPECT_NE(page.find("window.lfdsim ="), page.npos);  // the last script
    EXPECT_NE(page.find("</html>"), page.npos);
    EXPECT_EQ(count(page, "\n(import|export) "), 0);
    EXPECT_EQ(count(page, "<[^>]*\\s(src|href|action)=\"(?!data:,)"), 0);
    EXPECT_EQ(count(page, "https?://(?!www.w3.org/2000/svg)"), 0);
    EXPECT_EQ(count(page, "@import|url\\("), 0);
}

TEST(Page, HasOneStyleAndOneScriptForAPolicyToLetIn) {
    const std::string page = view::page();
    EXPECT_EQ(count(page, "<style>"), 1);
    EXPECT_EQ(count(page, "<script type=\"module\">"), 1);
    EXPECT_EQ(count(page, "<(style|script)"), 2);
    EXPECT_EQ(count(page, "</(style|script)>"), 2);
    EXPECT_EQ(count(page, "<[^>]*\\s(style|on[a-z]+)=\""), 0);
    EXPECT_EQ(count(page, "innerHTML|outerHTML|insertAdjacentHTML|document\\.write|\\beval\\b|new Function"), 0);
}

}  // namespace
}  // namespace lfdsim
