#include "content/reader/colours_3mf.h"

#include "base/whole_text.h"
#include "content/reader/repairs.h"

#include <minizip/unzip.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

namespace lfdsim::reader {
namespace {

constexpr std::string_view blanks = " \t\r\n";

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
bool has_attribute(std::string_view text, std::string_view element, std::string_view attribute) {
    for (std::size_t at = text.find(element); at != text.npos; at = text.find(element, at + 1))
        if (text.substr(at, text.find('>', at) - at).find(attribute) != text.npos) return true;
    return false;
}

// Returns the next element of a name with all that is in it, and removes it and what precedes it from the text; empty if there is
// none.
std::string_view next_element(std::string_view& text, std::string_view name) {
    text.remove_prefix(std::min(text.find("<" + std::string(name)), text.size()));
    const std::string_view element = text.substr(0, text.find("</" + std::string(name)));
    text.remove_prefix(element.size());
    return element;
}

// Returns the value of an attribute of the element with which a text begins; empty if it has none.
std::string_view value_of(std::string_view text, const std::string& attribute) {
    const std::string_view tag = text.substr(0, text.find('>'));
    const auto skip_blanks = [](std::string_view& rest) {
        rest.remove_prefix(std::min(rest.find_first_not_of(blanks), rest.size()));
    };
    for (std::size_t at = tag.find(attribute); at != tag.npos; at = tag.find(attribute, at + 1)) {
        std::string_view rest = tag.substr(at + attribute.size());
        skip_blanks(rest);
        if (at == 0 || blanks.find(tag[at - 1]) == blanks.npos || !rest.starts_with('=')) continue;
        rest.remove_prefix(1);
        skip_blanks(rest);
        return rest.size() < 2 ? "" : rest.substr(1, rest.find(rest[0], 1) - 1);
    }
    return {};
}

// Throws std::runtime_error if a model requires an extension other than those of materials, which are read or noted, of production,
// whose parts in other files are noted, and of sets of triangles, which change no picture.
void check_required(std::string_view text) {
    text.remove_prefix(std::min(text.find("<model"), text.size()));
    std::string_view prefixes = value_of(text, "requiredextensions");
    while (!prefixes.empty()) {
        prefixes.remove_prefix(std::min(prefixes.find_first_not_of(blanks), prefixes.size()));
        const std::string prefix(prefixes.substr(0, prefixes.find_first_of(blanks)));
        prefixes.remove_prefix(prefix.size());
        const std::string_view name = value_of(text, "xmlns:" + prefix);
        const auto is = [&](const char* kind) {
            return name.starts_with("http://schemas.microsoft.com/3dmanufacturing/" + std::string(kind));
        };
        if (!prefix.empty() && !is("material/") && !is("production/") && !is("trianglesets/"))
            throw std::runtime_error("it requires the 3MF extension " + std::string(name.empty() ? prefix : name) +
                                     ", which is not read; export it without");
    }
}

// Returns the numbers of materials of all groups of base materials, by the groups' ids.
std::map<std::string_view, std::size_t> base_materials(std::string_view text) {
    std::map<std::string_view, std::size_t> counts;
    for (std::string_view group; !(group = next_element(text, "basematerials")).empty();) {
        std::size_t& count = counts[value_of(group, "id")];
        for (std::size_t at = group.find("<base "); at != group.npos; at = group.find("<base ", at + 1)) ++count;
    }
    return counts;
}

// Notes objects with a mesh and without a material in a file with base materials. Throws std::runtime_error for an object whose
// material its group does not have: Assimp would read beyond the group's list.
void check_materials(std::string_view text, NotShown& not_shown) {
    const auto groups = base_materials(text);
    if (groups.empty()) return;
    for (std::string_view object; !(object = next_element(text, "object")).empty();) {
        if (object.find("<mesh") == object.npos) continue;
        const std::string_view index = value_of(object, "pindex");
        const auto group = groups.find(value_of(object, "pid"));
        if (group == groups.end() || index.empty())
            not_shown.add("missing materials of 3MF objects (they get the file's first)");
        else if (whole_text<std::size_t>(index).value_or(group->second) >= group->second)
            throw std::runtime_error(missing_material);
    }
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
        check_required(text);
        if (text.find(":colorgroup") != std::string::npos || text.find("<colorgroup") != std::string::npos)
            not_shown.add("colours of 3MF colour groups");
        if (has_attribute(text, "<triangle ", " pid=")) not_shown.add("materials of single triangles of 3MF");
        check_materials(text, not_shown);
        if (has_attribute(text, "<component ", ":path=")) not_shown.add("parts in other files of a 3MF archive");
    }
}

}  // namespace lfdsim::reader
