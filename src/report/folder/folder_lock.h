// A lock by which one run at a time writes to a folder. Floor 4.
#pragma once
#include <filesystem>

namespace lfdsim {

/// Holds a folder, which is made if it is missing, until it is destroyed or the program ends in any way. It leaves no file in the
/// folder, and removes the partial files that killed programs have left there.
class FolderLock {
  public:
    /// Throws InputError if another run holds the folder, or if it cannot be made.
    explicit FolderLock(const std::filesystem::path&);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

  private:
    int descriptor_ = -1;
};

}  // namespace lfdsim
