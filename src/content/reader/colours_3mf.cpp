#include "content/reader/colours_3mf.h"

#include <minizip/unzip.h>

#include <algorithm>
#include <memory>
#include <string>

namespace lfdsim::reader {
namespace {

// Returns the archive's current file, about 2^28 bytes of it at most.
std::string text_of_current(unzFile archive) {
    constexpr std::size_t most = std::size_t(1) << 28, step = std::size_t(1) << 16;
    std::string text;
    if (unzOpenCurrentFile(archive) != UNZ_OK) return text;
    for (int got = 1; got > 0 && text.size() < most;) {
        const std::size_t before = text.size();
        text.resize(before + step);
        got = unzReadCurrentFile(archive, text.data() + before, unsigned(step));
        text.resize(before + std::size_t(std::max(got, 0)));
    }
    unzCloseCurrentFile(archive);
    return text;
}

// Returns whether any element of a name has an attribute.
bool has_attribute(const std::string& text, const std::string& element, const std::string& attribute) {
    for (std::size_t at = text.find(element); at != std::string::npos; at = text.find(element, at + 1)) {
        const std::size_t found = text.find(attribute, at);
        if (found == std::string::npos) return false;
        if (found < text.find('>', at)) return true;
    }
    return false;
}

// Returns whether a file with base materials has an object with a mesh and without a material.
bool has_bare_mesh(const std::string& text) {
    if (text.find("<basematerials") == std::string::npos) return false;
    for (std::size_t at = text.find("<object "); at != std::string::npos; at = text.find("<object ", at + 1)) {
        const std::size_t mesh = text.find("<mesh", at), end = text.find("</object", at), pid = text.find(" pid=", at);
        if (mesh < end && pid > text.find('>', at)) return true;
    }
    return false;
}

}  // namespace

void note_3mf(const std::filesystem::path& file, NotShown& not_shown) {
    const std::unique_ptr<void, decltype(&unzClose)> archive(unzOpen(file.c_str()), &unzClose);
    if (!archive) return;
    for (int more = unzGoToFirstFile(archive.get()); more == UNZ_OK; more = unzGoToNextFile(archive.get())) {
        char name[512] = "";
        unz_file_info about;
        unzGetCurrentFileInfo(archive.get(), &about, name, sizeof name - 1, nullptr, 0, nullptr, 0);
        if (!std::string(name).ends_with(".model")) continue;
        const std::string text = text_of_current(archive.get());
        if (text.find(":colorgroup") != std::string::npos || text.find("<colorgroup") != std::string::npos)
            not_shown.add("colours of 3MF colour groups");
        if (has_attribute(text, "<triangle ", " pid=")) not_shown.add("materials of single triangles of 3MF");
        if (has_bare_mesh(text)) not_shown.add("missing materials of 3MF objects (they get the file's first)");
        if (has_attribute(text, "<component ", ":path=")) not_shown.add("parts in other files of a 3MF archive");
    }
}

}  // namespace lfdsim::reader
