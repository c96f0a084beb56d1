// A visitor for tests: answers what it is told to.
#pragma once
#include "base/input_error.h"
#include "view/server/server.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>

namespace lfdsim::view {

/// What became of the visitors of one server.
struct Guests {
    std::atomic<int> made{0}, leaving{0}, destroyed{0}, at_work{0}, destroyed_at_work{0};
};

/// "texts N BYTES" and "frames N BYTES" send N of them, "sleep MS" works for a while, "linger MS" takes that
/// long to be destroyed, "malformed" is none, "throw" fails; anything
/// else comes back.
class Echo : public Visitor {
  public:
    Echo(Outbox& outbox, Guests& guests) : outbox_(outbox), guests_(guests) { ++guests_.made; }
    ~Echo() override {
        ++guests_.leaving;
        std::this_thread::sleep_for(std::chrono::milliseconds(linger_ms_));
        ++guests_.destroyed;
        if (working_) ++guests_.destroyed_at_work;
        outbox_.text("the outbox outlives the visitor");
    }
    void message(std::string_view text) override {
        working_ = true;
        ++guests_.at_work;
        const struct Done {
            Echo& echo;
            ~Done() {
                echo.working_ = false;
                --echo.guests_.at_work;
            }
        } done{*this};
        int count = 0, bytes = 0;
        const std::string copy(text);
        if (std::sscanf(copy.c_str(), "texts %d %d", &count, &bytes) == 2)
            for (int k = 0; k < count; ++k) outbox_.text(std::string(std::size_t(bytes), 't'));
        else if (std::sscanf(copy.c_str(), "frames %d %d", &count, &bytes) == 2)
            for (int k = 0; k < count; ++k) outbox_.frame("lane", std::to_string(k) + std::string(std::size_t(bytes), ' '));
        else if (std::sscanf(copy.c_str(), "sleep %d", &count) == 1)
            std::this_thread::sleep_for(std::chrono::milliseconds(count));
        else if (std::sscanf(copy.c_str(), "linger %d", &count) == 1)
            linger_ms_ = count;
        else if (text == "malformed" || text.empty())
            throw InputError("", "that is no \"message\"");
        else if (text == "throw")
            throw std::runtime_error("out of order");
        else
            outbox_.text(copy);
    }

  private:
    Outbox& outbox_;
    Guests& guests_;
    std::atomic<int> linger_ms_ = 0;
    std::atomic<bool> working_ = false;
};

}  // namespace lfdsim::view
