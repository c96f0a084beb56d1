#include "view/answers/hidden_paths.h"

#include "base/json_utf8.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace lfdsim::view {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view cut = "\u2026/";

/// Returns a text as it is written in JSON, without the quotes.
std::string in_json(const std::string& text) {
    const std::string quoted = json_utf8(nlohmann::json(text));
    return quoted.substr(1, quoted.size() - 2);
}

bool is_one_of(char c, std::string_view all) { return all.find(c) != all.npos; }

bool ends_a_name(char c) { return is_one_of(c, " \t\"'`\\:;,()[]{}<>|="); }

/// Whether the slash at i is the first of an absolute path.
bool begins_a_path(std::string_view json, std::size_t i) {
    if (json[i] != '/') return false;
    if (i == 0) return true;
    if (json.substr(i - 1, 3) == "://") return false;  // a web address
    const char before = json[i - 1];
    if (i > 1 && json[i - 2] == '\\' && is_one_of(before, "nrt")) return true;  // a line's end or a tabulator, as in JSON
    // An apostrophe after a letter is a prime, as in p'/2.
    if (before == '\'' && i > 1 && std::isalnum(static_cast<unsigned char>(json[i - 2]))) return false;
    return is_one_of(before, " \"'`:;,([{>|=");
}

/// Returns the end of a path that begins at i. A path that begins a JSON text may have blanks in the names of its folders.
std::size_t end_of_path(std::string_view json, std::size_t i) {
    const bool blanks = i > 0 && json[i - 1] == '"' && (i < 2 || json[i - 2] != '\\');
    std::size_t end = i;
    for (std::size_t k = i; k < json.size() && (!ends_a_name(json[k]) || (blanks && json[k] == ' ')); ++k)
        if (!blanks || json[k] == '/') end = k + 1;
    while (end < json.size() && !ends_a_name(json[end])) ++end;
    return end;
}

}  // namespace

HiddenPaths::HiddenPaths(const fs::path& served, const std::vector<fs::path>& others) {
    const auto add = [&](const fs::path& folder, std::string_view in_place) {
        std::error_code error;
        const fs::path full = fs::absolute(folder.empty() ? "." : folder, error).lexically_normal();
        for (const fs::path& name : {full, fs::weakly_canonical(full, error)}) {
            std::string text = in_json(name.string());
            if (!text.ends_with('/')) text += '/';
            if (text.size() > 1) folders_.emplace_back(std::move(text), in_place);
        }
    };
    add(served, "");
    for (const fs::path& folder : others) add(folder, cut);
    std::stable_sort(folders_.begin(), folders_.end(),
                     [](const auto& a, const auto& b) { return a.first.size() > b.first.size(); });
}

std::string HiddenPaths::without(const std::string& json) const {
    std::string shown;
    shown.reserve(json.size());
    const std::string_view text = json;
    for (std::size_t i = 0; i < text.size();) {
        if (!begins_a_path(text, i)) {
            shown += text[i++];
            continue;
        }
        const auto known =
            std::find_if(folders_.begin(), folders_.end(), [&](const auto& f) { return text.substr(i).starts_with(f.first); });
        if (known != folders_.end()) {
            shown += known->second;
            i += known->first.size();
            continue;
        }
        const std::size_t end = end_of_path(text, i);
        const std::string_view path = text.substr(i, end - i);
        if (path.find_first_not_of('/') == path.npos)
            shown += path;  // a division
        else
            shown.append(cut).append(path.substr(path.find_last_of('/', path.find_last_not_of('/')) + 1));
        i = end;
    }
    return shown;
}

}  // namespace lfdsim::view
