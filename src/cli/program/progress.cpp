#include "cli/program/progress.h"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace lfdsim::cli {
namespace {

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

// Writes a text with one call, so that lines of several programs do not mix. A closed standard error is ignored.
void to_stderr(const std::string& text) { [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text.data(), text.size()); }

}  // namespace

Progress::Progress(const std::string& style) : style_(style) {
    if (style_ == "auto") style_ = isatty(STDERR_FILENO) ? "bar" : "lines";
}

Progress::~Progress() { end(); }

void Progress::stage(std::string_view name, std::int64_t units) {
    end();
    name_ = name;
    units_ = std::max<std::int64_t>(units, 1);
    done_ = 0;
    begun_ = shown_ = Clock::now();
    shown_tenths_ = 0;
}

// A thread that finds another one showing continues its work: the next report will count it.
void Progress::advance(std::int64_t units) {
    const std::int64_t done = done_ += units;
    if (style_ == "none") return;
    std::unique_lock lock(showing_, std::try_to_lock);
    if (lock) show(done, false);
}

void Progress::end() {
    if (!name_.empty() && style_ != "none") show(done_, true);
    name_.clear();
}

void Progress::show(std::int64_t done, bool last) {
    // Reports are some time apart: a bar moves smoothly, and lines in a log remain few, at most one for each tenth of the work.
    const Clock::time_point now = Clock::now();
    const double share = double(std::min(done, units_)) / double(units_), spent = seconds(now - begun_),
                 since = seconds(now - shown_);
    if (!last && since < (style_ == "bar" ? 0.1 : style_ == "json" ? 0.2 : 3)) return;
    const auto tenths = std::int64_t(share * 10);
    if (!last && style_ == "lines" && tenths == shown_tenths_) return;
    shown_ = now;
    shown_tenths_ = tenths;

    if (style_ == "json") {
        const nlohmann::ordered_json line{{"stage", name_}, {"done", done}, {"units", units_}, {"seconds", spent}};
        return to_stderr(line.dump() + "\n");
    }
    std::string time = fmt::format("{:.1f} s", spent);
    if (!last && share > 0.02) time = fmt::format("{:.0f} s left", spent / share * (1 - share));
    const auto percent = int(share * 100);
    if (style_ == "lines") return to_stderr(fmt::format("lfdsim: {}: {} %, {}\n", name_, percent, time));
    constexpr int width = 40;
    to_stderr(fmt::format("\r{:<18} [{:<{}}] {:3} %  {}\x1b[K{}", name_, std::string(std::size_t(share * width), '='), width,
                          percent, time, last ? "\n" : ""));
}

}  // namespace lfdsim::cli
