#include "view/server/session.h"

#include "base/input_error.h"
#include "base/json_utf8.h"
#include "view/server/messages.h"

#include <netinet/tcp.h>
#include <sys/socket.h>
#include <algorithm>
#include <boost/asio/post.hpp>
#include <exception>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace lfdsim::view {

namespace net = boost::asio;
namespace websocket = boost::beast::websocket;
using boost::beast::error_code;
using namespace std::chrono_literals;

namespace {

constexpr auto between_messages = 2ms, credit = 1000ms;  // 500 messages a second on average; 500 at once after a second without any
constexpr int most_malformed = 100;
constexpr int most_unsent_bytes = 128 << 10;
constexpr std::size_t fragment_bytes = 64 << 10;  // of a long frame: pings and pongs can be sent between fragments

constexpr const char* no_thread = "The viewer's machine has no thread left for another visitor.";

std::string error_text(const std::string& what) { return json_utf8(nlohmann::ordered_json{{"type", "error"}, {"what", what}}); }

}  // namespace

Session::Session(boost::beast::tcp_stream stream, const ServerOptions& options, Tally& tally, std::function<void()> gone)
    : socket_(std::move(stream)),
      work_(socket_.get_executor()),
      options_(options),
      tally_(tally),
      gone_(std::move(gone)),
      pause_(socket_.get_executor()) {
    // Unsent data should wait in the mailbox, where a newer frame can replace it, not in the kernel, whose part is limited.
    setsockopt(boost::beast::get_lowest_layer(socket_).socket().native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &most_unsent_bytes,
               sizeof most_unsent_bytes);
}

/// Runs work(session) on the network thread, later.
template <class Work>
void Session::post(Work work) {
    net::post(socket_.get_executor(), [self = shared_from_this(), work = std::move(work)] { work(*self); });
}

/// Completes the WebSocket's handshake, then calls `then`.
void Session::accept(const Request& request, std::function<void()> then) {
    socket_.next_layer().expires_never();
    socket_.set_option(websocket::stream_base::timeout{5s, options_.most_silence, true});
    socket_.read_message_max(longest_message);
    socket_.auto_fragment(true);
    socket_.write_buffer_bytes(fragment_bytes);
    socket_.async_accept(request, [self = shared_from_this(), then = std::move(then)](error_code error) {
        if (error || self->ended_) return self->end();
        then();
    });
}

void Session::welcome(const Request& request, Connect connect) {
    accept(request, [this, connect = std::move(connect)] {
        try {
            visit_ = std::thread([self = shared_from_this(), connect] { self->visit(connect); });
        } catch (const std::system_error&) {
            mailbox_.text(error_text(no_thread));
            return finish();
        }
        ++tally_.visitors;
        read();
        write();
    });
}

void Session::turn_away(const Request& request, const std::string& why) {
    accept(request, [this, why] {
        mailbox_.text(error_text(why));
        finish();
    });
}

/// Reads one message, not before due_.
void Session::read() {
    if (ended_ || finishing_) return;
    const auto now = std::chrono::steady_clock::now();
    if (due_ > now) {
        pause_.expires_at(due_);
        pause_.async_wait([self = shared_from_this()](error_code) { self->read(); });
        return;
    }
    socket_.async_read(buffer_, [self = shared_from_this()](error_code error, std::size_t) {
        if (error.category() == websocket::make_error_code({}).category() && error != websocket::error::closed)
            ++self->tally_.malformed;
        if (error) return self->end();
        self->received();
    });
}

/// Passes the message that was read to the visitor's thread.
void Session::received() {
    const auto now = std::chrono::steady_clock::now();
    due_ = std::max(due_, now - credit) + between_messages;  // a token bucket: idle time counts up to `credit`
    ++tally_.messages;
    {
        const std::lock_guard lock(mutex_);
        message_ = socket_.got_text() ? boost::beast::buffers_to_string(buffer_.data())
                                      : std::string();  // a binary one counts as an empty message
    }
    changed_.notify_one();
    buffer_.consume(buffer_.size());
}

/// Sends the mailbox's next item, unless one is being sent, and continues until the mailbox is empty.
void Session::write() {
    if (sending_ || closing_ || ended_) return;
    sending_ = mailbox_.next();
    if (!sending_) {
        if (finishing_) leave();
        return;
    }
    socket_.binary(sending_->binary);
    socket_.async_write(net::buffer(sending_->bytes), [self = shared_from_this()](error_code error, std::size_t) {
        if (error) return self->end();
        if (self->sending_->binary) ++self->tally_.frames_sent;
        self->sending_.reset();
        self->write();
    });
}

void Session::finish() {
    if (finishing_) return;
    finishing_ = true;
    mailbox_.close(false);
    write();
}

/// Closes the WebSocket in order, with its closing handshake.
void Session::leave() {
    closing_ = true;
    socket_.async_close(websocket::close_code::try_again_later, [self = shared_from_this()](error_code) { self->end(); });
}

void Session::end() {
    if (ended_) return;
    ended_ = true;
    pause_.cancel();
    socket_.next_layer().close();
    mailbox_.close(true);
    {
        const std::lock_guard lock(mutex_);
        over_ = true;
    }
    changed_.notify_one();
    if (!visit_.joinable())  // no visitor's thread, which would call gone_
        post([](Session& s) {
            s.gone_();
            s.work_.reset();
        });
}

/// Runs the visitor's thread: makes the visitor, passes it messages, and destroys it when the session has ended.
void Session::visit(const Connect& connect) {
    std::unique_ptr<Visitor> visitor;
    try {
        visitor = connect(*this);
        while (const auto message = take()) {
            try {
                visitor->message(*message);
            } catch (const InputError& e) {
                malformed(e.what());
            }
            post([](Session& s) { s.read(); });
        }
    } catch (const std::exception& e) {
        const auto* const system = dynamic_cast<const std::system_error*>(&e);
        const bool threads = system && system->code() == std::errc::resource_unavailable_try_again;
        text(error_text(threads ? no_thread : e.what()));
        post([](Session& s) { s.finish(); });
    }
    while (take()) {  // until end() has been called
    }
    visitor.reset();  // on this thread: it may have to wait for work to stop
    post([](Session& s) {
        s.visit_.join();
        s.gone_();
        s.work_.reset();
    });
}

/// Waits for a message, on the visitor's thread; returns nothing when the session ends.
std::optional<std::string> Session::take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return over_ || message_; });
    if (over_) return std::nullopt;
    return std::exchange(message_, std::nullopt);
}

void Session::malformed(const std::string& what) {
    ++tally_.malformed;
    text(error_text(what));
    if (++malformed_ == most_malformed) post([](Session& s) { s.finish(); });
}

void Session::text(std::string json) {
    if (options_.without_hidden) json = options_.without_hidden(json);
    if (mailbox_.text(std::move(json)))
        post([](Session& s) { s.write(); });
    else
        post([](Session& s) { s.end(); });
}

void Session::frame(const std::string& lane, std::string bytes) {
    if (mailbox_.frame(lane, std::move(bytes))) ++tally_.frames_dropped;
    post([](Session& s) { s.write(); });
}

}  // namespace lfdsim::view
