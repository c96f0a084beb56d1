#include "view/server/server.h"
#include "view/server/access.h"

#include "echo.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <functional>
#include <optional>

namespace lfdsim::view {
namespace {

namespace net = boost::asio;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using net::ip::tcp;
using testing::HasSubstr;
using testing::Not;
using namespace std::chrono_literals;

const std::string token = make_token();

bool soon(const std::function<bool()>& holds, std::chrono::milliseconds within = 5s) {
    const auto end = std::chrono::steady_clock::now() + within;
    while (!holds())
        if (std::chrono::steady_clock::now() > end)
            return false;
        else
            std::this_thread::sleep_for(5ms);
    return true;
}

ServerOptions options() {
    ServerOptions o;
    o.token = token;
    return o;
}

struct Fixture {
    explicit Fixture(ServerOptions o = options())
        : server(std::make_unique<Server>(o, "<!doctype html><script>page</script>",
                                          [this](Outbox& outbox) { return std::make_unique<Echo>(outbox, guests); })) {}
    std::string address() const { return fmt::format("127.0.0.1:{}", server->port()); }

    Guests guests;
    std::unique_ptr<Server> server;
};

/// A browser's end of a WebSocket.
class Browser {
  public:
    explicit Browser(const Server& server) : socket_(context_) {
        socket_.next_layer().connect({net::ip::address_v4::loopback(), std::uint16_t(server.port())});
        const std::string host = fmt::format("127.0.0.1:{}", server.port());
        socket_.set_option(
            websocket::stream_base::decorator([&](websocket::request_type& r) { r.set("Origin", "http://" + host); }));
        socket_.handshake(host, "/socket?token=" + token);
    }
    void say(const std::string& text, bool binary = false) {
        socket_.binary(binary);
        socket_.write(net::buffer(text));
    }
    /// The next message; nothing when the connection ends.
    std::optional<std::string> hear() {
        boost::beast::flat_buffer buffer;
        boost::beast::error_code error;
        socket_.read(buffer, error);
        if (error) return std::nullopt;
        return boost::beast::buffers_to_string(buffer.data());
    }
    std::string ask(const std::string& text) {
        say(text);
        return hear().value_or("nothing");
    }
    websocket::close_code reason() const { return websocket::close_code(socket_.reason().code); }
    websocket::stream<tcp::socket, false>& socket() { return socket_; }

