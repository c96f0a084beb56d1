#include "base/constants.h"
#include "files/description/commented.h"
#include "files/description/write_first_order.h"

namespace lfdsim {
namespace {

// Returns why the display has its number of views, as a sentence.
std::string reason_for_views(const Lenticular& o) {
    switch (o.views_rule) {
        case ViewsRule::asked:
            return o.request.pitch_mm ? "As asked for by --pitch-mm." : "As asked for by --views.";
        case ViewsRule::eyes:
            return fmt::format("A viewer's eyes, {:g} mm apart, are two views apart, so that the picture follows the head.",
                               usual_eye_separation_mm);
        case ViewsRule::lenses:
            break;
    }
    return fmt::format("More would need lenses wider than {:g} arc minutes, which the eye resolves.", lens_arc_minutes);
}

void write_panel(const Lenticular& o, CommentedText& text) {
    const Panel& panel = o.display.panel;
    write_panel_pixels(panel, o.request.panel_inch, text);
    if (panel.subpixels != SubpixelLayout::none) {
        text.note("The usual stripes. Under slanted lenses each row shows different ones, and their colours mix.");
        text.key("subpixels", panel.subpixels);
    } else {
        text.note(
            "The whole pixel emits its colour: under vertical lenses an eye would see stripes of red, green and blue separately.");
    }
    if (panel.layers.empty()) return;
    text.list("panel.layer");
    text.note("The part of the sheet below the lenses' walls. The whole sheet is {:.5g} mm thick up to the vertices, n g{}.",
              o.sheet_mm, o.request.sheet_mm ? ", as asked for by --sheet-mm" : "");
    text.key("thickness_mm", panel.layers[0].thickness_mm);
    text.key("index", *panel.layers[0].index);
}

void write_lens(const Lenticular& o, CommentedText& text) {
    text.table("lens");
    text.note(
        "Cylinders that focus on the panel, f = g = {:.5g} mm: an eye sees one line of the panel through each of them, and so one "
        "view.",
        o.gap_mm);
    text.key("type", o.display.lens.kind);
    if (const auto* ideal = std::get_if<IdealLens>(&o.display.lens.kind))
        return text.key("focal_length_mm", ideal->focal_length_mm);
    const auto& lens = o.display.lens.as<PlanoConvex>();
    text.note("R = (n - 1) g. A smaller or larger one puts the panel out of focus, which softens the step from view to view.");
    text.key("sphere_radius_mm", lens.sphere_radius_mm);
    text.note("Height of the wall under the caps");
    text.key("cylinder_height_mm", lens.cylinder_height_mm);
    text.note("PMMA at 589 nm");
    text.key("index", *lens.index);
}

// Returns the formula of the gap, by what decided it.
std::string reason_for_gap(const Lenticular& o) {
    if (o.request.sheet_mm)
        return fmt::format("g is the sheet's thickness over n, so that the field of view is {:.4g} degrees", o.fov_deg);
    if (o.two_view)
        return fmt::format("g = a E/b: neighbouring pixels are seen from positions b = {:g} mm apart, one by each eye",
                           o.view_step_mm);
    return fmt::format(
        "g = p'/(2 tan(FOV/2)), p' along the rows, so that the field of view of whole elemental images, 2 atan(p'/2g), is {:g} "
        "degrees there",
        o.fov_deg);
}

void write_array(const Lenticular& o, CommentedText& text) {
    const LensArray& array = o.display.array;
    text.table("array");
    text.key("lattice", array.lattice);
    if (o.request.pitch_mm)
        text.note("N = {:.5g} panel pixels of a row are behind each lens. {}", o.views, reason_for_views(o));
    else
        text.note(
            "p = N a cos(slant) / (1 + g/E) with N = {:g} panel pixels of a row: seen from E = {:.6g} mm, where the eye is from "
            "the lenses, "
            "elemental images are N pixels apart. {}",
            o.views, o.eye_mm, reason_for_views(o));
    text.key("pitch_mm", array.pitch_mm);
    if (array.slant_deg) {
        text.note(
            "{} Lenses slanted by 1 in 3 show the next subpixel in each row, so that the loss of resolution is shared by rows and "
            "columns and the gaps between pixels are not magnified into dark bands.",
            o.request.slant_deg ? "As asked for by --slant-deg." : "");
        text.key("slant_deg", *array.slant_deg);
    }
    text.note("The number that covers the panel{}.",
              array.slant_deg ? "" : "; with this number the borders of elemental images fall between pixels");
    text.key("count", *array.count);
    if (array.offset_mm[0] != 0) {
        if (array.slant_deg) text.note("Half a step of subpixels, so that no subpixel's centre lies on the border of two lenses.");
        text.key("offset_mm", array.offset_mm);
    }
    text.note("{}. From view to view an eye moves by a E/g = {:.4g} mm.", reason_for_gap(o), o.view_step_mm);
    if (array.gap_mm) text.key("gap_mm", *array.gap_mm);
    if (array.base_z_mm) {
        text.note("The lenses' walls begin on the sheet: lenses and sheet are one piece of glass.");
        text.key("base_z_mm", *array.base_z_mm);
        text.key("surround", array.surround);
    }
    text.key("aperture", array.aperture);
}

void write_camera_and_content(const Lenticular& o, CommentedText& text) {
    const Camera& camera = o.display.camera;
    const Content& content = o.display.content;
    text.table("camera");
    text.note("{}", o.two_view ? "A viewer's right eye; the left eye is at the mirrored position."
                               : "An eye in front of the panel's middle.");
    text.key("position_mm", camera.position_mm);
    text.key("frame_width_mm", *camera.frame_width_mm);
    text.key("resolution", camera.resolution);
    text.key("pixel_filter", camera.pixel_filter);
    text.key("pupil_diameter_mm", *camera.pupil_diameter_mm);
    text.table("content");
    text.key("model", content.model);
    text.note("At the screen, where all views coincide.");
    text.key("depth_mm", *content.depth_mm);
    text.key("height_mm", *content.height_mm);
    text.note("At this distance an eye sees the same view through all lenses.");
    text.key("viewing_distance_mm", content.viewing_distance_mm);
}

}  // namespace

std::string write_lenticular(const Lenticular& o, const std::string& made_by) {
    CommentedText text = begun_design(o.display.name, made_by);
    write_panel(o, text);
    write_lens(o, text);
    write_array(o, text);
    write_camera_and_content(o, text);
    return text.all;
}

}  // namespace lfdsim
