#include "view/answers/library.h"

#include "base/printable.h"
#include "base/text.h"
#include "content/content.h"
#include "display/keys.h"
#include "files/description/display_file.h"
#include "files/description/text_file.h"
#include "geometry/camera.h"
#include "image/formats/picture_size.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <span>
#include <stdexcept>

namespace lfdsim::view {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_files = 1000, most_looked_at = 5000, most_entries = 100000, longest_name = 1000;
constexpr int deepest = 6;  // folders below the served one

std::string quoted(const std::string& name) { return fmt::format("\"{}\"", printable(name)); }

/// Returns a name as a relative path whose parts are neither empty nor begin with a dot. Throws InputError for others, and for
/// names that are not UTF-8, which messages in JSON cannot have.
fs::path relative(const std::string& name) {
    const fs::path path(name);
    if (name.empty() || name.size() > longest_name || name.find('\0') != name.npos || !is_utf8(name))
        throw InputError("name", "is not a file name");
    if (path.is_absolute()) throw InputError(quoted(name), "is not in the folder that is served; names start there");
    for (const fs::path& part : path)
        if (part.empty() || part.native().starts_with('.'))
            throw InputError(quoted(name), "has a part that is empty or starts with a dot; names are those of files in the folder");
    return path;
}

// Whether a path is in a folder, or is that folder; both are without links.
bool inside(const fs::path& path, const fs::path& folder) {
    return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Returns the path without links. Throws InputError unless it leads to something in the folder.
fs::path resolve_inside(const fs::path& path, const fs::path& folder, const std::string& name) {
    // A link that leads out has the same message as a name that does not exist, so that visitors learn nothing about other folders.
    std::error_code error, of_folder;
    const fs::path real = fs::canonical(path, error), top = fs::canonical(folder, of_folder);
    if (error || of_folder || !inside(real, top)) throw InputError(quoted(name), "is not in the folder that is served");
    return real;
}

bool ends_in(const fs::path& path, std::span<const std::string_view> endings) {
    return std::ranges::find(endings, lower_case(path.extension().string())) != endings.end();
}

struct Served {
    Library::FileKind kind;
    const char* is;  // "a model"
    std::span<const std::string_view> endings;
};
constexpr std::string_view display_endings[] = {".toml"};
constexpr std::string_view model_endings[] = {".3ds", ".3mf", ".amf",  ".ase", ".blend", ".cob", ".dae", ".dxf",
                                              ".fbx", ".glb", ".gltf", ".hmp", ".ifc",   ".lwo", ".obj", ".off",
                                              ".ply", ".smd", ".stl",  ".vrm", ".x",     ".x3d"};
constexpr std::string_view picture_endings[] = {".png", ".jpg", ".jpeg", ".exr", ".npy"};
constexpr Served served[] = {
    {Library::FileKind::display, "a description of a display", display_endings},
    {Library::FileKind::model, "a model", model_endings},
    {Library::FileKind::picture, "a picture", picture_endings},
};

const Served& served_as(Library::FileKind kind) {
    for (const Served& s : served)
        if (s.kind == kind) return s;
    throw std::logic_error("a kind of file that is not served");
}

/// Whether a text is meant as a display's description: it has the key "schema" before its first table. Nothing else is checked.
bool is_description(std::string_view text) {
    constexpr std::string_view key = "schema";
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    while (!text.empty()) {
        const std::string_view line = trimmed(next_line(text));
        if (line.starts_with('[')) return false;
        if (line.starts_with(key) && trimmed(line.substr(key.size())).starts_with('=')) return true;
    }
    return false;
}

bool meant_as_description(const fs::path& path) { return is_description(read_text(path)); }

/// Adds a file if a page could show it, and returns whether it could: of a model only the ending is checked, of a picture the
/// header.
bool add(Library::Files& found, const fs::path& path, const std::string& name, Library::FileKind kind, const Display& shown) {
    try {
        if (kind == Library::FileKind::picture && picture_size(path) != shown.panel.pixels) return false;
        if (kind == Library::FileKind::display) {
            if (!meant_as_description(path)) return false;
            found.eyes_mm[name] = read_display(path).camera.position_mm;
        }
    } catch (const InputError&) {
        return false;
    }
    (kind == Library::FileKind::display ? found.displays
     : kind == Library::FileKind::model ? found.models
                                        : found.pictures)
        .push_back(name);
    return true;
}

/// Throws InputError for keys that other parts of a message decide.
void check_key(std::string_view override_text) {
    const std::string_view key = override_text.substr(0, override_text.find('='));
    const auto is_or_has = [&](std::string_view whole) {
        return whole == key || (key.starts_with(whole) && key.substr(whole.size()).starts_with('.')) ||
               (whole.starts_with(key) && whole.substr(key.size()).starts_with('.'));
    };
    const auto refuse = [&](const char* what) { throw InputError(std::string(key), what); };
    if (is_or_has("content.model")) refuse("cannot be set: the message's \"shown\" states what is shown");
    if (decides_a_file(key)) refuse("cannot be set: a visitor may not name files, nor replace a table or list that names files");
    if (is_or_has("camera.position_mm")) refuse("cannot be set: the message's \"eye_mm\" states the eye's position");
    if (is_or_has("camera.resolution")) refuse("cannot be set: the message's \"size\" states the number of pixels");
}

std::string position(const Vec3d& eye) { return fmt::format("camera.position_mm=[{}]", fmt::join(eye, ", ")); }

// Returns a problem with the key that it is about: one of "--set array.gap_mm=99" that says "array.gap_mm: is ..." or
// "diffuser.distance_mm: is missing" is assigned to that key; one of a list's element ("array.offset_mm[0]") to the list.
Problem by_key(Problem problem) {
    constexpr std::string_view option = "--set ";
    if (!problem.where.starts_with(option)) return problem;
    problem.where = problem.where.substr(option.size(), problem.where.find('=') - option.size());
    const std::size_t end = problem.what.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.[]");
    if (end == problem.what.npos || problem.what.compare(end, 2, ": ") != 0) return problem;
    problem.where = problem.what.substr(0, end);
    problem.what.erase(0, end + 2);
    if (const std::size_t bracket = problem.where.find('['); bracket != problem.where.npos) {
        problem.what = "element " + problem.where.substr(bracket) + " " + problem.what;
        problem.where.resize(bracket);
    }
    return problem;
}

}  // namespace

Library::Library(Start start, fs::path folder) : start_(std::move(start)), folder_(std::move(folder)) {
    std::error_code error;
    if (!fs::is_directory(folder_, error)) throw InputError(folder_.string(), "is not a folder; give the one to serve files from");
}

std::string Library::model(const Display& display) const { return start_.model.empty() ? model_of(display) : start_.model; }

Shown Library::shown(const Shown& wanted) const {
    using Kind = Shown::Kind;
    switch (wanted.kind) {
        case Kind::model:
            return {wanted.kind, wanted.name == built_in_spheres ? wanted.name : file(wanted.name, FileKind::model).string()};
        case Kind::panel_image:
            return {wanted.kind, file(wanted.name, FileKind::picture).string()};
        case Kind::pattern:
            return {wanted.kind, wanted.name};
        case Kind::start:
            break;
    }
    if (!start_.pattern.empty()) return {Kind::pattern, start_.pattern};
    if (!start_.panel_image.empty()) return {Kind::panel_image, start_.panel_image.string()};
    return {Kind::model, start_.model};
}

fs::path Library::file(const std::string& name, FileKind kind) const {
    const fs::path path = folder_ / relative(name);
    if (std::error_code error; !fs::is_regular_file(resolve_inside(path, folder_, name), error))
        throw InputError(quoted(name), "is not a plain file");
    const Served& is = served_as(kind);
    if (!ends_in(path, is.endings))
        throw InputError(quoted(name), fmt::format("is not {}; those end in {}", is.is, fmt::join(is.endings, ", ")));
    if (kind == FileKind::display && !meant_as_description(path))
        throw InputError(quoted(name), "is not a description of a display: those begin with schema = 1");
    return path.lexically_normal();
}

fs::path Library::new_file(const std::string& name) const {
    const fs::path path = folder_ / relative(name);
    if (path.extension() != ".toml") throw InputError(quoted(name), "does not end in .toml");
    if (!is_printable(name)) throw InputError(quoted(name), "has invisible characters");
    std::error_code error;
    if (!fs::is_directory(resolve_inside(path.parent_path(), folder_, name), error))
        throw InputError(quoted(name), "is not in a folder");
    const fs::file_type type = fs::symlink_status(path, error).type();
    if (type != fs::file_type::not_found && type != fs::file_type::regular)
        throw InputError(quoted(name), "exists and is not a plain file");
    return path.lexically_normal();
}

Library::Files Library::files(const Display& display) const {
    Files found;
    std::size_t entries = 0, looked_at = 0, named = 0;
    std::error_code error;
    const fs::path real_folder = fs::canonical(folder_, error);
    fs::recursive_directory_iterator entry(folder_, fs::directory_options::skip_permission_denied, error);
    for (; !error && entry != fs::recursive_directory_iterator() && named < most_files; entry.increment(error)) {
        if (++entries > most_entries) break;
        const fs::path& path = entry->path();
        const bool hidden = path.filename().native().starts_with('.');
        if (hidden || entry.depth() >= deepest) entry.disable_recursion_pending();
        std::error_code broken;  // a broken link is skipped
        if (hidden || !fs::is_regular_file(path, broken) || !inside(fs::canonical(path, broken), real_folder)) continue;
        const Served* const is =
            std::find_if(std::begin(served), std::end(served), [&](const Served& s) { return ends_in(path, s.endings); });
        const std::string name = path.lexically_relative(folder_).generic_string();
        if (is == std::end(served) || name.size() > longest_name || !is_utf8(name)) continue;
        if (++looked_at > most_looked_at) break;
        if (add(found, path, name, is->kind, display)) ++named;
    }
    for (std::vector<std::string>* all : {&found.displays, &found.models, &found.pictures}) std::sort(all->begin(), all->end());
    return found;
}

Library::Description Library::description(const Wanted& wanted, int eye) const {
    Description description{wanted.display.empty() ? start_.display : file(wanted.display, FileKind::display), start_.set};
    for (const std::string& one : wanted.set) {
        check_key(one);
        description.set.push_back(one);
    }
    Vec3d at = wanted.eye_mm;
    if (eye != 0) {
        const Vec3d right = camera_axes(display(wanted).camera).right;
        for (std::size_t a = 0; a < 3; ++a) at[a] += 0.5 * eye * wanted.eye_distance_mm * right[a];
    }
    description.set.push_back(position(at));
    description.set.push_back(fmt::format("camera.resolution=[{}, {}]", wanted.size[0], wanted.size[1]));
    return description;
}

bool Library::shows_another_model(const Shown& shown) const {
    return shown.kind == Shown::Kind::model || (shown.kind == Shown::Kind::start && !start_.model.empty());
}

Display Library::display(const Wanted& wanted, int eye) const {
    const Description wanted_one = description(wanted, eye);
    try {
        Display display = read_display(wanted_one.file, wanted_one.set);
        if (shows_another_model(wanted.shown)) display.content.objects.clear();
        return display;
    } catch (InputError& error) {
        std::transform(error.problems.begin(), error.problems.end(), error.problems.begin(), by_key);
        throw InputError(std::move(error.problems));
    }
}

}  // namespace lfdsim::view
