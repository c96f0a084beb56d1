// Where what a browser is to be told waits until its connection takes it. Floor 5.
#pragma once
#include <string>

namespace lfdsim::view {

/// Of one connection. Calls come from any thread and never wait for the network.
class Outbox {
  public:
    virtual ~Outbox() = default;
    /// A JSON text. Those that the browser has not taken wait in order; more than 256 of them, or 4 MiB, end the connection.
    virtual void text(std::string json) = 0;
    /// A binary message. One of the same lane that has not been sent yet is dropped for it: never a queue of frames.
    virtual void frame(const std::string& lane, std::string bytes) = 0;
    /// The frame of that lane is on its way or waits: making the next one would be in vain.
    virtual bool busy(const std::string& lane) const = 0;
};

}  // namespace lfdsim::view
