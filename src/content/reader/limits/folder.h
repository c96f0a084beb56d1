// Files that a model may read: those in its folder and below, whatever paths it names.
#pragma once
#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::reader {

/// Assimp's access to files, which opens nothing outside of the model's folder and nothing for writing.
class Folder : public Assimp::DefaultIOSystem {
  public:
    explicit Folder(const std::filesystem::path& model);

    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// Returns the file that a name in the model refers to, if it is inside the folder even after links are resolved: backslashes
    /// count as slashes; a path that leads out of the folder (often one of the author's machine) means the file of that name
    /// beside the model; case is ignored if there is no exact match. Nothing if there is none.
    std::optional<std::filesystem::path> find(std::string name) const;

    /// A function that returns the text to be read in place of a file's; nothing for most files.
    std::function<std::optional<std::string>(const std::string& file)> edited = [](const std::string&) { return std::nullopt; };

    /// Returns the files that were opened for reading.
    const std::vector<std::string>& opened() const { return opened_; }

  private:
    bool inside(const std::filesystem::path&) const;
    std::filesystem::path model_, root_;
    std::vector<std::string> opened_;
    std::map<std::string, std::optional<std::string>> texts_;  // of the files that were asked for
};

}  // namespace lfdsim::reader
