// Input and output files for the image formats: limits before memory is taken, and outputs that appear when they are complete.
// Internal to src/image. Floor 0.
#pragma once
#include "base/input_error.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

namespace lfdsim::detail {

struct Close {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, Close>;

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
    Stream stream_;
    std::int64_t size_ = 0;
};

/// The destination of an image. Positions are bytes from its beginning.
class Output {
  public:
    virtual ~Output() = default;
    virtual std::string name() const = 0;  // for messages
    virtual void write(const void* data, std::size_t bytes) = 0;
    virtual void seek(std::int64_t position) = 0;
    virtual std::int64_t position() const = 0;
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

/// A file written as PATH.partial-PID, which commit() renames to PATH; without commit() the destructor removes it. Such files that
/// killed programs left of the same PATH are removed first. Throws InputError when the file cannot be made there,
/// std::runtime_error when writing fails (disk full).
class OutputFile : public Output {
  public:
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile() override;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    std::string name() const override { return path_.string(); }
    void write(const void* data, std::size_t bytes) override;
    void seek(std::int64_t position) override;
    std::int64_t position() const override;
    void commit();

  private:
    [[noreturn]] void fail(int error);

    std::filesystem::path path_, partial_;
    Stream stream_;
    int error_ = 0;  // errno of the first failure
};

/// Throws InputError unless a file can be made or replaced at `path`, as far as can be checked without writing.
void check_replaceable(const std::filesystem::path& path);

/// Removes the files NAME.partial-PID that killed programs have left of one file or, with an empty name, of any file in the folder:
/// those for which no process has that number and none, on another machine either, holds the file's lock.
void remove_abandoned(const std::filesystem::path& folder, const std::string& name);

/// Throws InputError unless files can be made in this folder, as far as can be checked without writing. The folder need not exist
/// if it can be made.
void check_folder(const std::filesystem::path& folder);

}  // namespace lfdsim::detail
