#include "view/server/mailbox.h"

#include <algorithm>

namespace lfdsim::view {

bool Mailbox::text(std::string json) {
    const std::lock_guard lock(mutex_);
    if (!takes_texts_) return true;
    if (texts_.size() >= most_texts_waiting || text_bytes_ + json.size() > most_text_bytes_waiting) {
        takes_texts_ = takes_frames_ = false;
        texts_.clear();
        frames_.clear();
        return false;
    }
    text_bytes_ += json.size();
    texts_.push_back(std::move(json));
    return true;
}

bool Mailbox::frame(const std::string& lane, std::string bytes) {
    const std::lock_guard lock(mutex_);
    if (!takes_frames_) return false;
    for (auto& [name, waiting] : frames_)
        if (name == lane) {
            waiting = std::move(bytes);
            return true;
        }
    frames_.emplace_back(lane, std::move(bytes));
    return false;
}

bool Mailbox::busy(const std::string& lane) const {
    const std::lock_guard lock(mutex_);
    return sending_ == lane || std::any_of(frames_.begin(), frames_.end(), [&](const auto& f) { return f.first == lane; });
}

std::optional<Mailbox::QueuedMessage> Mailbox::next() {
    const std::lock_guard lock(mutex_);
    sending_.reset();
    if (!texts_.empty()) {
        QueuedMessage item{std::move(texts_.front()), false};
        texts_.pop_front();
        text_bytes_ -= item.bytes.size();
        return item;
    }
    if (frames_.empty()) return std::nullopt;
    sending_ = std::move(frames_.front().first);
    QueuedMessage item{std::move(frames_.front().second), true};
    frames_.erase(frames_.begin());
    return item;
}

void Mailbox::close(bool texts) {
    const std::lock_guard lock(mutex_);
    takes_frames_ = false;
    frames_.clear();
    if (!texts) return;
    takes_texts_ = false;
    texts_.clear();
}

}  // namespace lfdsim::view
