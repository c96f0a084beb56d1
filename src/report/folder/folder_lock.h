// A folder that one run at a time writes to. Floor 4.
#pragma once
#include <filesystem>

namespace lfdsim {

/// Holds a folder, which is made if it is missing, until it goes or the program ends in any way. Leaves nothing in it, and removes
/// what programs that were killed have left there of files that they were writing.
class FolderLock {
  public:
    /// Throws InputError if another run holds the folder, or if it is none and cannot be made one.
    explicit FolderLock(const std::filesystem::path&);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int descriptor_ = -1;
};

}  // namespace lfdsim
