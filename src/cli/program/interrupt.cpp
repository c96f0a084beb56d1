#include "cli/program/interrupt.h"

#include "base/output_file.h"
#include "cli/program/input_files.h"

#include <unistd.h>
#include <atomic>
#include <csignal>
#include <string>
#include <string_view>

namespace lfdsim::cli {
namespace {

// The handler reads these, so they are lock-free, and the text is complete before the pointer to it is set.
std::atomic<int> signals{0}, heeded{0};
std::atomic<const char*> partial_file{nullptr};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<const char*>::is_always_lock_free);

// A signal handler, which may make few calls only.
extern "C" void on_signal(int) {
    if (signals.fetch_add(1) == 0 && heeded > 0) return;
    if (const char* file = partial_file) unlink(file);
    constexpr std::string_view message = "lfdsim: warning: interrupted\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
    _exit(interrupted_exit);
}

}  // namespace

void catch_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // under nohup it remains ignored
    // A closed pipe and a file beyond `ulimit -f` are errors of writing, reported like any other.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
}

void guard_output(const std::filesystem::path& path) {
    refuse_input(path);
    static std::string text;
    partial_file = nullptr;
    text = partial_name(path).string();
    partial_file = text.c_str();
}

HeedSignals::HeedSignals() { ++heeded; }
HeedSignals::~HeedSignals() { --heeded; }

bool interrupted() { return signals > 0; }

}  // namespace lfdsim::cli
