// A WebSocket connection: messages to a visitor, texts and frames from it. Floor 5.
#pragma once
#include "view/server/http.h"
#include "view/server/mailbox.h"
#include "view/server/outbox.h"
#include "view/server/server.h"

#include <atomic>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace lfdsim::view {

/// ServerCounts, incremented by several threads.
struct Tally {
    std::atomic<long> visitors{0}, refused{0}, malformed{0}, messages{0}, frames_sent{0}, frames_dropped{0};
};

/// A session is shared by two threads:
/// - The network thread, one for all sessions, does all reading and writing and never waits for a visitor.
/// - The session's thread, visit(), makes the visitor, passes it each message, and destroys it.
///
/// Messages: read() -> received() puts one into message_ -> take() gives it to the visitor -> read() again, when the visitor has
/// returned and not before due_, which limits the rate. So there is never more than one message waiting.
/// Mail: text() and frame(), called by any thread, fill the mailbox and post() write() to the network thread, which sends one item
/// at a time, each when the one before has been sent.
/// End: end() closes the connection at once, finish() after the waiting texts have been sent. Both let take() return nothing, so
/// that visit() ends; gone_ is then called.
/// Handlers hold a shared pointer, so a session exists until its last handler is done.
class Session : public Outbox, public std::enable_shared_from_this<Session> {
  public:
    using Connect = std::function<std::unique_ptr<Visitor>(Outbox&)>;

    /// `gone` is called once, on the network thread, after the visitor has been destroyed. The options must outlive the session.
    Session(boost::beast::tcp_stream, const ServerOptions&, Tally&, std::function<void()> gone);

    // These are called on the network thread.
    void welcome(const Request&, Connect);                   // accepts the WebSocket and starts the visitor's thread
    void turn_away(const Request&, const std::string& why);  // accepts it, sends the message "error" with `why`, and closes it
    void end();                                              // closes the connection at once

    void text(std::string json) override;
    void frame(const std::string& lane, std::string bytes) override;
    bool busy(const std::string& lane) const override { return mailbox_.busy(lane); }

  private:
    void accept(const Request&, std::function<void()> then);
    void read();
    void received();
    void write();
    void finish();  // closes the connection when the waiting texts have been sent
    void leave();
    void visit(const Connect&);
    std::optional<std::string> take();
    void malformed(const std::string& what);
    template <class Work>
    void post(Work);

    boost::beast::websocket::stream<boost::beast::tcp_stream, false> socket_;  // false: no compression, which pictures have already
    boost::asio::executor_work_guard<boost::beast::tcp_stream::executor_type> work_;
    const ServerOptions& options_;
    Tally& tally_;
    const std::function<void()> gone_;
    Mailbox mailbox_;
    std::thread visit_;

    // Used only by the network thread.
    boost::beast::flat_buffer buffer_;
    boost::asio::steady_timer pause_;
    std::chrono::steady_clock::time_point due_{};  // when the next message may be read
    std::optional<Mailbox::QueuedMessage> sending_;
    bool finishing_ = false, closing_ = false, ended_ = false;

    int malformed_ = 0;  // used only by the visitor's thread

    std::mutex mutex_;  // protects message_ and over_
    std::condition_variable changed_;
    std::optional<std::string> message_;
    bool over_ = false;
};

}  // namespace lfdsim::view
