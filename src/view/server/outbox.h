// The interface by which a visitor's threads send messages to its browser. Floor 5.
#pragma once
#include <string>

namespace lfdsim::view {

/// The outbox of one connection. May be called from any thread; calls never wait for the network.
class Outbox {
  public:
    virtual ~Outbox() = default;
    /// Sends a JSON text. Texts that have not been sent yet wait in order; more than 256 of them, or 4 MiB, end the connection.
    virtual void text(std::string json) = 0;
    /// Sends a binary message. It replaces a message of the same lane that has not been sent yet, so frames never queue.
    virtual void frame(const std::string& lane, std::string bytes) = 0;
    /// Whether a frame of a lane is being sent or waits; if so, the next one need not be made yet.
    virtual bool busy(const std::string& lane) const = 0;
};

}  // namespace lfdsim::view
