#include "base/output_file.h"

#include "base/input_error.h"
#include "base/whole_text.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace lfdsim {
namespace fs = std::filesystem;
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

constexpr std::string_view partial_mark = ".partial-";

// Returns the file and the process in a name NAME.partial-PID; process 0 for any other name.
std::pair<std::string_view, pid_t> partial(std::string_view name) {
    const std::size_t mark = name.rfind(partial_mark);
    if (mark == name.npos || mark == 0) return {};
    const pid_t process = whole_text<pid_t>(name.substr(mark + partial_mark.size())).value_or(0);
    return process > 0 ? std::pair(name.substr(0, mark), process) : std::pair<std::string_view, pid_t>();
}

// Whether a process is writing a file: it holds the file's lock, which the system releases however that process ends. A file that
// cannot be opened counts as held.
bool is_held(const fs::path& path) {
    const int descriptor = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) return true;
    const bool held = flock(descriptor, LOCK_EX | LOCK_NB) != 0;
    close(descriptor);
    return held;
}

}  // namespace

fs::path partial_name(const fs::path& path) { return fmt::format("{}{}{}", path.string(), partial_mark, getpid()); }

OutputFile::OutputFile(const fs::path& path) : path_(path), partial_(partial_name(path)) {
    check_replaceable(path);
    remove_abandoned(folder_of(path), path.filename());
    const int descriptor = open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        // A full disk or table of files is no fault of the name.
        if (errno == ENOSPC || errno == EDQUOT || errno == EIO || errno == EMFILE || errno == ENFILE) fail(errno);
        throw InputError(path.string(), fmt::format("cannot be written: {}", reason(errno)));
    }
    static_cast<void>(flock(descriptor, LOCK_EX | LOCK_NB));  // for remove_abandoned(); some file systems know no locks
    stream_.reset(fdopen(descriptor, "wb"));
    if (stream_) return;
    close(descriptor);
    unlink(partial_.c_str());
    throw std::bad_alloc();
}

OutputFile::~OutputFile() {
    if (partial_.empty()) return;
    stream_.reset();
    unlink(partial_.c_str());
}

void OutputFile::fail(int error) {
    error_ = error;
    throw std::runtime_error(fmt::format("{}: cannot be written: {}", name(), reason(error)));
}

void OutputFile::write(const void* data, std::size_t bytes) {
    if (std::fwrite(data, 1, bytes, stream_.get()) != bytes) fail(errno);
}

void OutputFile::seek(std::int64_t position) {
    if (fseeko(stream_.get(), position, SEEK_SET) != 0) fail(errno);
}

std::int64_t OutputFile::position() const { return ftello(stream_.get()); }

void OutputFile::commit() {
    if (error_ != 0) fail(error_);  // OpenEXR's destructor swallows exceptions
    if (std::fclose(stream_.release()) != 0 || rename(partial_.c_str(), path_.c_str()) != 0) fail(errno);
    partial_.clear();
}

void write_file(const fs::path& path, std::string_view bytes) {
    OutputFile file(path);
    file.write(bytes.data(), bytes.size());
    file.commit();
}

void check_replaceable(const fs::path& path) {
    const fs::path folder = folder_of(path);
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) throw InputError(path.string(), "is a folder; give the name of a file");
    if (fs::exists(status) && !fs::is_regular_file(status)) throw InputError(path.string(), "exists and is not a regular file");
    if (fs::exists(folder, error) && !fs::is_directory(folder, error))
        throw InputError(path.string(), fmt::format("{} is not a folder", folder.string()));
    if (!fs::is_directory(folder, error))
        throw InputError(path.string(), fmt::format("the folder {} does not exist; make it first", folder.string()));
    if (faccessat(AT_FDCWD, folder.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
        throw InputError(path.string(), fmt::format("the folder {} cannot be written: {}", folder.string(), reason(errno)));
}

void remove_abandoned(const fs::path& folder, const std::string& name) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const std::string there = entry.path().filename();
        const auto [file, process] = partial(there);
        if (process == 0 || (!name.empty() && file != name) || !fs::is_regular_file(entry.symlink_status(none))) continue;
        if (kill(process, 0) != 0 && errno == ESRCH && !is_held(entry.path())) fs::remove(entry.path(), none);
    }
}

void check_folder(const fs::path& folder) {
    std::error_code error;
    fs::path there = fs::absolute(folder);
    while (!fs::exists(there, error) && there != there.parent_path()) there = there.parent_path();
    if (!fs::is_directory(there, error)) {
        const std::string own = there == fs::absolute(folder) ? "is" : fmt::format("cannot be made: {} is", there.string());
        throw InputError(folder.string(), own + " not a folder; give another one");
    }
    if (faccessat(AT_FDCWD, there.c_str(), W_OK | X_OK, AT_EACCESS) != 0)
        throw InputError(folder.string(), fmt::format("the folder {} cannot be written: {}", there.string(), reason(errno)));
}

}  // namespace lfdsim
