// Any bytes given as what describes a grid of views (the first byte says what: t views.toml, p parameters.cfg, q the .toml of a
// quilt, n a quilt's name), beside pictures that are there: refused with an InputError, or a grid whose parts fit and that is
// placed with finite lengths before a display, or refused there. Anything else is a crash.
#include "file_of_bytes.h"
#include "files/views/views_source.h"

#include <cmath>
#include <cstdlib>

namespace {

using namespace lfdsim;

void check(const ViewsSource& source) {
    if (source.columns < 1 || source.rows < 1) std::abort();
    if (source.form != ViewsForm::quilt && source.pictures.size() != source.views()) std::abort();
    if (!source.depths.empty() && source.depths.size() != source.views()) std::abort();
    if (!source.cameras.empty() && source.cameras.size() != source.views()) std::abort();
    std::vector<std::string> notes;
    const ViewGrid grid = placed(source, {}, {100, 60, 2, 0, 500}, source.aspect.value_or(1.5), notes);
    for (const double x : {grid.distance_mm, grid.width_mm, grid.height_mm, grid.depth_mm})
        if (!std::isfinite(x)) std::abort();
    for (int j = 0; j < grid.rows; ++j)
        for (int i = 0; i < grid.columns; ++i)
            for (const double x : grid.camera(i, j))
                if (!std::isfinite(x)) std::abort();
    views_toml(grid, "view_*.png", "");
}

struct Folder : FuzzFolder {
    Folder() {
        for (int row = 0; row < 2; ++row)
            for (int column = 0; column < 2; ++column) {
                put("view_0" + std::to_string(2 * row + column) + ".png", "");
                put("input_Cam00" + std::to_string(2 * row + column) + ".png", "");
                put(std::to_string(row) + "_" + std::to_string(column) + ".png", "");
            }
        put("quilt_qs2x2a1.5.png", "");
    }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    static const Folder folder;
    if (size == 0) return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    try {
        if (data[0] == 't') check(find_views(folder.put("views.toml", bytes)));
        if (data[0] == 'p') check(find_views(folder.put("parameters.cfg", bytes)));
        if (data[0] == 'n') quilt_name(bytes);
        if (data[0] != 'q') return 0;
        folder.put("quilt_qs2x2a1.5.toml", bytes);
        check(find_views(folder.path() / "quilt_qs2x2a1.5.png"));
    } catch (const InputError& error) {
        if (error.problems.empty()) std::abort();
    }
    return 0;
}
