#include "cli/options/lens_mesh_options.h"

#include "cli/program/arguments.h"
#include "engine/devices/memory.h"
#include "interchange/meshed/lens_mesh.h"

#include <fmt/format.h>

namespace lfdsim::cli {

std::int64_t LensMeshOptions::triangles() const { return triangles_.whole_number(least_lens_triangles, most_lens_triangles); }

void LensMeshOptions::check() const {
    Faults faults;
    if (given()) faults.of([&] { triangles(); });
    faults.of([&] { normals_.word(); });
    faults.report();
}

std::optional<MeshedLens> LensMeshOptions::lens(const Display& display, const Geometry& geometry) const {
    if (!given()) return {};
    constexpr double bytes_per_triangle = 200;  // of the mesh, its intermediate copies, and its tree
    require_memory("--lens-mesh", fmt::format("a lens of {} triangles", triangles()), bytes_per_triangle * double(triangles()));
    return MeshedLens(display, geometry, triangles(), normals_.text() == "smooth" ? LensNormals::smooth : LensNormals::flat);
}

std::string LensMeshOptions::text(const MeshedLens& lens) const {
    return fmt::format("{} triangles a lens, {} normals", lens.triangles(), normals_.text());
}

Json LensMeshOptions::json(const MeshedLens& lens) const { return {{"triangles", lens.triangles()}, {"normals", normals_.text()}}; }

}  // namespace lfdsim::cli
