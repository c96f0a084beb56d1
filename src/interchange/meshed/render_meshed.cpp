#include "interchange/meshed/render_meshed.h"

#include "display/colour.h"
#include "display/keys.h"
#include "engine/kernels/cancelling.h"
#include "engine/scene/traced_display.h"
#include "engine/scene/tracer.h"
#include "geometry/lens_misalignment.h"
#include "interchange/meshed/mesh_surfaces.h"
#include "optics/camera.h"
#include "optics/light.h"
#include "optics/trace.h"

#include <fmt/format.h>

namespace lfdsim {
namespace {

/// Renders a tile, ray by ray: Embree's time for a ray is far more than packets would save.
bool render_tile(const Tile& tile) {
    const optics::TracedDisplay<float>& scene = *tile.display;
    Cancelling cancelling(tile);
    for (std::int32_t y = tile.y0; y < tile.y1; ++y) {
        for (std::int32_t x = tile.x0; x < tile.x1; ++x) {
            const auto pixel = optics::pixel_rays<float>(*tile.view, x, y);
            optics::Sampler<float> sampler(tile.sampling, tile.dimensions, tile.view->seed,
                                           std::uint32_t(y) * std::uint32_t(tile.view->width) + std::uint32_t(x));
            double sum[3] = {};
            for (std::uint32_t sample = 0; sample < tile.samples; ++sample, sampler.next(*tile.directions)) {
                if (cancelling.ends_before(1)) return false;
                optics::Passage<float> passage{{}, {0, 0}, 1, pixel.alive};
                optics::sample_ray(scene, *tile.view, pixel, sampler, passage.ray);
                optics::to_first_vertex(scene, passage);
                if (!passage.alive) continue;
                const auto point = optics::trace_opaque<optics::Specialisations::meshed>(scene, pixel.extent, pixel.base, passage);
                optics::Light<float> light;
                light.add(scene.emission, tile.texels, optics::Fetch<float>(optics::panel_pixel(scene, pixel.base, point)));
                for (int c = 0; c < 3; ++c) sum[c] += double(light(0, c));
            }
            float* const out = tile.out + (std::int64_t(y - tile.crop_y) * tile.crop_width + (x - tile.crop_x)) * 3;
            for (int c = 0; c < 3; ++c) out[c] = float(sum[c] / tile.samples);
        }
    }
    return true;
}

}  // namespace

MeshedLens::MeshedLens(const Display& display, const Geometry& geometry, std::int64_t triangles, LensNormals normals) {
    if (is_irregular(display.errors))
        throw InputError("errors",
                         "misalign single lenses, or tilt the array, which --lens-mesh does not cover; give shift_mm, gap_mm, "
                         "rotation_deg and pitch_ppm only");
    if (display.array.surround != Surround::opaque)
        throw InputError("array.surround", fmt::format("is \"{}\"; lenses of triangles can only be traced in \"opaque\"",
                                                       word(display.array.surround)));
    if (is_staggered(display.array) || is_strips(display.array))
        throw InputError("array.lattice", fmt::format("is \"{}\", which --lens-mesh does not cover; take \"square\" or "
                                                      "\"rectangle\"",
                                                      word(display.array.lattice)));
    if (!display.panel.layers.empty())
        throw InputError("panel.layer", "is given, but --lens-mesh does not cover layers; leave them out");
    if (disperses(display))
        throw InputError("lens.glass",
                         "disperses, which --lens-mesh does not cover; give lens.index, or one wavelength three times");
    if (geometry.glued)
        throw InputError("array.base_z_mm",
                         "lets the lenses lie on the panel without air, which --lens-mesh does not cover; raise them");
    const LensMesh mesh = mesh_lens(display, geometry, triangles);
    triangles_ = std::int64_t(mesh.count());
    surfaces_ = std::make_shared<const MeshSurfaces>(mesh, geometry, normals);
}

Rendering render_meshed(const Display& display, const Geometry& geometry, const Texels& panel, const MeshedLens& lens,
                        const RenderOptions& options, Job& job) {
    Display points = display;
    points.render.estimator = Estimator::point;
    const optics::SummedImage unsummed{panel.data(), nullptr, 0, std::uint32_t(panel.columns()), std::uint32_t(panel.rows())};
    const MeshedScene scene{make_traced_display<float>(points, geometry), &lens.surfaces()};
    return render_with({"meshed", render_tile, scene}, points, geometry, {unsummed}, options, job);
}

}  // namespace lfdsim
