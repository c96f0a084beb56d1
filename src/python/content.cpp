#include "python/content.h"

#include <algorithm>

namespace lfdsim::python {

ContentScene scene_of(const Display& display, const Geometry& geometry, std::vector<std::string>& notes, const Job& job) {
    const std::vector<ContentFile> files = content_files(display);
    LoadOptions options;
    options.job = &job;
    const ContentParts parts = load_parts(files, options);
    for (std::size_t i = 0; i < files.size(); ++i)
        // Objects of the same file share its parts: only the first of them adds the notes.
        if (std::find(parts.begin(), parts.begin() + std::ptrdiff_t(i), parts[i]) == parts.begin() + std::ptrdiff_t(i))
            for (const std::string& note : info(*parts[i]).notes) notes.push_back(files[i].path + ": " + note);
    return ContentScene(parts, display, geometry);
}

}  // namespace lfdsim::python
