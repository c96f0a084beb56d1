#include "content/models/reader_process.h"

#include "content/models/reader_path.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <string>
#include <system_error>

extern char** environ;

namespace lfdsim {
namespace {

std::string timeout_text(double seconds) { return fmt::format("reading it took more than {:g} s", seconds); }

}  // namespace

std::string too_large_text(const LoadOptions& options) {
    return fmt::format("it needs more than {} MiB, {}", options.bytes >> 20, options.whose);
}

ReaderProcess::ReaderProcess(const std::string& what, const std::filesystem::path& path, const LoadOptions& options)
    : options_(options), left_(options.bytes) {
    const std::string program = reader_path().string(), bytes = std::to_string(options.bytes),
                      seconds = fmt::format("{}", options.seconds);
    const std::string file = std::filesystem::canonical(path).string();
    const char* arguments[] = {program.c_str(), what.c_str(),       file.c_str(), bytes.c_str(),
                               seconds.c_str(), options.up.c_str(), nullptr};
    // The reader gets the pipe as standard output, and nothing else: no input, and no messages of libraries.
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category(), "pipe to the model reader");
    pipe_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    const int error = posix_spawn(&process_, program.c_str(), &actions, nullptr, const_cast<char**>(arguments), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (error != 0) {
        close(pipe_);
        throw std::system_error(error, std::generic_category(), "cannot start " + program);
    }
    deadline_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(std::int64_t(options.seconds * 1000));
}

ReaderProcess::~ReaderProcess() {
    close(pipe_);
    if (process_ > 0) {
        kill(process_, SIGKILL);
        while (waitpid(process_, nullptr, 0) < 0 && errno == EINTR) {
        }
    }
}

void ReaderProcess::get(char* to, std::size_t bytes) {
    left_ -= std::int64_t(bytes);
    if (left_ < 0) throw Failure(too_large_text(options_));
    while (bytes > 0) {
        const auto wait =
            std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - std::chrono::steady_clock::now()).count();
        pollfd ready{pipe_, POLLIN, 0};
        if (wait <= 0) throw Failure(timeout_text(options_.seconds));
        if (options_.job && options_.job->cancelled()) throw Failure("it was stopped");
        // 100 ms at most, so that cancelling takes effect
        if (poll(&ready, 1, int(std::min<std::int64_t>(wait, 100))) <= 0) continue;
        const ssize_t got = read(pipe_, to, bytes);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) fail();
        to += got;
        bytes -= std::size_t(got);
    }
}

std::size_t ReaderProcess::count(std::size_t size) {
    std::uint64_t n = 0;
    value(n);
    if (n > std::uint64_t(left_) / size) throw Failure(too_large_text(options_));
    return n;
}

// The pipe has ended early: the reader's exit status gives the reason. The reader limits its processor time, in proportion to the
// file's size, so that it may be ended before the time limit of the options.
void ReaderProcess::fail() {
    int status = 0;
    rusage used{};
    while (wait4(process_, &status, 0, &used) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
        const double seconds = std::round(double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                                          1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec));
        if (seconds >= options_.seconds) throw Failure(timeout_text(options_.seconds));
        throw Failure(
            fmt::format("reading it took more than {:g} s, too much for a file of its size; is it damaged? A program that opens it "
                        "can export it again, as .glb or .obj",
                        seconds));
    }
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) throw Failure("the reader was killed; perhaps memory ran out");
    // Sanitizers report a crash by an exit status.
    const std::string how = WIFSIGNALED(status)                             ? strsignal(WTERMSIG(status))
                            : WIFEXITED(status) && WEXITSTATUS(status) != 0 ? fmt::format("status {}", WEXITSTATUS(status))
                                                                            : "";
    if (!how.empty())
        throw Failure(
            fmt::format("it made the reader of its format crash ({}): it is damaged, or has something that the reader cannot "
                        "handle; save it in another format, such as glTF",
                        how));
    throw Failure("the reader ended early");
}

}  // namespace lfdsim
