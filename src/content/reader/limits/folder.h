// Files a model may reach: those in its own folder and below, whatever paths it names.
#pragma once
#include <assimp/DefaultIOSystem.h>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim::reader {

class Folder : public Assimp::DefaultIOSystem {
  public:
    explicit Folder(const std::filesystem::path& model);

    bool Exists(const char* file) const override;
    Assimp::IOStream* Open(const char* file, const char* mode) override;

    /// The file that a name in the model refers to: inside the folder, links resolved; backslashes count as slashes, and a path
    /// that leads out of the folder (often one of the author's own machine) stands for the file of that name beside the model.
    /// Case is ignored where no exact match exists.
    std::optional<std::filesystem::path> find(std::string name) const;

    /// Gives the text of a file that is to be read in place of what it has; none of most.
    std::function<std::optional<std::string>(const std::string& file)> edited = [](const std::string&) { return std::nullopt; };

    /// The files that were opened for reading.
    const std::vector<std::string>& opened() const { return opened_; }

  private:
    bool inside(const std::filesystem::path&) const;
    std::filesystem::path model_, root_;
    std::vector<std::string> opened_;
    std::map<std::string, std::optional<std::string>> texts_;  // of the files that were asked for
};

}  // namespace lfdsim::reader
