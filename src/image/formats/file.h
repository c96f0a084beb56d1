// Input files of the image formats, with limits before memory is taken, and files that stay in memory. Internal to src/image. Floor
// 0.
#pragma once
#include "base/input_error.h"
#include "base/output_file.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

namespace lfdsim::detail {

/// A regular, non-empty file open for reading. Throws InputError that names it.
class InputFile {
  public:
    explicit InputFile(const std::filesystem::path& path);

    const std::string& name() const { return name_; }
    std::FILE* stream() const { return stream_.get(); }
    std::int64_t size() const { return size_; }

    /// Throws InputError that names the file.
    [[noreturn]] void refuse(const std::string& what) const { throw InputError(name_, what); }

    /// Refuses columns x rows pixels if they are none, 2^31 or more, or more than a file of this size can contain when each byte
    /// yields at most `pixels_per_byte`. It must be called before anything is allocated for them.
    void check_size(std::int64_t columns, std::int64_t rows, double pixels_per_byte) const;

  private:
    std::string name_;
    FileStream stream_;
    std::int64_t size_ = 0;
};

/// A file that stays in memory. Throws std::bad_alloc.
class OutputMemory : public Output {
  public:
    std::string name() const override { return "picture"; }
    void write(const void* data, std::size_t bytes) override;
    void seek(std::int64_t position) override { position_ = std::size_t(position); }
    std::int64_t position() const override { return std::int64_t(position_); }
    std::string take() { return std::move(bytes_); }  // all that was written

  private:
    std::string bytes_;
    std::size_t position_ = 0;
};

}  // namespace lfdsim::detail
