// The files of content, and reading all of them within common limits.

#include "base/seconds.h"
#include "content/models/memory.h"
#include "content/models/model.h"

#include "base/free_memory.h"

#include <fmt/format.h>

#include <chrono>
#include <map>
#include <set>

namespace lfdsim {
std::int64_t bytes_of(const Model& m) {
    const std::size_t numbers =
        m.positions.size() + m.normals.size() + m.uvs.size() + m.colours.size() + m.indices.size() + m.material_of.size();
    std::size_t bytes = 4 * numbers;
    for (const Texture& t : m.textures) bytes += t.rgba.size();
    return std::int64_t(bytes);
}

double bytes_of(const ContentParts& parts) {
    double bytes = 0;
    for (const std::shared_ptr<const Model>& model : std::set(parts.begin(), parts.end())) bytes += double(bytes_of(*model));
    return bytes;
}

std::vector<ContentFile> content_files(const Display& display) {
    std::vector<ContentFile> files;
    for (const SceneObject& object : display.content.objects)
        files.push_back(object.image.empty() ? ContentFile{object.model} : ContentFile{object.image, true});
    if (files.empty()) files.push_back({model_of(display)});
    return files;
}

std::string model_of(const Display& display) {
    const Content& content = display.content;
    if (!content.objects.empty()) return std::string(scene_of_objects);
    return content.model.empty() ? std::string(built_in_spheres) : content.model;
}

ContentParts load_parts(const std::vector<ContentFile>& files, const LoadOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    std::map<ContentFile, std::shared_ptr<const Model>> read;
    LoadOptions left = options;
    // The reader process and this one hold a model at the same time.
    left.bytes = std::min(left.bytes, std::int64_t(free_memory().bytes / 2));
    ContentParts parts;
    for (const ContentFile& file : files) {
        std::shared_ptr<const Model>& model = read[file];
        if (!model) {
            if (!(left.seconds > 0))
                throw InputError(
                    file.path,
                    fmt::format("reading this and the scene's other files took more than {:g} s; show fewer", options.seconds));
            if (left.bytes < 1)
                throw InputError(
                    file.path,
                    fmt::format(
                        "the scene's other files alone need {} MiB, which is all that is allowed; show fewer or coarser ones",
                        options.bytes >> 20));
            model = file.image ? load_picture(file.path, left) : load_model(file.path, left);
            left.bytes -= bytes_of(*model);
            left.seconds = options.seconds - seconds_since(start);
        }
        parts.push_back(model);
    }
    return parts;
}

}  // namespace lfdsim
