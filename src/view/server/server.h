// HTTP and WebSocket on one port, with Boost.Beast. Floor 5. Independent of displays.
#pragma once
#include "view/server/outbox.h"

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace lfdsim::view {

/// The program's side of one connection. It is destroyed when the connection has ended; the outbox exists until then.
class Visitor {
  public:
    virtual ~Visitor() = default;
    /// Takes one text message, at most longest_message bytes. It is called on the connection's thread; until it returns, no further
    /// message of this connection is read, and other connections do not wait. It must return within half of most_silence, since no
    /// pongs are read meanwhile. An InputError that it throws is answered with the message "error", and the hundredth ends the
    /// connection; any other exception ends it at once.
    virtual void message(std::string_view text) = 0;
};

struct ServerOptions {
    std::string host = "127.0.0.1";  // address or name to listen on; access.h: the names under which browsers may then reach it
    int port = 0;                    // 0: any free one
    std::string token;               // of 128 random bits, in hexadecimal: make_token()
    int most_visitors = 8;
    std::chrono::seconds most_silence{120};  // of a browser; after half of it a ping is sent
    // Returns the text that is sent in place of a text; it hides what visitors may not know (hidden_paths.h). Empty: texts are not
    // changed.
    std::function<std::string(const std::string&)> without_hidden = {};
};

/// Counts since the start, for tests and the log. `refused`: requests by access.h and visitors above most_visitors.
struct ServerCounts {
    long visitors = 0, refused = 0, malformed = 0, messages = 0, frames_sent = 0, frames_dropped = 0;
};

/// A server that runs on a separate thread until it is destroyed, which ends all connections.
class Server {
  public:
    /// Begins to listen. `page` is the only page, served at "/" with the token; `connect` is called for each WebSocket that is
    /// accepted, on the connection's thread. Throws InputError if host or port is not available.
    Server(ServerOptions, std::string page, std::function<std::unique_ptr<Visitor>(Outbox&)> connect);
    ~Server();

    /// Returns the port that it listens on.
    int port() const;
    ServerCounts counts() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace lfdsim::view
