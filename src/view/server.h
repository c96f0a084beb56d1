// HTTP and WebSocket on one port, by Boost.Beast. Floor 5. Knows nothing of displays.
#pragma once
#include "view/access.h"
#include "view/outbox.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lfdsim::view {

/// The program's side of one connection.
class Visitor {
  public:
    virtual ~Visitor() = default;  // the connection is gone; the outbox lives until this returns
    /// One text message, at most longest_message bytes of UTF-8. Called from the connection's thread; while it works, no further
    /// message of this connection is read and no other connection waits. It takes less than half of most_silence, since no pongs
    /// are read meanwhile. An InputError that it throws is answered with the message "error", and the hundredth ends the
    /// connection; any other exception does so at once.
    virtual void message(std::string_view text) = 0;
};

struct ServerOptions {
    std::string host = "127.0.0.1";  // address or name to listen on; access.h says by which names browsers may then call it
    int port = 0;                    // 0: any free one
    std::string token;               // of 128 random bits, in hexadecimal: make_token()
    int most_visitors = 8;
    std::chrono::seconds most_silence{120};  // of a browser, which is asked by a ping after half of it
};

/// Counted since the start; for tests and for the log.
struct ServerCounts {
    long visitors = 0, refused = 0, malformed = 0, messages = 0, frames_sent = 0, frames_dropped = 0;
};

class Server {
  public:
    /// Listens at once. `page` is the one page, sent at "/" with the token; `connect` is called for each WebSocket that is let in.
    /// Throws InputError if host or port cannot be had.
    Server(ServerOptions, std::string page, std::function<std::unique_ptr<Visitor>(Outbox&)> connect);
    ~Server();  // ends all connections

    int port() const;
    ServerCounts counts() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lfdsim::view
