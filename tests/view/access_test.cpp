#include "view/server/access.h"

#include <gtest/gtest.h>

namespace lfdsim::view {
namespace {

TEST(Access, Tokens) {
    const std::string token = make_token();
    EXPECT_EQ(token.size(), 32u);
    EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), token.npos);
    EXPECT_NE(token, make_token());
    EXPECT_TRUE(same_token(token, token));
    EXPECT_FALSE(same_token(token.substr(1), token));
    EXPECT_FALSE(same_token("", token));
    EXPECT_EQ(token_of("/?token=abc"), "abc");
    EXPECT_EQ(token_of("/socket?a=b&token=abc&c"), "abc");
    for (const char* none : {"", "/", "/?", "/?token", "/?tokens=a", "/?&&", "/token=abc", "/?a?token=abc"})
        EXPECT_EQ(token_of(none), "") << none;
}

TEST(Access, HostOfLoopback) {
    const Gate gate{"127.0.0.1", 8000, "lab.example.org"};
    for (const char* host :
         {"127.0.0.1:8000", "localhost:8000", "LocalHost:8000", "localhost", "localhost:2222", "[::1]:8000", "127.1.2.3:80"})
        EXPECT_TRUE(gate.lets_host(host)) << host;
    for (const char* host : {"", ":8000", "evil.example:8000", "localhost.evil.example:8000", "lab.example.org:8000",
                             "10.0.0.1:8000", "localhost:", "localhost:x", "localhost:99999", "localhost:80 ", "localhost:80:80",
                             "[::1", "[::1]x", "::1", "[localhost]:80x"})
        EXPECT_FALSE(gate.lets_host(host)) << host;
}

TEST(Access, HostOfOneAddressOrAll) {
    const Gate one{"10.0.0.1", 8000, "lab.example.org"}, all{"0.0.0.0", 8000, "lab.example.org"},
        named{"lab", 8000, "lab.example.org"};
    EXPECT_TRUE(one.lets_host("10.0.0.1:8000"));
    EXPECT_TRUE(one.lets_host("localhost:1"));
    for (const char* host : {"10.0.0.1:8001", "10.0.0.1", "10.0.0.2:8000", "lab.example.org:8000"})
        EXPECT_FALSE(one.lets_host(host)) << host;
    for (const char* host : {"10.0.0.1:8000", "[fe80::1]:8000", "lab.example.org:8000", "LAB:8000", "lab.local:8000"})
        EXPECT_TRUE(all.lets_host(host)) << host;
    for (const char* host : {"10.0.0.1:8001", "evil.example:8000", "example.org:8000", "lab.evil.example:8000"})
        EXPECT_FALSE(all.lets_host(host)) << host;
    EXPECT_TRUE(named.lets_host("lab:8000"));
    EXPECT_FALSE(named.lets_host("10.0.0.1:8000"));
}

TEST(Access, Origin) {
    EXPECT_TRUE(same_origin("http://localhost:8000", "localhost:8000"));
    for (const char* origin : {"", "null", "localhost:8000", "http://", "http://localhost:8001", "http://localhost",
                               "https://localhost:8000", "http://localhost:8000/", "http://localhost:8000.evil.example"})
        EXPECT_FALSE(same_origin(origin, "localhost:8000")) << origin;
}

}  // namespace
}  // namespace lfdsim::view
