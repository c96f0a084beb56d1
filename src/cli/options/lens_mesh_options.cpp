#include "cli/options/lens_mesh_options.h"

#include "cli/program/arguments.h"
#include "engine/devices/memory.h"
#include "interchange/meshed/lens_mesh.h"

#include <fmt/format.h>

namespace lfdsim::cli {

LensMeshOptions::LensMeshOptions(Command command)
    : option_(command
                  .add_option("--lens-mesh", triangles_,
                              "Replace each lens by about so many triangles, as other renderers do (docs/meshed.md); point "
                              "samples, surround opaque")
                  .type_name("TRIANGLES")) {
    command.add_option("--lens-normals", normals_, "The triangles' own, or the true surface's, interpolated; default flat")
        .type_name("flat|smooth");
}

std::int64_t LensMeshOptions::triangles() const {
    return whole_number("--lens-mesh", triangles_, least_lens_triangles, most_lens_triangles);
}

void LensMeshOptions::check() const {
    Faults faults;
    if (given()) faults.of([&] { triangles(); });
    faults.of([&] { word("--lens-normals", normals_, {"flat", "smooth"}); });
    faults.report();
}

std::optional<MeshedLens> LensMeshOptions::lens(const Display& display, const Geometry& geometry) const {
    if (!given()) return {};
    constexpr double bytes_per_triangle = 200;  // of the mesh, its copies on the way, and its tree
    require_memory("--lens-mesh", fmt::format("a lens of {} triangles", triangles()), bytes_per_triangle * double(triangles()));
    return MeshedLens(display, geometry, triangles(), normals_ == "smooth" ? LensNormals::smooth : LensNormals::flat);
}

std::string LensMeshOptions::text(const MeshedLens& lens) const {
    return fmt::format("{} triangles a lens, {} normals", lens.triangles(), normals_);
}

Json LensMeshOptions::json(const MeshedLens& lens) const { return {{"triangles", lens.triangles()}, {"normals", normals_}}; }

}  // namespace lfdsim::cli
