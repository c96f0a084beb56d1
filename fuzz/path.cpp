// Any bytes given as a camera path: refused with an InputError, or a path whose cameras are where its poses say. Anything else is a
// crash.
#include <cstdlib>
#include <string_view>

#include "files/description/path_file.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim;
    CameraPath path;
    try {
        path = parse_path(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
    } catch (const InputError& error) {
        if (error.problems.empty()) std::abort();
        return 0;
    }
    const std::int64_t frames = path.frames();
    if (frames < 1 || frames > most_path_frames) std::abort();
    for (std::int64_t k = 0; k < frames; k += 1 + frames / 100)
        if (!(path.time_s(k) <= path.poses.back().time_s)) std::abort();
    if (path.camera(0, {}).position_mm != path.poses.front().position_mm) std::abort();
    path.camera(frames - 1, {});
    return 0;
}
