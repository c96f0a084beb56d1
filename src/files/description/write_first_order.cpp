#include "files/description/write_first_order.h"

#include "base/constants.h"
#include "files/description/commented.h"
#include "geometry/sharp_range.h"

#include <algorithm>
#include <cmath>

namespace lfdsim {

CommentedText begun_design(const std::string& name, const std::string& made_by) {
    CommentedText text;
    text.note("A first-order design, as a starting point. Made by: {}", made_by);
    text.note(
        "It follows from thin-lens formulas alone. `lfdsim check` reports what theory predicts, `lfdsim analyze` measures what the "
        "real lenses achieve; the formulas are those of docs/model.md. Lengths are in mm.");
    text.key("schema", std::int64_t{1});
    text.key("name", name);
    return text;
}

void write_panel_pixels(const Panel& panel, double inch, CommentedText& text) {
    text.table("panel");
    text.key("pixels", panel.pixels);
    text.note("a = 25.4 x {:g} inches / sqrt({}^2 + {}^2)", inch, panel.pixels[0], panel.pixels[1]);
    text.key("pixel_pitch_mm", panel.pixel_pitch_mm);
}

namespace {

void write_lens(const FirstOrder& o, CommentedText& text) {
    const double f = o.theory.focal_length_mm, g = *o.display.array.gap_mm;
    text.table("lens");
    text.note("f = 1 / (1/g + 1/L) = {:.5g} mm images the panel at the central depth plane, L = {:g} mm from the lenses{}.", f,
              *o.request.depth_mm, *o.request.depth_mm < 0 ? " (behind them)" : "");
    text.key("type", o.display.lens.kind);
    if (const auto* ideal = std::get_if<IdealLens>(&o.display.lens.kind))
        return text.key("focal_length_mm", ideal->focal_length_mm);
    const auto& lens = o.display.lens.as<PlanoConvex>();
    text.note("The flat face is towards the panel. R = (n - 1) f; f/{:.3g} at the width below.",
              f / (2 * *lens.aperture_radius_mm));
    text.key("sphere_radius_mm", lens.sphere_radius_mm);
    if (o.aperture_rule == ApertureRule::cell)
        text.note("r = p/2: the lens fills its cell; the blur by its spherical aberration is no wider than a panel pixel.");
    if (o.aperture_rule == ApertureRule::sphere)
        text.note("r = 0.9 R, {:.3g} of p/2: a wider cap would come too near to a hemisphere. The space between lenses is black.",
                  2 * *lens.aperture_radius_mm / o.display.array.pitch_mm[0]);
    if (o.aperture_rule == ApertureRule::aberration)
        text.note(
            "r is {:.3g} of p/2: a wider lens would blur a panel pixel (a/g = {:.3g} milliradians) by its spherical aberration, K "
            "(2r/f)^3 with K = {:.4f} for n = {}. The space between lenses is black; an asphere (type \"surfaces\") could fill it.",
            2 * *lens.aperture_radius_mm / o.display.array.pitch_mm[0], 1000 * o.display.panel.pixel_pitch_mm / g, spherical_blur,
            pmma_index);
    text.key("aperture_radius_mm", *lens.aperture_radius_mm);
    text.note("Height of the wall under the cap: a quarter of the pitch or of the gap.");
    text.key("cylinder_height_mm", lens.cylinder_height_mm);
    text.note("PMMA at 589 nm");
    text.key("index", *lens.index);
}

// Returns why the pitch is what it is, as a sentence. 3437.75 is arc minutes in a radian.
std::string pitch_reason(const FirstOrder& o) {
    const double eye = o.eye_mm, L = *o.request.depth_mm;
    switch (o.pitch_rule) {
        case PitchRule::balanced:
            return fmt::format(
                "From the eye a lens then subtends {:.3g} arc minutes and the image of a panel pixel on the central depth plane "
                "{:.3g}, so that lenses and pixels limit resolution about equally: wider lenses would give more views and a finer "
                "picture at that depth, but a coarser one at the lenses and less depth of field.",
                3437.75 * o.display.array.pitch_mm[0] / eye, 3437.75 * o.theory.pixel_image_mm / (eye - L));
        case PitchRule::pupil:
            return fmt::format("It is about half of a pupil of {:g} mm, so that light from several lenses enters the eye at once.",
                               usual_pupil_mm);
        case PitchRule::lenses:
            return fmt::format(
                "Wider lenses would resolve more, but none is wider than 1/{} of the panel's shorter side, so that there are "
                "enough for a picture.",
                fewest_lenses);
        case PitchRule::asked:
            return o.request.views ? "As asked for by --views." : "As asked for by --pitch-mm.";
        case PitchRule::views:
            break;
    }
    return fmt::format(
        "Fewer would not give a picture that changes with the eye's position, although lenses and pixels would then limit "
        "resolution about equally.");
}

void write_array(const FirstOrder& o, CommentedText& text) {
    const LensArray& array = o.display.array;
    const double t = std::tan(o.request.fov_deg * std::acos(-1.0) / 360), eye = camera_distance_mm(o.display);
    const Geometry geometry = resolve(o.display);
    text.table("array");
    if (array.lattice != LatticeKind::square) text.key("lattice", array.lattice);
    if (o.request.pitch_mm)
        text.note("{:.6g} panel pixels are behind a lens. {}", array.pitch_mm[0] / o.display.panel.pixel_pitch_mm, pitch_reason(o));
    else
        text.note("p = N a with N = {} panel pixels, and so {} x {} views. {}", o.views, o.views, o.views, pitch_reason(o));
    text.key("pitch_mm", array.pitch_mm);
    text.note(
        "Elemental images are p' = p (1 + g/E) = {:.6g} mm wide, E = {:.6g} mm from the lenses to the eye. The count is that of "
        "elemental images that lie whole on the panel.",
        o.theory.along[0].elemental_pitch_mm, o.eye_mm);
    text.key("count", *array.count);
    text.note(
        "From the panel to the lens's panel-side principal plane: g = 1 / (2 tan(FOV/2) / p - 1/E), so that the field of view, 2 "
        "atan(p' / 2g), is {:g} degrees (tan(FOV/2) = {:.5g}). Depth of field by the pixel, |1/z - 1/L| <= a/(g D): {}.",
        o.request.fov_deg, t, depths_in_words(geometry, sharp_by_pixel(geometry, o.theory, eye), eye));
    text.key("gap_mm", *array.gap_mm);
    if (array.aperture != Aperture::circle) text.key("aperture", array.aperture);
}

void write_diffuser(const FirstOrder& o, CommentedText& text) {
    if (!o.display.diffuser) {
        text.all += "\n";
        text.note("No diffuser: near the eye the pupil mixes the light of neighbouring lenses.");
        return;
    }
    const Diffuser& diffuser = *o.display.diffuser;
    text.table("diffuser");
    if (*o.request.depth_mm > 0)
        text.note("The diffuser is on the central depth plane, where it does not blur the picture.");
    else
        text.note(
            "The diffuser is as far in front of the lenses as the central depth plane is behind them, at most a quarter of the way "
            "to the eye.");
    text.key("distance_mm", diffuser.distance_mm);
    text.note(
        "2 atan(p / 2d): the angle of a lens pitch seen from the diffuser at distance d, so that dark gaps between lenses close{}.",
        o.display.array.lattice == LatticeKind::hexagon ? "; vertically p is the pitch from row to row" : "");
    text.key("angle_deg", diffuser.angle_deg);
}

void write_camera_and_content(const FirstOrder& o, CommentedText& text) {
    const Camera& camera = o.display.camera;
    const Content& content = o.display.content;
    text.table("camera");
    text.key("position_mm", camera.position_mm);
    text.note("Width of the lens array as seen from there, with a margin of about 5 %.");
    text.key("frame_width_mm", *camera.frame_width_mm);
    text.key("resolution", camera.resolution);
    if (camera.pupil_diameter_mm) {
        text.note("An eye that looks at the central depth plane.");
        text.key("pupil_diameter_mm", *camera.pupil_diameter_mm);
        text.key("focus_distance_mm", *camera.focus_distance_mm);
    }
    text.table("content");
    text.key("model", content.model);
    text.note("On the central depth plane, where the picture is sharpest.");
    text.key("depth_mm", *content.depth_mm);
    text.note("Half the panel's height as seen by the eye, or |L| if that is less.");
    text.key("height_mm", *content.height_mm);
    text.note("Elemental images are made for the eye's position.");
    text.key("viewing_distance_mm", content.viewing_distance_mm);
}

}  // namespace

std::string write_first_order(const FirstOrder& o, const std::string& made_by) {
    CommentedText text = begun_design(o.display.name, made_by);
    write_panel_pixels(o.display.panel, o.request.panel_inch, text);
    write_lens(o, text);
    write_array(o, text);
    write_diffuser(o, text);
    write_camera_and_content(o, text);
    return text.all;
}

}  // namespace lfdsim
