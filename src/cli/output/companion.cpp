#include "cli/output/companion.h"

#include "base/input_error.h"
#include "base/output_file.h"
#include "cli/program/interrupt.h"

#include <fstream>
#include <iterator>

namespace lfdsim::cli {

void check_companion(const std::filesystem::path& path, bool own, bool replace) {
    guard_output(path);
    check_replaceable(path);
    std::error_code none;
    if (!own && !replace && std::filesystem::exists(std::filesystem::symlink_status(path, none)))
        throw InputError(path.string(),
                         "exists and would be overwritten, though the command does not name it; give --replace, or another name");
}

bool holds(const std::filesystem::path& path, const std::string& text) {
    std::error_code none;
    if (std::filesystem::file_size(path, none) != text.size() || none) return false;
    std::ifstream file(path, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(file), {}} == text;
}

}  // namespace lfdsim::cli
