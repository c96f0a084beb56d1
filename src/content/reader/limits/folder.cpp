#include "content/reader/limits/folder.h"

#include "content/reader/limits/limits.h"

#include <assimp/MemoryIOWrapper.h>
#include <strings.h>
#include <algorithm>
#include <cstring>

namespace lfdsim::reader {
namespace fs = std::filesystem;

Folder::Folder(const fs::path& model) : model_(fs::weakly_canonical(fs::absolute(model))), root_(model_.parent_path()) {}

bool Folder::inside(const fs::path& file) const {
    std::error_code error;
    const fs::path real = fs::weakly_canonical(file, error);
    return !error && std::mismatch(root_.begin(), root_.end(), real.begin(), real.end()).first == root_.end();
}

bool Folder::Exists(const char* file) const { return inside(fs::absolute(file)) && fs::is_regular_file(fs::status(file)); }

// Opens regular files only: a pipe or device that a model names would never end.
Assimp::IOStream* Folder::Open(const char* file, const char* mode) {
    if (std::strchr(mode, 'w') || std::strchr(mode, 'a') || !Exists(file)) return nullptr;
    opened_.push_back(fs::absolute(file).string());
    if (fs::weakly_canonical(opened_.back()) != model_) allow_for(file);
    const auto [text, fresh] = texts_.try_emplace(opened_.back());
    if (fresh) text->second = edited(opened_.back());
    if (text->second)
        return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(text->second->data()), text->second->size());
    return DefaultIOSystem::Open(file, mode);
}

std::optional<fs::path> Folder::find(std::string name) const {
    std::replace(name.begin(), name.end(), '\\', '/');
    const fs::path given(name);
    for (const fs::path& candidate : {root_ / given, root_ / given.filename()}) {
        std::error_code error;
        if (!inside(candidate)) continue;
        if (fs::is_regular_file(candidate, error)) return candidate;
        for (const fs::directory_entry& entry : fs::directory_iterator(candidate.parent_path(), error)) {
            if (entry.is_regular_file(error) && strcasecmp(entry.path().filename().c_str(), candidate.filename().c_str()) == 0 &&
                inside(entry.path()))
                return entry.path();
        }
    }
    return {};
}

}  // namespace lfdsim::reader
