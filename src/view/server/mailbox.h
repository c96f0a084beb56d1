// The messages that wait to be sent to one browser. Floor 5. All calls from any thread.
#pragma once
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace lfdsim::view {

inline constexpr std::size_t most_texts_waiting = 256, most_text_bytes_waiting = 4 << 20;

class Mailbox {
  public:
    /// A text or a frame to be sent.
    struct QueuedMessage {
        std::string bytes;
        bool binary;
    };
    /// Returns false if more texts wait than outbox.h allows; the box is then emptied and closed.
    bool text(std::string);
    /// Returns true if it replaced one that waited in the same lane. Only the newest of each lane waits; lanes are in the order in
    /// which they began to wait.
    bool frame(const std::string& lane, std::string bytes);
    /// Whether one of the lane waits, or is the item that next() returned last.
    bool busy(const std::string& lane) const;
    /// The next message to send, texts first; to be called when the last item has been sent. Nothing: the box is empty.
    std::optional<QueuedMessage> next();
    /// Accepts no more frames and drops those that wait; with `texts`, also texts.
    void close(bool texts);

  private:
    mutable std::mutex mutex_;
    std::deque<std::string> texts_;
    std::size_t text_bytes_ = 0;
    std::vector<std::pair<std::string, std::string>> frames_;  // lane, bytes
    std::optional<std::string> sending_;                       // its lane
    bool takes_texts_ = true, takes_frames_ = true;
};

}  // namespace lfdsim::view
