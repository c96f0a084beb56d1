// Models and pictures read by the reader process, and checked.

#include "content/content.h"
#include "content/models/model.h"
#include "content/models/reader_process.h"
#include "content/models/transfer.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cmath>
#include <system_error>

namespace lfdsim {
namespace fs = std::filesystem;

namespace {

// Returns what is wrong with a model, or null. The file may have corrupted the reader before it wrote: nothing that it sent is
// trusted.
const char* fault(const Model& m) {
    const auto finite = [](const std::vector<float>& list) {
        return std::all_of(list.begin(), list.end(), [](float x) { return std::isfinite(x); });
    };
    const std::size_t n = m.vertices();
    if (m.indices.empty()) return "it has no triangles";
    if (m.positions.size() != 3 * n || m.normals.size() != 3 * n || m.uvs.size() != 2 * n || m.indices.size() % 3 != 0 ||
        (!m.colours.empty() && m.colours.size() != 3 * n) || m.material_of.size() != m.triangles())
        return "its lists have different lengths";
    if (!finite(m.positions)) return "it has vertices that are infinite or not a number";
    if (!finite(m.normals) || !finite(m.uvs) || !finite(m.colours))
        return "it has normals, texture coordinates or colours that are infinite or not a number";
    if (std::any_of(m.indices.begin(), m.indices.end(), [&](std::uint32_t i) { return i >= n; }))
        return "a triangle refers to a vertex that does not exist";
    if (std::any_of(m.material_of.begin(), m.material_of.end(), [&](std::uint32_t i) { return i >= m.materials.size(); }))
        return "a triangle refers to a material that does not exist";
    for (const Material& material : m.materials) {
        if (material.texture < -1 || material.texture >= std::int64_t(m.textures.size()))
            return "a material refers to a texture that does not exist";
        for (const float c : material.colour) {
            if (!(c >= 0 && c <= 1)) return "a colour is out of range";
        }
        for (const Wrap w : {material.wrap_u, material.wrap_v}) {
            if (w != Wrap::repeat && w != Wrap::clamp && w != Wrap::mirror) return "a texture has an unknown wrapping mode";
        }
    }
    for (const Texture& t : m.textures) {
        if (t.width < 1 || t.height < 1 || t.width > 16384 || t.height > 16384 ||
            t.rgba.size() != std::size_t(t.width) * t.height * 4)
            return "a texture has a wrong size";
    }
    return nullptr;
}

// Throws InputError if a file cannot be read.
void check_file(const fs::path& path, const std::string& what) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error == std::errc::permission_denied) throw InputError(path.string(), fmt::format("cannot be read: {}", error.message()));
    if (!fs::exists(status)) throw InputError(path.string(), fmt::format("no such {} file", what));
    if (!fs::is_regular_file(status)) throw InputError(path.string(), fmt::format("not a file that can hold a {}", what));
    if (fs::file_size(path, error) == 0 && !error) throw InputError(path.string(), fmt::format("the {} file is empty", what));
    if (faccessat(AT_FDCWD, path.c_str(), R_OK, AT_EACCESS) != 0)
        throw InputError(path.string(), fmt::format("cannot be read: {}", std::generic_category().message(errno)));
}

void check_limits(const LoadOptions& options) {
    if (!(options.seconds > 0 && options.seconds <= 86400))
        throw InputError("seconds", fmt::format("{} given; allowed is up to 86400", options.seconds));
    if (options.bytes < 1) throw InputError("bytes", fmt::format("{} given; allowed is 1 or more", options.bytes));
}

/// Reads a file in a reader process; `what`: "model" or "picture". Throws InputError with the reason if it cannot be read.
std::shared_ptr<const Model> load(const std::string& what, const fs::path& path, const LoadOptions& options) {
    check_file(path, what);
    ReaderProcess reader(what, path, options);
    const auto refuse = [&](const std::string& why) -> void {
        throw InputError(path.string(), fmt::format("cannot be read as a {}: {}", what, why));
    };
    auto model = std::make_shared<Model>();
    try {
        Reply reply{};
        reader.value(reply);
        if (reply == Reply::out_of_memory) refuse(too_large_text(options));
        if (reply == Reply::refusal) {
            std::string why;
            reader.array(why);
            refuse(why);
        }
        if (reply != Reply::model) refuse("the reader's answer is invalid");
        transfer(reader, *model);
    } catch (const ReaderProcess::Failure& failure) {
        refuse(failure.what());
    }
    if (const char* what_is_wrong = fault(*model)) refuse(what_is_wrong);
    return model;
}

}  // namespace

std::shared_ptr<const Model> load_model(const fs::path& path, const LoadOptions& options) {
    if (!options.up.empty() && options.up != "y" && options.up != "z")
        throw InputError("up", fmt::format("\"{}\" given; allowed are \"y\" and \"z\"", options.up));
    check_limits(options);
    return path == built_in_spheres ? built_in_model() : load("model", path, options);
}

std::shared_ptr<const Model> load_picture(const fs::path& path, const LoadOptions& options) {
    check_limits(options);
    return load("picture", path, options);
}

ModelInfo info(const Model& m) {
    return {std::int64_t(m.triangles()),
            std::int64_t(m.vertices()),
            std::int64_t(m.materials.size()),
            std::int64_t(m.textures.size()),
            m.notes,
            m.files};
}

}  // namespace lfdsim
