#include "view/server/server.h"

#include "base/counted.h"
#include "base/input_error.h"
#include "view/server/http.h"
#include "view/server/session.h"

#include <fmt/format.h>
#include <unistd.h>
#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <list>
#include <set>
#include <thread>
#include <utility>

namespace lfdsim::view {

namespace net = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using beast::error_code;
using net::ip::tcp;
using namespace std::chrono_literals;

namespace {

constexpr std::size_t most_header_bytes = 32 << 10;  // which include the cookies of all other servers of this machine
constexpr std::size_t most_callers = 256;            // connections that are not yet a WebSocket; one more ends the oldest
constexpr std::size_t most_turned_away = 32;         // connections that are being sent a refusal
constexpr auto request_time = 5s;                    // for a whole request, and for its answer

std::string own_name() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// A connection from which a request is expected.
struct Caller {
    explicit Caller(tcp::socket socket) : stream(std::move(socket)) { parser.header_limit(most_header_bytes); }
    beast::tcp_stream stream;
    beast::flat_buffer buffer{most_header_bytes};
    http::request_parser<http::empty_body> parser;
    Response response;
};
using Callers = std::list<std::shared_ptr<Caller>>;

}  // namespace

/// Everything except the constructor, the destructor and counts() runs on one network thread, which never waits. A connection is a
/// Caller until its request has been read: read() -> answer() -> drain() -> end(), or read() -> upgrade(), which makes a Session of
/// it.
struct Server::Impl {
    Impl(ServerOptions, std::string page_text, std::function<std::unique_ptr<Visitor>(Outbox&)>);

    void listen();
    void accept();
    void read(const std::shared_ptr<Caller>&);
    void answer(const std::shared_ptr<Caller>&, Response);
    void drain(const std::shared_ptr<Caller>&);
    void end(const std::shared_ptr<Caller>&);
    void upgrade(const std::shared_ptr<Caller>&);
    void stop();

