#include "view/answers/save.h"

#include "base/input_error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <system_error>

namespace lfdsim::view {
namespace {

/// A hidden file beside the one that is to be made. The destructor removes it.
class TemporaryFile {
  public:
    explicit TemporaryFile(const std::filesystem::path& path) {
        static std::atomic<int> count = 0;  // several visitors may save at once
        path_ = path.parent_path() / fmt::format(".{}.{}-{}", path.filename().string(), getpid(), ++count);
        descriptor_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ < 0) fail(path);
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) close(descriptor_);
        unlink(path_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write(const std::string& text) {
        for (std::size_t done = 0; done < text.size();) {
            const ssize_t n = ::write(descriptor_, text.data() + done, text.size() - done);
            if (n < 0 && errno != EINTR) fail(path_);
            if (n > 0) done += std::size_t(n);
        }
        if (fsync(descriptor_) != 0) fail(path_);
    }
    /// Gives the file its final name. Where nothing may be overwritten, link() is used, which never replaces a file that was made
    /// in the meantime.
    void become(const std::filesystem::path& path, bool overwrite) {
        const int failed = overwrite ? rename(path_.c_str(), path.c_str()) : link(path_.c_str(), path.c_str());
        if (failed && errno == EEXIST)
            throw InputError(path.filename().string(), "exists already; choose another name, or overwrite it");
        if (failed) fail(path);
    }

  private:
    [[noreturn]] static void fail(const std::filesystem::path& path) {
        throw std::runtime_error(
            fmt::format("{}: cannot be written: {}", path.filename().string(), std::generic_category().message(errno)));
    }

    std::filesystem::path path_;
    int descriptor_ = -1;
};

}  // namespace

void save_text(const std::filesystem::path& path, const std::string& text, bool overwrite) {
    TemporaryFile file(path);
    file.write(text);
    file.become(path, overwrite);
}

}  // namespace lfdsim::view
