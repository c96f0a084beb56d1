// Files that must not outlive the program. Floor 5.
#pragma once
#include <sys/types.h>
#include <filesystem>

namespace lfdsim::cli {

/// A new folder that goes, with all in it, when this object does, or when the program ends in any other way: by a signal too, even
/// one that it cannot catch.
class TemporaryFolder {
  public:
    /// Throws std::system_error.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int alive_ = -1;  // the pipe's end that says, by being open, that the folder is needed
    pid_t janitor_ = -1;
};

}  // namespace lfdsim::cli
