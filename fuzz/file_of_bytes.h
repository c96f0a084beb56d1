// Bytes as a file, for readers that take its name.
#pragma once
#include <unistd.h>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace lfdsim {

/// A folder of this process's own that goes with it.
class FuzzFolder {
  public:
    ~FuzzFolder() { std::filesystem::remove_all(path_); }

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path put(const std::string& name, std::string_view bytes) const {
        std::ofstream(path_ / name, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
        return path_ / name;
    }

  private:
    std::filesystem::path path_ = std::filesystem::path("/dev/shm") / ("fuzz-" + std::to_string(getpid()));
    bool made_ = std::filesystem::create_directories(path_);
};

}  // namespace lfdsim
