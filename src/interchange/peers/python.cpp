#include "interchange/peers/python.h"

#include "engine/scene/traced_display.h"
#include "interchange/meshed/cell_sides.h"
#include "interchange/peers/array_frame.h"
#include "interchange/peers/cell.h"
#include "interchange/peers/ply.h"
#include "interchange/peers/scene_text.h"

#include <nlohmann/json.hpp>

// A script is a head of comments, one literal SCENE and text that is the same for all displays. JSON without true, false and null
// is also Python.
namespace lfdsim::peers {
namespace {

using Json = nlohmann::ordered_json;

/// Returns the camera as the scripts read it: mm, in the display's frame.
Json camera(const Display& d, const Geometry& g) {
    const optics::RayOrigin view = make_ray_origin(d, g);
    const auto list = [](const double* v) { return Json{v[0], v[1], v[2]}; };
    return {{"position_mm", list(view.position)}, {"forward", list(view.forward)},
            {"right", list(view.right)},          {"up", list(view.up)},
            {"distance_mm", view.distance},       {"frame_width_mm", view.pixel_mm * view.width},
            {"size", {view.width, view.height}},  {"whole_pixels", d.camera.pixel_filter == PixelFilter::box ? 1 : 0}};
}

/// Returns the diffuser as the scripts read it; empty if there is none.
Json diffuser(const Display& d, const Geometry& g) {
    if (!d.diffuser) return Json::object();
    return {{"z_mm", *g.diffuser_z_mm},
            {"half_mm", sheet_half(g) + 20 * *g.diffuser_z_mm},
            {"angle_deg", d.diffuser->angle_deg},
            {"gaussian", d.diffuser->profile == Profile::gaussian ? 1 : 0}};
}

/// Returns a list of patches, and appends their files.
Json patches(const std::vector<Patch>& all, bool opaque, std::vector<PeerFile>& files) {
    Json list = Json::array();
    for (const Patch& patch : all) {
        const std::string name = patch.name + ".ply";
        list.push_back({{"file", name},
                        {"black", patch.black ? 1 : 0},
                        {"front", patch.index_front},
                        {"back", patch.index_back},
                        {"leans", patch.of_lens ? 1 : 0},  // with the array, where that is not parallel to the panel
                        {"reflects", !opaque && patch.of_lens ? 1 : 0}});  // totally reflected light continues
        files.push_back({name, ply(patch)});
    }
    return list;
}

/// Returns the data as a literal of Python, a line for each entry.
std::string literal(const Json& data) {
    std::string text = "SCENE = {\n";
    for (const auto& [key, value] : data.items()) text += fmt::format("    {}: {},\n", Json(key).dump(), value.dump(-1, ' ', true));
    return text + "}\n\n";
}

const char* word(Fresnel f) { return f == Fresnel::exact ? "exact" : f == Fresnel::schlick ? "schlick" : "none"; }

}  // namespace

void write_python(Peer peer, const Display& display, const Geometry& geometry, const PeerOptions& options,
                  std::vector<std::string> head, PeerScene& scene) {
    const bool cycles = peer == Peer::cycles, opaque = display.array.surround == Surround::opaque;
    scene.shown = display;
    scene.panel_file = "panel.exr";
    scene.picture = "view.exr";
    scene.command =
        (cycles ? "blender -b --factory-startup --python-exit-code 1 -P scene.py -- -o " : "python3 scene.py -o ") + scene.picture;
    auto& deviations = scene.deviations;
    deviations.push_back("rays are followed in single precision from the camera on");
    if (cycles && display.render.fresnel == Fresnel::schlick) {
        scene.shown.render.fresnel = Fresnel::exact;
        deviations.push_back("render.fresnel: Cycles has no Schlick weights for refraction; they are exact here");
    }
    if (cycles && display.diffuser)
        deviations.push_back(
            "diffuser: its angles are a hash of the point where a ray meets it, so rays are spread over a hundredth of the pixel");

    std::vector<PeerFile> files;
    const MeshedArray made = mesh_array(display, geometry, *options.triangles);
    Display points = scene.shown;
    points.render.estimator = Estimator::point;
    const LensArray& array = display.array;
    const ArrayFrame frame = array_frame(display, geometry);
    const Json data{
        {"camera", camera(display, geometry)},
        {"panel",
         {{"file", scene.panel_file},
          {"width_mm", geometry.panel_width_mm},
          {"height_mm", geometry.panel_height_mm},
          {"emission_exponent", display.panel.emission_exponent}}},
        {"array",
         {{"count", lens_count(display.panel, array)},
          {"pitch_mm", geometry.lattice.pitch},
          {"staggered", is_staggered(array) ? 1 : 0},
          {"base_z_mm", geometry.base_z_mm},
          {"turn", frame.turn},
          {"shift_mm", frame.shift_mm}}},
        {"diffuser", diffuser(display, geometry)},
        {"fresnel", word(scene.shown.render.fresnel)},
        // Opaque: each surface once. Otherwise: up to 16.
        {"hits", (opaque ? geometry.surfaces.size() - (geometry.glued ? 1 : 0) : 16) + display.panel.layers.size() +
                     (display.diffuser ? 1 : 0)},
        {"smooth", options.normals == MeshNormals::smooth ? 1 : 0},
        {"samples", samples_of(points)},
        {"seed", display.render.seed},
        {"cell", patches(made.cell, opaque, files)},
        {"sheet", patches(made.sheet, opaque, files)},
    };
    head.push_back("Render: " + scene.command + " [--samples N] [--size WxH]" +
                   (cycles ? "" : " [--variant llvm_ad_rgb|cuda_ad_rgb]"));
    head.push_back(fmt::format("A lens has {} triangles.", made.lens_triangles));
    for (const std::string& d : deviations) head.push_back("Deviates: " + d);
    scene.files.push_back({"scene.py", comment("#", head) + literal(data) + (cycles ? cycles_script : mitsuba_script)});
    std::move(files.begin(), files.end(), std::back_inserter(scene.files));
}

}  // namespace lfdsim::peers
