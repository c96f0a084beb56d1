// What waits for one browser. Floor 5. All calls from any thread.
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
    struct Item {
        std::string bytes;
        bool binary;
    };
    /// False: more texts wait than outbox.h allows; the box is empty and closed then.
    bool text(std::string);
    /// True: it took the place of one that waited in the same lane. The newest of each lane waits, lanes in the order of their
    /// first.
    bool frame(const std::string& lane, std::string bytes);
    /// One of the lane waits, or is the item that next() gave last.
    bool busy(const std::string& lane) const;
    /// What to send now, texts first; the item before has been sent. Nothing: the box is empty.
    std::optional<Item> next();
    /// Takes no more frames and drops those that wait; with `texts`, texts too.
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
