#include "image/formats/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <system_error>

namespace lfdsim::detail {
namespace fs = std::filesystem;

InputFile::InputFile(const fs::path& path) : name_(path.string()) {
    // O_NONBLOCK: opening a FIFO that nobody writes to must not hang; regular files ignore it.
    const int descriptor = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor < 0) refuse(fmt::format("cannot be read: {}", std::generic_category().message(errno)));
    stream_.reset(fdopen(descriptor, "rb"));
    if (!stream_) {
        close(descriptor);
        throw std::bad_alloc();
    }
    struct stat status {};
    if (fstat(descriptor, &status) != 0) refuse(fmt::format("cannot be read: {}", std::generic_category().message(errno)));
    if (S_ISDIR(status.st_mode)) refuse("is a folder; an image file is needed");
    if (!S_ISREG(status.st_mode)) refuse("is not a regular file; save the image in one");
    if (status.st_size == 0) refuse("is empty");
    size_ = status.st_size;
}

void InputFile::check_size(std::int64_t columns, std::int64_t rows, double pixels_per_byte) const {
    const double pixels = double(columns) * double(rows);
    if (columns < 1 || rows < 1) refuse(fmt::format("has no pixels ({} x {})", columns, rows));
    if (pixels >= 0x1p31) refuse(fmt::format("is too large: {} x {} pixels; fewer than 2^31 are allowed", columns, rows));
    if (pixels > pixels_per_byte * double(size_))
        refuse(fmt::format("is damaged: it claims {} x {} pixels, more than its {} bytes can hold", columns, rows, size_));
}

void OutputMemory::write(const void* data, std::size_t bytes) {
    const char* const from = static_cast<const char*>(data);
    if (position_ + bytes > bytes_.size()) bytes_.resize(position_ + bytes);
    std::copy_n(from, bytes, bytes_.data() + position_);
    position_ += bytes;
}

}  // namespace lfdsim::detail
