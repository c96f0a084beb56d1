#include "content/reader/limits/refusal.h"

#include "base/text.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

namespace lfdsim::reader {
namespace {

/// Returns what is wrong with a binary STL file whose length does not agree with its number of triangles, and which Assimp
/// therefore takes for text; nothing for other files.
std::optional<std::string> wrong_length(const std::filesystem::path& file) {
    if (lower_case(file.extension().string()) != ".stl") return {};
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    constexpr std::size_t head = 84, triangle = 50;
    if (bytes.size() < head || bytes.find('\0') == bytes.npos) return {};
    std::uint32_t count = 0;
    std::memcpy(&count, &bytes[head - sizeof count], sizeof count);
    const std::size_t wanted = head + triangle * std::size_t(count);
    if (wanted == bytes.size()) return {};
    return "is damaged: it names " + std::to_string(count) + " triangles, for which it must have " + std::to_string(wanted) +
           " bytes; it has " + std::to_string(bytes.size());
}

}  // namespace

std::string no_triangles(const NotShown& not_shown) {
    const std::vector<std::string> notes = not_shown.notes();
    return "has no triangles: nothing to show" + (notes.empty() ? "" : " (" + notes.front() + ")");
}

std::string refusal(const std::string& says, const std::filesystem::path& file, const NotShown& not_shown) {
    if (says.starts_with("No output meshes") || says.starts_with("No meshes remaining"))
        return wrong_length(file).value_or(no_triangles(not_shown));
    constexpr const char* unfit = "is damaged, or not of the format that its name states";
    if (says.starts_with("Failed to determine STL")) return wrong_length(file).value_or(unfit);
    if (says.starts_with("No suitable reader found")) return "is damaged, or of no format that is read";
    if (says.starts_with("Cannot parse string"))
        return "has text where a number is expected; save it in another format, such as glTF";
    if (says.starts_with("OBJ-file is too small")) return no_triangles(not_shown);
    for (const char* const known : {"Failed to open file", "File came out empty"})
        if (says.find(known) != says.npos) return unfit;
    // Some messages name the file with its whole path.
    std::string text = says;
    const std::string path = file.string(), name = file.filename().string();
    if (const std::size_t at = text.find(path); at != text.npos) text.replace(at, path.size(), name);
    return text;
}

std::optional<std::string> plain_warning(const std::string& says) {
    constexpr std::string_view no_materials = "OBJ: Unable to locate material file ";
    constexpr std::string_view no_material = "OBJ: failed to locate material ";
    if (says.starts_with("OBJ: Unable to locate fallback material file")) return {};
    // Assimp takes a library's last material for the current one: where faces before any "o" or "g" begin with another one, it
    // makes a mesh of no object, which gets no faces.
    if (says.starts_with("OBJ: No object detected to attach a new mesh instance")) return {};
    if (says.starts_with(no_materials))
        return "material file \"" + says.substr(no_materials.size()) +
               "\" not found in the model's folder: shown without its colours and textures";
    if (says.starts_with(no_material))
        return "material \"" + says.substr(no_material.size(), says.rfind(", creating new material") - no_material.size()) +
               "\" is in no material file: shown grey";
    return "Assimp, which reads the file, warns: " + says;
}

}  // namespace lfdsim::reader
