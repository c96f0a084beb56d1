#include "report/folder/folder_lock.h"

#include "base/input_error.h"
#include "base/output_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <system_error>

namespace lfdsim {

FolderLock::FolderLock(const std::filesystem::path& folder) {
    check_folder(folder);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    descriptor_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor_ < 0)
        throw InputError(folder.string(), "cannot be made: " + std::generic_category().message(error ? error.value() : errno));
    // File systems without locks return other errors: there, runs are not kept apart.
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        close(descriptor_);
        throw InputError(folder.string(), "another run is writing its results there; wait until it ends, or give another folder");
    }
    remove_abandoned(folder, {});
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace lfdsim
