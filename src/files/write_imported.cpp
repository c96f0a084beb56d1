#include "files/commented.h"
#include "files/import_lens.h"

namespace lfdsim {
namespace {

void write_surface(const Surface& s, const std::string& place, bool last, CommentedText& text) {
    text.list("lens.surface");
    text.note("{}", place);
    text.key("curvature_per_mm", s.curvature_per_mm);
    if (s.conic != 0) text.key("conic", s.conic);
    if (!s.even_asphere.empty()) text.key("even_asphere", s.even_asphere);
    text.key("semi_aperture_mm", s.semi_aperture_mm);
    if (last) return;
    text.key("distance_mm", s.distance_mm);
    if (s.index) text.key("index", *s.index);
    if (s.glass) text.key("glass", *s.glass);
}

}  // namespace

std::string write_imported(const Imported& made, const std::vector<std::string>& catalogues, const std::string& made_by) {
    const Display& d = made.display;
    CommentedText text;
    text.note("A lens from a lens design program, and a display for it, as a starting point. Made by: {}", made_by);
    for (const std::string& note : made.notes) text.note("- {}", note);
    text.key("schema", std::int64_t{1});
    text.key("name", d.name);
    if (!catalogues.empty()) text.key("glass_catalogues", catalogues);
    text.table("panel");
    text.key("pixels", d.panel.pixels);
    text.key("pixel_pitch_mm", d.panel.pixel_pitch_mm);
    text.table("lens");
    text.note("From the panel's side to the viewer's; each surface with its place in the file.");
    text.key("type", d.lens.kind);
    const std::vector<Surface>& surfaces = d.lens.as<SurfaceLens>().surfaces;
    for (std::size_t i = 0; i < surfaces.size(); ++i) write_surface(surfaces[i], made.surfaces[i], i + 1 == surfaces.size(), text);
    text.table("array");
    text.key("pitch_mm", d.array.pitch_mm);
    text.key("gap_mm", *d.array.gap_mm);
    if (d.diffuser) {
        text.table("diffuser");
        text.key("distance_mm", d.diffuser->distance_mm);
        text.key("angle_deg", d.diffuser->angle_deg);
    }
    text.table("camera");
    text.key("position_mm", d.camera.position_mm);
    text.key("resolution", d.camera.resolution);
    if (d.camera.pupil_diameter_mm) {
        text.key("pupil_diameter_mm", *d.camera.pupil_diameter_mm);
        text.key("focus_distance_mm", *d.camera.focus_distance_mm);
    }
    text.table("content");
    text.key("model", d.content.model);
    text.key("viewing_distance_mm", d.content.viewing_distance_mm);
    return text.all;
}

}  // namespace lfdsim
