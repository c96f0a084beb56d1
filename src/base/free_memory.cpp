#include "base/free_memory.h"

#include "base/text.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>
#include <algorithm>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <vector>

namespace lfdsim {
namespace fs = std::filesystem;
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double most_limit = 9e18;  // version 1 writes "none" as the largest number of pages

/// Returns the first number in a file; nothing if the file cannot be read or has none ("max": no limit).
std::optional<double> number_in(const fs::path& file) {
    double value = 0;
    if (std::ifstream in(file); in >> value) return value;
    return std::nullopt;
}

/// Returns the number after a word at the beginning of a line ("MemAvailable: 23437584 kB", "inactive_file 4096"), in the file's
/// unit; nothing if there is no such line.
std::optional<double> number_after(const fs::path& file, const std::string& word) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string first;
        double value = 0;
        if (words >> first >> value && first == word) return value;
    }
    return std::nullopt;
}

/// A mounted tree of control groups.
struct Mount {
    int version;
    std::string root;  // the group that is seen at the mount point
    fs::path point;
};

/// Returns a path of mountinfo, in which blanks and backslashes are written as \ and three octal digits, as it is.
std::string unescaped(const std::string& text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool octal =
            text[i] == '\\' && i + 3 < text.size() &&
            std::all_of(text.begin() + long(i) + 1, text.begin() + long(i) + 4, [](char c) { return c >= '0' && c <= '7'; });
        plain += octal ? char(std::stoi(text.substr(i + 1, 3), nullptr, 8)) : text[i];
        if (octal) i += 3;
    }
    return plain;
}

/// Returns whether a list of words separated by commas contains a word.
bool lists(std::string_view options, std::string_view one) { return std::ranges::count(split(options, ','), one) > 0; }

/// Returns the mounted trees that control memory, of both versions, from /proc/self/mountinfo: "36 35 98:0 ROOT POINT options
/// [fields] - TYPE SOURCE SUPER_OPTIONS". Version 1 names its controllers among the super options.
std::vector<Mount> mounts(const fs::path& root) {
    std::vector<Mount> all;
    std::ifstream in(root / "proc/self/mountinfo");
    for (std::string line; std::getline(in, line);) {
        std::istringstream words(line);
        std::string id, parent, device, seen, point, word, type, source, options;
        if (!(words >> id >> parent >> device >> seen >> point)) continue;
        while (words >> word && word != "-") {
        }
        if (!(words >> type >> source >> options)) continue;
        if (type == "cgroup2" || (type == "cgroup" && lists(options, "memory")))
            all.push_back({type == "cgroup2" ? 2 : 1, unescaped(seen), root / fs::path(unescaped(point)).relative_path()});
    }
    return all;
}

/// Returns this process's group for each version (1, 2), as /proc/self/cgroup has it: "0::/a/b", "4:memory:/a/b".
std::map<int, std::string> groups(const fs::path& root) {
    std::map<int, std::string> all;
    std::ifstream in(root / "proc/self/cgroup");
    for (std::string line; std::getline(in, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == line.npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1), path = line.substr(second + 1);
        if (controllers.empty()) all[2] = path;
        if (lists(controllers, "memory")) all[1] = path;
    }
    return all;
}

/// Returns the bytes that a group leaves of its lowest limit; infinite without a limit. Pages of files, which the kernel can
/// drop, count as free.
double left_by_group(int version, const fs::path& folder) {
    const fs::path stat = folder / "memory.stat";
    double limit = no_limit, used = 0;
    const std::string of_all = version == 1 ? "total_" : "";  // groups within this one, too
    for (const char* file : version == 1 ? std::vector{"memory.limit_in_bytes"} : std::vector{"memory.max", "memory.high"})
        limit = std::min(limit, number_in(folder / file).value_or(no_limit));
    if (!(limit < most_limit)) return no_limit;
    used = number_in(folder / (version == 1 ? "memory.usage_in_bytes" : "memory.current")).value_or(0);
    for (const char* dropped : {"inactive_file", "active_file"}) used -= number_after(stat, of_all + dropped).value_or(0);
    return std::max(limit - std::max(used, 0.), 0.);
}

/// Lowers `least` to `bytes` if these are fewer; `whose` is the text for FreeMemory::whose.
void consider(FreeMemory& least, double bytes, const std::string& whose) {
    if (bytes < least.bytes) least = {bytes, whose};
}

/// Considers this process's group and all groups above it, up to the mount point: each has a limit of its own.
void consider_groups(FreeMemory& least, const fs::path& root) {
    const std::map<int, std::string> own = groups(root);
    for (const Mount& mount : mounts(root)) {
        const auto found = own.find(mount.version);
        if (found == own.end()) continue;
        // The group's path from the one that is mounted. In a container it may lie elsewhere: then the mounted one is the nearest
        // known.
        fs::path below = fs::path(found->second).lexically_relative(mount.root);
        if (below.empty() || *below.begin() == "..") below = ".";
        for (fs::path group = below.lexically_normal();; group = group.parent_path()) {
            const std::string name = (fs::path(mount.root) / group).lexically_normal().string();
            consider(least, left_by_group(mount.version, mount.point / group),
                     fmt::format("the control group {} of this process has", name));
            if (group.empty() || group == ".") break;
        }
    }
}

/// Considers the soft limit of a resource, of which `used` bytes are used.
void consider_limit(FreeMemory& least, __rlimit_resource what, double used, const char* whose) {
    rlimit limit{};
    if (getrlimit(what, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        consider(least, std::max(double(limit.rlim_cur) - used, 0.), whose);
}

}  // namespace

FreeMemory free_memory(const fs::path& root) {
    const double installed = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
    const auto available = number_after(root / "proc/meminfo", "MemAvailable:");
    FreeMemory least{available ? *available * 1024 : installed, "this machine has"};
    consider_groups(least, root);
    const fs::path status = root / "proc/self/status";
    consider_limit(least, RLIMIT_AS, 1024 * number_after(status, "VmSize:").value_or(0),
                   "the limit on address space (ulimit -v) leaves");
    consider_limit(least, RLIMIT_DATA, 1024 * number_after(status, "VmData:").value_or(0), "the limit on data (ulimit -d) leaves");
    return least;
}

std::string bytes_text(double bytes) {
    if (bytes < 0.95e6) return fmt::format("{:.0f} kB", bytes / 1e3);
    return bytes < 0.95e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string free_text(const FreeMemory& free) { return fmt::format("{} {} free", free.whose, bytes_text(free.bytes)); }

}  // namespace lfdsim
