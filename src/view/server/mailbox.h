// The messages that wait to be sent to one browser: texts in order, of frames only the newest. Floor 5. All calls from any thread.
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

/// A lane is a sequence of frames of which a newer one replaces those before it, such as the left eye's pictures.
class Mailbox {
  public:
    /// A text or a frame to be sent.
    struct QueuedMessage {
        std::string bytes;
        bool binary;
    };
    /// Adds a text. Returns false if more texts or bytes wait than the limits above; the box is then emptied and closed.
    bool text(std::string);
    /// Adds a frame. Returns true if it replaced one that waited in the same lane. Lanes are sent in the order in which they began
    /// to wait.
    bool frame(const std::string& lane, std::string bytes);
    /// Whether a frame of the lane waits, or is the item that next() returned last.
    bool busy(const std::string& lane) const;
    /// Removes and returns the next message to send, texts first; nothing if the box is empty. It is called when the previous item
    /// has been sent.
    std::optional<QueuedMessage> next();
    /// Accepts no more frames and drops those that wait; with `texts`, also texts.
    void close(bool texts);

  private:
    mutable std::mutex mutex_;
    std::deque<std::string> texts_;
    std::size_t text_bytes_ = 0;
    std::vector<std::pair<std::string, std::string>> frames_;  // lane, bytes
    std::optional<std::string> sending_;                       // lane of the frame that next() returned last
    bool takes_texts_ = true, takes_frames_ = true;
};

}  // namespace lfdsim::view
