#include "cli/output/temporary_folder.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <string>
#include <system_error>

// A separate process waits until the program's end of a pipe closes, which the system does however the program ends, and then
// removes the folder.
namespace lfdsim::cli {
namespace {

[[noreturn]] void fail(const std::string& what) { throw std::system_error(errno, std::generic_category(), what); }

// Runs in the separate process. After fork() in a program with threads, only calls that are safe in a signal handler are allowed.
[[noreturn]] void clean_up(const char* folder, int needed, int alive) {
    setsid();  // so that Ctrl-C reaches the program only
    close(alive);
    char byte;
    while (read(needed, &byte, 1) < 0 && errno == EINTR) {
    }
    execl("/bin/rm", "rm", "-rf", "--", folder, nullptr);
    _exit(1);
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lfdsim-XXXXXX").string();
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) fail("pipe");
    if (mkdtemp(name.data()) == nullptr) {
        const std::error_code error(errno, std::generic_category());
        close(ends[0]);
        close(ends[1]);
        throw std::system_error(error, name + ": cannot be made");
    }
    janitor_ = fork();
    if (janitor_ == 0) clean_up(name.c_str(), ends[0], ends[1]);
    const std::error_code error(errno, std::generic_category());
    close(ends[0]);
    alive_ = ends[1];
    path_ = name;
    if (janitor_ < 0) {
        close(alive_);
        std::filesystem::remove(path_);
        throw std::system_error(error, "fork");
    }
}

TemporaryFolder::~TemporaryFolder() {
    close(alive_);
    while (waitpid(janitor_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

}  // namespace lfdsim::cli
