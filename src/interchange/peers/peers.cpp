#include "interchange/peers/peers.h"

#include "base/constants.h"
#include "display/colour.h"
#include "interchange/peers/python.h"
#include "interchange/peers/scene_text.h"
#include "interchange/pov/pov.h"

#include <algorithm>

namespace lfdsim {

using namespace peers;

std::string_view name_of(Peer peer) {
    return peer == Peer::pov ? "POV-Ray" : peer == Peer::cycles ? "Blender's Cycles" : "Mitsuba";
}

namespace {

/// Returns a display at one wavelength as a scene, with deviations that programs have in common, then those of the program.
PeerScene scene_of(Peer peer, const Display& display, const Geometry& geometry, const PeerOptions& options) {
    PeerScene scene;
    const auto& surfaces = geometry.surfaces;
    const bool even = std::all_of(surfaces.begin(), surfaces.end(),
                                  [&](const PlacedSurface& s) { return s.semi_aperture_mm == surfaces.front().semi_aperture_mm; });
    if (!even && display.array.surround == Surround::opaque)
        scene.deviations.push_back(
            "lens.surface.semi_aperture_mm: they differ; between surfaces the scene has black walls and rings, lfdsim has none");
    if (options.triangles)
        scene.deviations.push_back(fmt::format("lenses are meshes of about {} triangles with {} normals", *options.triangles,
                                               options.normals == MeshNormals::flat ? "flat" : "smooth"));
    const std::vector<std::string> head{
        fmt::format("{}: a light field display, written by lfdsim for {}", one_line(display.name), name_of(peer))};
    if (peer == Peer::pov)
        write_pov(display, geometry, options, head, scene);
    else
        write_python(peer, display, geometry, options, head, scene);
    scene.shown.render.estimator = Estimator::point;
    return scene;
}

}  // namespace

PeerScene peer_scene(Peer peer, const Display& display, const Geometry& geometry, const PeerOptions& given) {
    if (std::vector<Problem> problems = not_expressed(peer, display, geometry, given); !problems.empty())
        throw InputError(std::move(problems));
    PeerOptions options = given;
    if (peer != Peer::pov) options.triangles = given.triangles.value_or(default_triangles);
    if (!options.channel) return scene_of(peer, display, geometry, options);
    const double nm = display.panel.wavelengths_nm[std::size_t(*options.channel)];
    const Display seen = at_wavelength(display, nm);
    PeerScene scene = scene_of(peer, seen, resolve(seen), options);
    scene.deviations.push_back(
        fmt::format("Only {} emits light, with the indices at {} nm.", colour_of_channel[*options.channel], nm));
    return scene;
}

Texels light_of_channel(Texels panel, std::optional<int> channel) {
    if (!channel) return panel;
    float* const end = panel.data() + panel.columns() * panel.rows() * 4;
    for (float* pixel = panel.data(); pixel != end; pixel += 4)
        for (int c = 0; c < 3; ++c)
            if (c != *channel) pixel[c] = 0;
    return panel;
}

std::optional<std::string> panel_deviation(const PeerScene& scene, const Texels& panel) {
    if (!scene.panel_file.ends_with(".png")) return std::nullopt;
    const float* const end = panel.data() + panel.columns() * panel.rows() * 4;
    if (std::all_of(panel.data(), end, [](float light) { return light <= 1; })) return std::nullopt;
    return fmt::format("panel image: {} is limited to white; brighter light is clipped", scene.panel_file);
}

}  // namespace lfdsim
