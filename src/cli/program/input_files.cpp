#include "cli/program/input_files.h"

#include "base/input_error.h"
#include "image/compare/above_white.h"
#include "image/formats/image_file.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <system_error>
#include <utility>
#include <vector>

namespace lfdsim::cli {
namespace {

struct Input {
    std::string what;
    std::filesystem::path path;
};

// The program runs one command.
std::vector<Input>& inputs() {
    static std::vector<Input> all;
    return all;
}

}  // namespace

void remember_input(const std::string& what, const std::filesystem::path& path) { inputs().push_back({what, path}); }

void refuse_input(const std::filesystem::path& output) {
    for (const Input& input : inputs())
        if (std::error_code none; std::filesystem::equivalent(output, input.path, none))
            throw InputError(output.string(), fmt::format("is the same file as {}, {}, which would be lost; give another output",
                                                          input.what, input.path.string()));
}

void warn_above_white(const std::string& path, const Image& image) {
    const std::string doubt = above_white(image.rgb.data(), std::int64_t(image.width) * image.height, 3, LightOf::picture);
    if (!doubt.empty()) spdlog::warn("{}: {}", path, doubt);
}

bool warn_of_colours(const std::string& path, Encoding encoding) {
    const std::string colours = other_colours(path, encoding);
    if (!colours.empty()) spdlog::warn("{}: {}", path, colours);
    return !colours.empty();
}

}  // namespace lfdsim::cli
