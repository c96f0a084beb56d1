// One WebSocket: messages in, mail out. Floor 5.
#pragma once
#include "view/http.h"
#include "view/mailbox.h"
#include "view/outbox.h"
#include "view/server.h"

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

/// ServerCounts, counted by several threads.
struct Tally {
    std::atomic<long> visitors{0}, refused{0}, malformed{0}, messages{0}, frames_sent{0}, frames_dropped{0};
};

/// Two threads share a session. The network thread, one for all sessions, does all reading and writing and never waits for a
/// visitor. A thread of the session's own makes the visitor, hands it the message that was read, and destroys it; only when that
/// message has been dealt with, and not before `due_`, is the next one read. What the visitor sends goes into the mailbox, from
/// which the network thread writes whenever the last piece has been taken (post() is how the one thread calls the other). A session
/// lives until the last handler that holds it is done.
class Session : public Outbox, public std::enable_shared_from_this<Session> {
  public:
    using Connect = std::function<std::unique_ptr<Visitor>(Outbox&)>;

    /// `gone` is called once, on the network thread, when the visitor is no more and nothing waits for it.
    Session(boost::beast::tcp_stream, std::chrono::seconds most_silence, Tally&, std::function<void()> gone);

    // Of the network thread.
    void welcome(const Request&, Connect);
    void turn_away(const Request&, const std::string& why);
    void end();  // at once

    void text(std::string json) override;
    void frame(const std::string& lane, std::string bytes) override;
    bool busy(const std::string& lane) const override { return mailbox_.busy(lane); }

  private:
    void accept(const Request&, std::function<void()> then);
    void read();
    void received();
    void write();
    void finish();  // when what waits has been sent
    void leave();
    void visit(const Connect&);
    std::optional<std::string> take();
    void malformed(const std::string& what);
    template <class Work>
    void post(Work);

    boost::beast::websocket::stream<boost::beast::tcp_stream, false> socket_;  // pictures are compressed already
    boost::asio::executor_work_guard<boost::beast::tcp_stream::executor_type> work_;
    const std::chrono::seconds most_silence_;
    Tally& tally_;
    const std::function<void()> gone_;
    Mailbox mailbox_;
    std::thread visit_;

    // Of the network thread.
    boost::beast::flat_buffer buffer_;
    boost::asio::steady_timer pause_;
    std::chrono::steady_clock::time_point due_{};  // when the next message may be read
    std::optional<Mailbox::Item> sending_;
    bool finishing_ = false, closing_ = false, ended_ = false;

    int malformed_ = 0;  // of the visitor's thread

    std::mutex mutex_;  // of the two below
    std::condition_variable changed_;
    std::optional<std::string> message_;
    bool over_ = false;
};

}  // namespace lfdsim::view
