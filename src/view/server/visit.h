// A browser's visit: passes its messages to the painter and to answer(). Floor 5.
#pragma once
#include "view/answers/library.h"
#include "view/painting/painter.h"
#include "view/server/server.h"

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace lfdsim::view {

/// A thread for plots, which take seconds. It answers one question at a time, always the newest; one that is replaced is stopped.
class Answerer {
  public:
    Answerer(const Library&, Panels&, Outbox&);
    ~Answerer();  // stops the work
    void ask(const Wanted&, const Ask&);

  private:
    void work();

    const Library& library_;
    Panels& panels_;
    Outbox& outbox_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<std::pair<Wanted, Ask>> next_;
    bool end_ = false;
    std::thread thread_;
};

/// One visitor: its last state, its painter and its thread for plots.
class Visit : public Visitor {
  public:
    /// Sends the message "hello". `version` is the program's. All references must outlive the visit.
    Visit(const Library&, Panels&, Outbox&, int threads, const std::string& version);
    void message(std::string_view text) override;

  private:
    void want(const Wanted&);

    const Library& library_;
    Panels& panels_;
    Outbox& outbox_;
    std::optional<Wanted> wanted_, sent_;  // sent_: the state of the last message "resolved"
    Painter painter_;
    Answerer plots_;
};

}  // namespace lfdsim::view