  private:
    net::io_context context_;
    websocket::stream<tcp::socket, false> socket_;
};

http::response<http::string_body> request(const Fixture& f, http::verb verb, const std::string& target,
                                          const std::string& host = {},
                                          const std::vector<std::pair<std::string, std::string>>& headers = {}) {
    net::io_context context;
    tcp::socket socket(context);
    socket.connect({net::ip::address_v4::loopback(), std::uint16_t(f.server->port())});
    http::request<http::string_body> r(verb, target, 11);
    r.set(http::field::host, host.empty() ? f.address() : host);
    for (const auto& [name, value] : headers) r.insert(name, value);
    if (verb == http::verb::post) r.body() = std::string(100000, 'x');
    r.prepare_payload();
    http::write(socket, r);
    boost::beast::flat_buffer buffer;
    http::response_parser<http::string_body> parser;
    if (verb == http::verb::head) parser.skip(true);
    http::read(socket, buffer, parser);
    return parser.release();
}

http::status upgrade(const Fixture& f, const std::string& target, const std::string& host, const std::string& origin) {
    return request(f, http::verb::get, target, host,
                   {{"Origin", origin},
                    {"Connection", "Upgrade"},
                    {"Upgrade", "websocket"},
                    {"Sec-WebSocket-Version", "13"},
                    {"Sec-WebSocket-Key", "AAAAAAAAAAAAAAAAAAAAAA=="}})
        .result();
}

TEST(Server, PageNeedsToken) {
    const Fixture f;
    const auto get = [&](const std::string& target) { return request(f, http::verb::get, target); };
    const auto page = get("/?token=" + token);
    EXPECT_EQ(page.result(), http::status::ok);
    EXPECT_EQ(page[http::field::content_type], "text/html; charset=utf-8");
    EXPECT_EQ(page[http::field::cache_control], "no-store");
    EXPECT_EQ(page["X-Content-Type-Options"], "nosniff");
    const std::string policy(page["Content-Security-Policy"]);
    const std::string nonce = policy.substr(policy.find("'nonce-") + 7, 32);
    EXPECT_EQ(page.body(), "<!doctype html><script nonce=\"" + nonce + "\">page</script>");
    EXPECT_THAT(policy, HasSubstr("connect-src 'self'"));
    EXPECT_NE(get("/?token=" + token).body(), page.body()) << "a nonce is used once";

    std::string wrong = token;
    wrong.back() = wrong.back() == '0' ? '1' : '0';
    for (const std::string& target :
         {std::string("/"), std::string("/?token="), "/?token=" + wrong, "/?token=" + token + "0", "/?tokens=" + token}) {
        const auto refused = get(target);
        EXPECT_EQ(refused.result(), http::status::forbidden) << target;
        EXPECT_THAT(refused.body(), Not(HasSubstr("page")));
        EXPECT_THAT(refused.body(), HasSubstr("token"));
    }
    EXPECT_EQ(f.server->counts().refused, 5);
    for (const char* target : {"/index.html", "/../etc/passwd", "//", "/%2e%2e/", "*", "http://127.0.0.1/", "/socket/"})
        EXPECT_EQ(get(target + ("?token=" + token)).result(), http::status::not_found) << target;
    EXPECT_EQ(get("/socket?token=" + token).result(), http::status::upgrade_required);
}

TEST(Server, OnlyGets) {
    const Fixture f;
    for (const auto verb :
         {http::verb::head, http::verb::post, http::verb::put, http::verb::delete_, http::verb::options, http::verb::trace})
        EXPECT_EQ(request(f, verb, "/?token=" + token).result(), http::status::method_not_allowed) << verb;
}

TEST(Server, BadAndLongRequests) {
    const Fixture f;
    const auto first_line = [&](const std::string& text) {
        net::io_context context;
        tcp::socket socket(context);
        socket.connect({net::ip::address_v4::loopback(), std::uint16_t(f.server->port())});
        net::write(socket, net::buffer(text));
        std::string answer;
        boost::beast::error_code error;
        net::read(socket, net::dynamic_buffer(answer), error);
        EXPECT_EQ(error, net::error::eof) << "a connection that is reset may lose its answer";
        return answer.substr(0, answer.find('\r'));
    };
    const std::string get = "GET /?token=" + token + " HTTP/1.1\r\n", host = "Host: " + f.address() + "\r\n";
    const auto cookie = [](std::size_t bytes) { return "Cookie: " + std::string(bytes, 'x') + "\r\n\r\n"; };
    EXPECT_EQ(first_line(get + host + cookie(20000)), "HTTP/1.1 200 OK");
    EXPECT_EQ(first_line(get + host + cookie(1000000)), "HTTP/1.1 431 Request Header Fields Too Large");
    EXPECT_EQ(first_line("\x16\x03\x01 what TLS begins with\r\n\r\n"), "HTTP/1.1 400 Bad Request");
    EXPECT_EQ(first_line(get + "\r\n"), "HTTP/1.1 403 Forbidden") << "no Host";
    EXPECT_EQ(first_line(get + host + host + "\r\n"), "HTTP/1.1 403 Forbidden") << "two of them";
    const std::string origin = "Origin: http://" + f.address() + "\r\n";
    EXPECT_EQ(first_line(get + host + origin + "\r\n"), "HTTP/1.1 200 OK");
    EXPECT_EQ(first_line(get + host + origin + origin + "\r\n"), "HTTP/1.1 403 Forbidden");
}

TEST(Server, SocketNeedsTokenHostAndOrigin) {
    const Fixture f;
    const std::string right = "/socket?token=" + token, here = f.address();
    EXPECT_EQ(upgrade(f, right, here, "http://" + here), http::status::switching_protocols);
    EXPECT_EQ(upgrade(f, right, "localhost:9999", "http://localhost:9999"), http::status::switching_protocols) << "an ssh tunnel";
    EXPECT_EQ(upgrade(f, "/socket", here, "http://" + here), http::status::forbidden);
    EXPECT_EQ(upgrade(f, right, here, "http://evil.example"), http::status::forbidden);
    EXPECT_EQ(upgrade(f, right, here, "null"), http::status::forbidden);
    EXPECT_EQ(upgrade(f, right, here, "http://localhost:" + std::to_string(f.server->port())), http::status::forbidden);
    EXPECT_EQ(upgrade(f, right, "evil.example:" + std::to_string(f.server->port()), "http://evil.example"),
              http::status::forbidden);
    for (int k = 0; k < 500 && f.guests.made < 2; ++k) std::this_thread::sleep_for(10ms);  // each on a thread of its own
    EXPECT_EQ(f.guests.made, 2);
}

TEST(Server, EchoesInOrder) {
    Fixture f;
    Browser one(*f.server), two(*f.server);
    for (int k = 0; k < 300; ++k) one.say(std::to_string(k));
    EXPECT_EQ(two.ask("two"), "two");
    for (int k = 0; k < 300; ++k) ASSERT_EQ(one.hear(), std::to_string(k));
    EXPECT_EQ(f.server->counts().visitors, 2);
    EXPECT_EQ(f.server->counts().messages, 301);
}

TEST(Server, VisitorIsDestroyedOnceAndNotAtWork) {
    Fixture f;
    {
        Browser leaves(*f.server), vanishes(*f.server), stays(*f.server);
        vanishes.say("sleep 300");
        leaves.socket().close(websocket::close_code::normal);
        ASSERT_TRUE(soon([&] { return f.guests.at_work == 1 && f.guests.destroyed == 1; }));
        vanishes.socket().next_layer().close();
        EXPECT_EQ(stays.ask("there"), "there");
        EXPECT_EQ(f.guests.destroyed, 1) << "at work";
        ASSERT_TRUE(soon([&] { return f.guests.destroyed == 2; }));
        stays.say("sleep 300");
        ASSERT_TRUE(soon([&] { return f.guests.at_work == 1; }));
        f.server.reset();  // with a connection open and its visitor at work
        EXPECT_EQ(stays.hear(), std::nullopt);
    }
    EXPECT_EQ(f.guests.destroyed, 3);
    EXPECT_EQ(f.guests.destroyed_at_work, 0);
}

TEST(Server, VisitorThatLingersHoldsUpNobody) {
    Fixture f;
    Browser stays(*f.server);
    {
        Browser leaves(*f.server);
        leaves.say("linger 700");
        EXPECT_EQ(leaves.ask("heard"), "heard");
    }
    ASSERT_TRUE(soon([&] { return f.guests.leaving == 1; }));
    std::this_thread::sleep_for(50ms);
    EXPECT_EQ(stays.ask("there"), "there");
    Browser comes(*f.server);
    EXPECT_EQ(comes.ask("new"), "new");
    EXPECT_EQ(f.guests.destroyed, 0) << "while the first lingers";
}

TEST(Server, MostVisitors) {
    ServerOptions few = options();
    few.most_visitors = 2;
    Fixture f(few);
    {
        Browser one(*f.server), two(*f.server), three(*f.server);
        EXPECT_THAT(three.hear().value_or(""), HasSubstr("already has 2 visitors"));
        EXPECT_EQ(three.hear(), std::nullopt);
        EXPECT_EQ(three.reason(), websocket::close_code::try_again_later);
        EXPECT_EQ(one.ask("one"), "one");
    }
    ASSERT_TRUE(soon([&] { return f.guests.destroyed == 2; }));
    EXPECT_TRUE(soon([&] { return Browser(*f.server).ask("again") == "again"; }));
}

TEST(Server, MalformedMessagesEndTheConnection) {
    Fixture f;
    Browser browser(*f.server);
    EXPECT_EQ(browser.ask("malformed"), R"({"type":"error","what":"that is no \"message\""})");
    browser.say("binary", true);
    EXPECT_THAT(browser.hear().value_or(""), HasSubstr("that is no"));
    for (int k = 2; k < 99; ++k) browser.ask("malformed");
    EXPECT_EQ(browser.ask("still there"), "still there");
    EXPECT_THAT(browser.ask("malformed"), HasSubstr("that is no"));
    EXPECT_EQ(browser.hear(), std::nullopt);
    EXPECT_EQ(f.server->counts().malformed, 100);
    EXPECT_TRUE(soon([&] { return f.guests.destroyed == 1; }));
}

TEST(Server, LongAndBrokenMessages) {
    Fixture f;
    Browser fits(*f.server), broken(*f.server), longer(*f.server), fragments(*f.server);
    const std::string longest(64 << 10, 'x');
    EXPECT_EQ(fits.ask(longest), longest);
    broken.say("\xff\xfe");
    EXPECT_EQ(broken.hear(), std::nullopt);
    EXPECT_EQ(broken.reason(), websocket::close_code::bad_payload);
    longer.say(longest + "x");
    EXPECT_EQ(longer.hear(), std::nullopt);
    EXPECT_EQ(longer.reason(), websocket::close_code::too_big);
    for (int k = 0; k < 66; ++k) fragments.socket().write_some(false, net::buffer(std::string(1000, 'x')));
    EXPECT_EQ(fragments.hear(), std::nullopt);
    EXPECT_EQ(fragments.reason(), websocket::close_code::too_big);
    EXPECT_TRUE(soon([&] { return f.server->counts().malformed == 3; }));
}

TEST(Server, FailingVisitor) {
    Fixture f;
    Browser browser(*f.server);
    EXPECT_THAT(browser.ask("throw"), HasSubstr("out of order"));
    while (browser.hear()) {
    }
    const Server refuses(options(), "", [](Outbox&) -> std::unique_ptr<Visitor> { throw std::runtime_error("no memory"); });
    Browser unlucky(refuses);
    EXPECT_THAT(unlucky.hear().value_or(""), HasSubstr("no memory"));
    EXPECT_EQ(unlucky.hear(), std::nullopt);
}

TEST(Server, SlowReaderGetsTheNewestFrameAndHoldsUpNobody) {
    Fixture f;
    Browser slow(*f.server), other(*f.server);
    slow.say("frames 100 1000000");
    ASSERT_TRUE(soon([&] { return f.server->counts().frames_dropped > 50; }));
    EXPECT_EQ(other.ask("there"), "there");
    std::string last;
    int frames = 0;
    while (last.substr(0, 3) != "99 ") {
        last = slow.hear().value_or("99 ended");
        ++frames;
    }
    EXPECT_EQ(last.size(), 1000002u);
    EXPECT_LT(frames, 50);
    ASSERT_TRUE(soon([&] { return f.server->counts().frames_sent == frames; }));
    EXPECT_EQ(f.server->counts().frames_dropped, 100 - frames);
}

TEST(Server, TooManyTextsEndTheConnection) {
    Fixture f;
    Browser slow(*f.server), long_texts(*f.server);
    slow.say("frames 1 20000000");  // more than the kernel keeps, so that the texts after it wait
    slow.say("texts 257 1");
    EXPECT_TRUE(soon([&] { return f.guests.destroyed == 1; }));
    long_texts.say("frames 1 20000000");
    long_texts.say("texts 5 1000000");
    EXPECT_TRUE(soon([&] { return f.guests.destroyed == 2; }));
}

TEST(Server, BrowserThatAnswersNoPingIsGone) {
    ServerOptions impatient = options();
    impatient.most_silence = 2s;
    Fixture f(impatient);
    Browser dead(*f.server), quiet(*f.server);
    std::optional<std::string> heard;
    std::thread reader([&] { heard = quiet.hear(); });  // reading, it answers pings
    EXPECT_TRUE(soon([&] { return f.guests.destroyed == 1; }));
    std::this_thread::sleep_for(1s);
    EXPECT_EQ(f.guests.destroyed, 1);
    quiet.say("alive");
    reader.join();
    EXPECT_EQ(heard, "alive");
}

TEST(Server, ManyMessagesAreReadSlowly) {
    Fixture f;
    Browser browser(*f.server);
    const auto start = std::chrono::steady_clock::now();
    std::thread sender([&] {
        for (int k = 0; k < 1000; ++k) browser.say("x");
    });
    for (int k = 0; k < 1000; ++k) browser.hear();
    sender.join();
    EXPECT_GT(std::chrono::steady_clock::now() - start, 900ms) << "500 at once, 500 more in a second";
}

TEST(Server, PortsThatCannotBeHad) {
    const Fixture f;
    ServerOptions taken = options();
    taken.port = f.server->port();
    const auto connect = [](Outbox&) -> std::unique_ptr<Visitor> { return nullptr; };
    EXPECT_THROW(Server(taken, "", connect), InputError);
    ServerOptions nowhere = options();
    nowhere.host = "192.0.2.1";  // of no machine: RFC 5737
    EXPECT_THROW(Server(nowhere, "", connect), InputError);
    nowhere.host = "no such host";
    EXPECT_THROW(Server(nowhere, "", connect), InputError);
}

}  // namespace
}  // namespace lfdsim::view
