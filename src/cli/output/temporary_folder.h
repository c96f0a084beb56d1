// A folder for files that must not remain when the program has ended. Floor 5.
#pragma once
#include <sys/types.h>
#include <filesystem>

namespace lfdsim::cli {

/// A new folder that is removed, with its files, when this object is destroyed or the program ends in any way, even by a signal
/// that it cannot catch.
class TemporaryFolder {
  public:
    /// Makes the folder. Throws std::system_error.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    int alive_ = -1;      // end of a pipe: while it is open, the folder is needed
    pid_t janitor_ = -1;  // the process that removes the folder
};

}  // namespace lfdsim::cli