    const ServerOptions options;
    const std::string page;
    const Session::Connect connect;
    Gate gate;
    Tally tally;
    net::io_context context{1};
    tcp::acceptor acceptor{context};
    net::steady_timer pause{context};
    Callers callers;  // the oldest first
    std::set<std::shared_ptr<Session>> visitors, turned_away;
    std::thread thread;
};

Server::Impl::Impl(ServerOptions o, std::string page_text, Session::Connect c)
    : options(std::move(o)), page(std::move(page_text)), connect(std::move(c)) {
    listen();
    gate = {options.host, acceptor.local_endpoint().port(), own_name()};
    accept();
    thread = std::thread([this] { context.run(); });
}

void Server::Impl::listen() {
    error_code error;
    tcp::resolver resolver(context);
    const auto found = resolver.resolve(options.host, std::to_string(options.port), tcp::resolver::passive, error);
    if (error || found.empty())
        throw InputError("--host", fmt::format("\"{}\" is not an address of this machine: {}", options.host, error.message()));
    const tcp::endpoint endpoint = *found.begin();
    acceptor.open(endpoint.protocol(), error);
    if (!error) acceptor.set_option(net::socket_base::reuse_address(true), error);
    if (!error) acceptor.bind(endpoint, error);
    if (!error) acceptor.listen(net::socket_base::max_listen_connections, error);
    if (error)
        throw InputError("--port", fmt::format("cannot listen on {} port {}: {}", options.host, options.port, error.message()));
}

/// Accepts connections, one after the other. Where there are too many callers or no descriptors, the oldest caller ends; where that
/// is no remedy, it pauses.
void Server::Impl::accept() {
    acceptor.async_accept([this](error_code error, tcp::socket socket) {
        if (!acceptor.is_open()) return;
        const bool crowded = error == net::error::no_descriptors || callers.size() >= most_callers;
        if (crowded && !callers.empty())
            end(callers.front());
        else if (error) {
            pause.expires_after(50ms);
            pause.async_wait([this](error_code) {
                if (acceptor.is_open()) accept();
            });
            return;
        }
        if (error) return accept();
        socket.set_option(tcp::no_delay(true), error);
        callers.push_back(std::make_shared<Caller>(std::move(socket)));
        read(callers.back());
        accept();
    });
}

void Server::Impl::read(const std::shared_ptr<Caller>& caller) {
    caller->stream.expires_after(request_time);
    http::async_read_header(caller->stream, caller->buffer, caller->parser, [this, caller](error_code error, std::size_t) {
        if (error == http::error::header_limit || error == http::error::buffer_overflow)
            return answer(caller, sentence(http::status::request_header_fields_too_large, "The request is too long."));
        if (error.category() == http::make_error_code(http::error::bad_line_ending).category() &&
            error != http::error::end_of_stream && error != http::error::partial_message)
            return answer(caller, sentence(http::status::bad_request, "This is not an HTTP request."));
        if (error) return end(caller);
        auto response = respond(caller->parser.get(), gate, options.token, page);
        if (!response) return upgrade(caller);
        if (response->result() == http::status::forbidden) ++tally.refused;
        answer(caller, std::move(*response));
    });
}

void Server::Impl::answer(const std::shared_ptr<Caller>& caller, Response response) {
    caller->response = std::move(response);
    caller->stream.expires_after(request_time);
    http::async_write(caller->stream, caller->response, [this, caller](error_code error, std::size_t) {
        if (error) return end(caller);
        caller->stream.socket().shutdown(tcp::socket::shutdown_send, error);
        caller->buffer.clear();
        drain(caller);
    });
}

/// Reads and ignores what a caller still sends: closing with unread bytes would reset the connection, and the browser might lose
/// the answer.
void Server::Impl::drain(const std::shared_ptr<Caller>& caller) {
    caller->stream.async_read_some(caller->buffer.prepare(4096), [this, caller](error_code error, std::size_t) {
        if (error) return end(caller);
        drain(caller);
    });
}

void Server::Impl::end(const std::shared_ptr<Caller>& caller) {
    caller->stream.close();
    callers.remove(caller);
}

/// Makes a visitor of a caller. With too many visitors it becomes a session that is only sent the reason.
void Server::Impl::upgrade(const std::shared_ptr<Caller>& caller) {
    const bool full = int(visitors.size()) >= options.most_visitors;
    if (full) ++tally.refused;
    if (full && turned_away.size() >= most_turned_away)
        return answer(caller, sentence(http::status::service_unavailable, "Too many visitors. Try again later."));
    auto& group = full ? turned_away : visitors;
    const auto place = std::make_shared<std::weak_ptr<Session>>();
    const auto session =
        std::make_shared<Session>(std::move(caller->stream), options, tally, [&group, place] { group.erase(place->lock()); });
    *place = session;
    group.insert(session);
    callers.remove(caller);
    if (full)
        session->turn_away(caller->parser.get(), fmt::format("The viewer already has {}. Close one of its pages first.",
                                                             counted(options.most_visitors, "visitor")));
    else
        session->welcome(caller->parser.get(), connect);
}

void Server::Impl::stop() {
    error_code error;
    acceptor.close(error);
    pause.cancel();
    while (!callers.empty()) end(callers.front());
    for (const auto* group : {&visitors, &turned_away})
        for (const auto& session : *group) session->end();
}

Server::Server(ServerOptions options, std::string page, Session::Connect connect)
    : impl_(std::make_unique<Impl>(std::move(options), std::move(page), std::move(connect))) {}

// Sessions count as work of the io_context until their visitors have been destroyed, so that the network thread ends last.
Server::~Server() {
    net::post(impl_->context, [this] { impl_->stop(); });
    impl_->thread.join();
}

int Server::port() const { return impl_->gate.port; }

ServerCounts Server::counts() const {
    const Tally& t = impl_->tally;
    return {t.visitors, t.refused, t.malformed, t.messages, t.frames_sent, t.frames_dropped};
}

}  // namespace lfdsim::view
