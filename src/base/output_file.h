// Files that appear when they are complete, and checks whether files can be made. Floor 0.
#pragma once
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace lfdsim {

struct CloseFile {
    void operator()(std::FILE* stream) const { std::fclose(stream); }
};
using FileStream = std::unique_ptr<std::FILE, CloseFile>;

/// The destination of a file's content. Positions are bytes from its beginning.
class Output {
  public:
    virtual ~Output() = default;
    virtual std::string name() const = 0;  // for messages
    virtual void write(const void* data, std::size_t bytes) = 0;
    virtual void seek(std::int64_t position) = 0;
    virtual std::int64_t position() const = 0;
};

/// Returns PATH.partial-PID, the temporary name under which this process writes a file.
std::filesystem::path partial_name(const std::filesystem::path&);

/// A file written under its partial_name(), which commit() renames to PATH; without commit() the destructor removes it. Such files
/// that killed programs left of the same PATH are removed first. Throws InputError when the file cannot be made there,
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
    FileStream stream_;
    int error_ = 0;  // errno of the first failure
};

/// Writes a file of these bytes, or none if that fails. Throws like OutputFile.
void write_file(const std::filesystem::path&, std::string_view bytes);

/// Throws InputError unless a file can be made or replaced at `path`, as far as can be checked without writing.
void check_replaceable(const std::filesystem::path& path);

/// Removes the files NAME.partial-PID that killed programs have left of one file or, with an empty name, of any file in the folder:
/// those for which no process has that number and none, on another machine either, holds the file's lock.
void remove_abandoned(const std::filesystem::path& folder, const std::string& name);

/// Throws InputError unless files can be made in this folder, as far as can be checked without writing. The folder need not exist
/// if it can be made.
void check_folder(const std::filesystem::path& folder);

}  // namespace lfdsim
