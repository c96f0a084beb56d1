#include "engine/memory.h"

#include "model/error.h"
#include "model/lattice.h"

#include <fmt/format.h>
#include <unistd.h>
#include <algorithm>
#include <fstream>

namespace lfdsim {

double memory_bytes() {
    double bytes = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE)), limit = 0;
    if (std::ifstream group("/sys/fs/cgroup/memory.max"); group >> limit)
        bytes = std::min(bytes, limit);  // "max": no number, no limit
    return bytes;
}

// float32 RGB; writers keep a few rows beside it.
double picture_bytes(std::int64_t columns, std::int64_t rows) { return double(columns) * double(rows) * 12; }

// Four floats a pixel; the pyramid adds a third, and the sums of strips' long footprints as much again.
double texel_bytes(const Display& d) {
    return double(d.panel.pixels[0]) * double(d.panel.pixels[1]) * 16 * 4 / 3 * (is_strips(d.array) ? 2 : 1);
}

void require_memory(const std::string& where, const std::string& what, double bytes) {
    if (bytes > memory_bytes())
        throw InputError(where, fmt::format("{} needs {:.1f} GB of memory, this machine has {:.1f} GB", what, bytes / 1e9,
                                            memory_bytes() / 1e9));
}

void require_panel_memory(const Display& d) {
    const auto [columns, rows] = d.panel.pixels;
    require_memory("panel.pixels", fmt::format("making the panel image of {} x {} pixels", columns, rows),
                   picture_bytes(columns, rows) + texel_bytes(d));
}

void require_picture_memory(std::int64_t columns, std::int64_t rows, double panel_bytes) {
    const double bytes = picture_bytes(columns, rows);
    require_memory(bytes > panel_bytes ? "camera.resolution" : "panel.pixels",
                   fmt::format("a picture of {} x {} pixels, with the panel image,", columns, rows), bytes + panel_bytes);
}

}  // namespace lfdsim
