#include "cli/output/numbered_pictures.h"

#include "base/counted.h"
#include "base/json_utf8.h"
#include "cli/output/output.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>

namespace lfdsim::cli {
namespace {

namespace fs = std::filesystem;

// Returns a command without the options that may differ between a run and the one that continues it.
std::string resumed(std::string command) {
    for (const std::string_view option : {" --resume", " --replace"})
        for (std::size_t i = 0; (i = command.find(option, i)) != command.npos;)
            if (const std::size_t end = i + option.size(); end == command.size() || command[end] == ' ')
                command.erase(i, option.size());
            else
                i = end;
    return command;
}

// The maker of a picture: nobody's is a file that is not a picture; an .npy has no metadata and counts as lfdsim's.
enum class Maker { nobody, lfdsim, other };
Maker maker_of(const fs::path& file) {
    try {
        Metadata about = read_metadata(file);
        return file.extension() == ".npy" || about["Software"].starts_with("lfdsim ") ? Maker::lfdsim : Maker::other;
    } catch (const InputError&) {
        return Maker::nobody;
    }
}

}  // namespace

std::string NumberedPictures::shown_with(const std::vector<std::string>& files) const {
    Json all = shown;
    for (const Json& one : stamps(files))
        if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
    return json_utf8(all);
}

bool NumberedPictures::finished(std::int64_t n) const {
    const fs::path path = file(n);
    if (!fs::is_regular_file(path)) return false;
    try {
        Metadata about = read_metadata(path);
        const Json made_of = Json::parse(about["shown"], nullptr, false);
        return about["Software"] == software && resumed(about["command"]) == resumed(command_line()) &&
               about["display"] == display(n) && files_unchanged(made_of) && made_of.size() >= shown.size() &&
               std::equal(shown.begin(), shown.end(), made_of.begin());
    } catch (const InputError&) {
        return false;  // no picture
    }
}

std::int64_t NumberedPictures::count_finished() const {
    std::int64_t made = 0;
    for (std::int64_t n = 0; n < count; ++n) made += finished(n);
    return made;
}

void NumberedPictures::keep_apart() const {
    if (const std::int64_t made = resume || replace ? 0 : count_finished(); made > 0)
        throw InputError(
            folder.string(),
            fmt::format("contains {} of {} that the same command makes; --resume continues there, --replace makes all again", made,
                        counted(count, "picture")));
    std::map<fs::path, std::int64_t> own;
    for (std::int64_t n = 0; n < count; ++n) own.emplace(name(n), n);
    std::vector<fs::path> others;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none)) {
        const fs::path& path = entry.path();
        if (!alike(path)) continue;
        const auto found = own.find(path.filename());
        const bool as_made = found != own.end() && finished(found->second);
        if (!as_made && !(resume && maker_of(path) == Maker::nobody)) others.push_back(path);
    }
    std::sort(others.begin(), others.end());
    if (!others.empty() && !replace)
        throw InputError(folder.string(), fmt::format("contains {} made by another command or from other files, such as {}; give "
                                                      "another folder, or --replace to remove them",
                                                      counted(others.size(), "picture"), others.front().filename().string()));
    for (const fs::path& path : others)
        if (maker_of(path) == Maker::other)
            throw InputError(path.string(), fmt::format("is a picture not made by lfdsim; give another folder for {}s", of_what));
    for (const fs::path& path : others) fs::remove(path);
}

std::vector<std::int64_t> NumberedPictures::left() const {
    std::vector<std::int64_t> all;
    for (std::int64_t n = 0; n < count; ++n)
        if (!resume || !finished(n)) all.push_back(n);
    return all;
}

void check_resume(bool resume, const std::string& kind) {
    if (resume && kind == "npy") throw InputError("--resume", "a .npy does not record how it was made; use png or exr");
}

}  // namespace lfdsim::cli
