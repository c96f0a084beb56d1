#include "display/keys.h"

#include "base/constants.h"

#include <fmt/format.h>

#include <cmath>

namespace lfdsim {
namespace {

constexpr Range count_range{1, two_to_31, false, true}, index_range{1, 4}, turn{-360, 360};
constexpr Range wavelength_range{100, 10000}, width_range{0, 1000, true, false};
constexpr Range angle{0, 180, false, true}, open_angle{0, 180, true, true}, slant_range{-90, 90, true, true};
// Curvatures up to a nanometre's radius, and coefficients of any size: the sag that they give is checked instead.
constexpr Range curvature_range{-1 / shortest_mm, 1 / shortest_mm}, coefficient_range{-1e6, 1e6};

constexpr Key<Panel> panel_keys[] = {
    {"pixels", &Panel::pixels, count_range, true, "Columns and rows. Their product is below 2^31."},
    {"pixel_pitch_mm", &Panel::pixel_pitch_mm, positive_length, true, "From pixel to pixel, the same in both directions."},
    {"encoding", &Panel::encoding, no_range, false, "Of the panel image's code values: IEC 61966-2-1, or proportional to light."},
    {"emission_exponent", &Panel::emission_exponent, Range{0, 100}, false,
     "m: radiance falls as cos(theta)^m from the normal, in what lies on the panel. 0 is a Lambertian panel."},
    {"aperture_ratio", &Panel::aperture_ratio, Range{1e-4, 1}, false,
     "q: each subpixel (without subpixels each pixel) shines in a rectangle about its centre, sqrt(q) as wide and high. Around it "
     "is a black matrix. What shines is so much brighter that white is white in the mean."},
    {"subpixels", &Panel::subpixels, no_range, false,
     "Of each pixel: none, all of it shines in its colour; stripes from the left, or rows from the top; RGBG of OLED panels, in "
     "cells of 2 x 2 pixels; thirds whose odd rows stand half a pixel to the right; or the rectangles of [[panel.subpixel]]."},
    {"subpixel_cell", &Panel::subpixel_cell, Range{1, 16}, false,
     "Of custom subpixels: columns and rows of pixels after which they repeat, from the panel's top left corner.",
     "required of custom subpixels"},
    {"wavelengths_nm", &Panel::wavelengths_nm, wavelength_range, false,
     "At which red, green and blue are traced, where glass disperses. The default: dominant ones of the sRGB primaries. Lengths "
     "that "
     "depend on an index are green's."},
    {"primary_widths_nm", &Panel::primary_widths_nm, width_range, false,
     "Full widths at half maximum of the primaries' spectra, for render.wavelength_samples.", "one wavelength each"},
    {"layer", &Panel::layers, no_range, false, ""},
    {"subpixel", &Panel::custom, no_range, false, ""},
};

constexpr Key<Subpixel> subpixel_keys[] = {
    {"channel", &Subpixel::channel, no_range, true, "The colour in which it shines."},
    {"pixel", &Subpixel::pixel, Range{0, 15}, true, "The pixel of the cell whose value it shows: column and row, from 0."},
    {"rect", &Subpixel::rect, Range{-16, 32}, true,
     "Left, top, right and bottom, in pixels from the cell's top left corner. It may hang over the cell's border, and repeats with "
     "the cell. Rectangles do not overlap."},
};

constexpr std::string_view no_index = "given by glass; exactly one of the two is required";
constexpr std::string_view glass_doc = "Glass, whose index depends on the wavelength: a name, or a table, as above.";
constexpr std::string_view no_glass = "given by index; exactly one of the two is required";

constexpr Key<Layer> layer_keys[] = {
    {"thickness_mm", &Layer::thickness_mm, positive_length, true, "From face to face."},
    {"index", &Layer::index, index_range, false, "Refractive index, the same for all wavelengths.", no_index},
    {"glass", &Layer::glass, no_range, false, glass_doc, no_glass},
};

constexpr std::string_view aperture_radius_doc =
    "r, the lens's radius; 2 r is at most the least lens pitch for circular apertures; of a cylindrical lens half its width. Of "
    "lenses that fill their cells it may be "
    "absent: the lens then reaches the cell's corners, r = pitch/sqrt(2) in square cells.";
constexpr std::string_view no_aperture_radius = "required of round lenses; else as far as the cell's corners";

constexpr Key<Lens> lens_keys[] = {
    {"type", &Lens::kind, no_range, true,
     "A spherical plano-convex lens, a prescription of surfaces, a thin lens without aberrations, or a pinhole."},
    {"stop_radius_mm", &Lens::stop_radius_mm, positive_length, false,
     "An aperture stop in the plane of the curved vertex (of the last surface, of the thin lens): a black sheet with a hole "
     "for each lens.",
     "none"},
};

constexpr Key<PlanoConvex> plano_convex_keys[] = {
    {"sphere_radius_mm", &PlanoConvex::sphere_radius_mm, positive_length, true, "R of the spherical cap. R >= r."},
    {"aperture_radius_mm", &PlanoConvex::aperture_radius_mm, positive_length, false, aperture_radius_doc, no_aperture_radius},
    {"cylinder_height_mm", &PlanoConvex::cylinder_height_mm, length_or_zero, false,
     "h of the wall under the cap. h <= 2 sqrt(R^2 - r^2)."},
    {"index", &PlanoConvex::index, index_range, false, "Refractive index, the same for all wavelengths.", no_index},
    {"glass", &PlanoConvex::glass, no_range, false, glass_doc, no_glass},
    {"facing", &PlanoConvex::facing, no_range, false, "Which way the convex side faces."},
};

constexpr Key<SurfaceLens> surfaces_keys[] = {
    {"surface", &SurfaceLens::surfaces, no_range, false, ""},
};

constexpr Key<IdealLens> ideal_keys[] = {
    {"aperture_radius_mm", &IdealLens::aperture_radius_mm, positive_length, false, aperture_radius_doc, no_aperture_radius},
    {"focal_length_mm", &IdealLens::focal_length_mm, positive_length, true, "Of the thin lens."},
};

constexpr Key<Pinhole> pinhole_keys[] = {
    {"aperture_radius_mm", &Pinhole::aperture_radius_mm, positive_length, true,
     "Of a round hole; of strips half the width of a slit. Twice that is at most the least lens pitch."},
};

constexpr Key<Surface> surface_keys[] = {
    {"curvature_per_mm", &Surface::curvature_per_mm, curvature_range, false,
     "1/R at the vertex. Sag is positive towards the viewer, so a last surface convex to the viewer has a negative curvature."},
    {"conic", &Surface::conic, coefficient_range, false, "Conic constant k: 0 a sphere, -1 a paraboloid."},
    {"even_asphere", &Surface::even_asphere, coefficient_range, false, "[a4, a6, ...], in mm^-3, mm^-5, ... At most 8."},
    {"semi_aperture_mm", &Surface::semi_aperture_mm, positive_length, true, "A ray further than this from the axis is absorbed."},
    {"distance_mm", &Surface::distance_mm, length_or_zero, false,
     "From vertex to vertex, to the next surface. Ignored on the last."},
    {"index", &Surface::index, index_range, false, "Of the medium up to the next surface. Ignored on the last: air follows.",
     "1, air, or given by glass"},
    {"glass", &Surface::glass, no_range, false, glass_doc, "given by index; not both"},
};

constexpr Key<LensArray> array_keys[] = {
    {"lattice", &LensArray::lattice, no_range, false,
     "Of the cells in which the lenses stand: squares; rectangles; hexagons, corners up and down; rectangles whose rows alternate "
     "by half a pitch; or strips, which hold cylindrical lenses."},
    {"count", &LensArray::count, count_range, false, "Lenses across and up. Their product is below 2^31. Strips are one row.",
     "the least that cover the panel"},
    {"pitch_mm", &LensArray::pitch_mm, positive_length, true,
     "From lens to lens: one number, or for rectangles and bricks two, along the array's rows and from row to row."},
    {"gap_mm", &LensArray::gap_mm, positive_length, false,
     "From the panel to the lens's panel-side principal plane, reduced: the sum of thickness / index of the layers and of the air.",
     "given by base_z_mm; exactly one of the two is required"},
    {"base_z_mm", &LensArray::base_z_mm, length_or_zero, false,
     "From the panel to the lens's lowest point. A lens that is flat there and lies on the layers (or on the panel) is glued on.",
     "given by gap_mm; exactly one of the two is required"},
    {"surround", &LensArray::surround, no_range, false,
     "Between the lenses: black walls, air and polished walls, or one moulded sheet. The last two need a lens of one glass body."},
    {"aperture", &LensArray::aperture, no_range, false, "Round lenses, or lenses that fill their cells."},
    {"offset_mm", &LensArray::offset_mm, any_length, false, "Of the array's centre from the panel's, after the rotation."},
    {"rotation_deg", &LensArray::rotation_deg, turn, false, "Counter-clockwise as the viewer sees it, about the array's centre."},
    {"slant_deg", &LensArray::slant_deg, slant_range, false,
     "Of strips, in place of the rotation: angle of their axes from the vertical, positive where the upper ends lean to the "
     "viewer's right.",
     "the rotation, the other way round"},
};

constexpr Key<Diffuser> diffuser_keys[] = {
    {"distance_mm", &Diffuser::distance_mm, positive_length, true,
     "From the array's viewer-side vertex plane. In front of all glass."},
    {"angle_deg", &Diffuser::angle_deg, angle, true, "Full angles, or full widths at half maximum: horizontal, vertical."},
    {"profile", &Diffuser::profile, no_range, false, "Of the spread: uniform within the angle, or a normal distribution."},
};

constexpr Key<Camera> camera_keys[] = {
    {"position_mm", &Camera::position_mm, any_length, false, "In front of the lenses and the diffuser."},
    {"target_mm", &Camera::target_mm, any_length, false, "What the camera looks at."},
    {"up", &Camera::up, any_length, false, "Upwards in the picture; not along the line of sight. Of any length but 0."},
    {"frame_width_mm", &Camera::frame_width_mm, positive_length, false,
     "Width that the frame shows in the plane through the target, normal to the line of sight. Not together with fov_deg.",
     "1.03 x the wider of the panel and 16/9 of its height"},
    {"fov_deg", &Camera::fov_deg, open_angle, false, "Horizontal angle of the frame.", "given by frame_width_mm"},
    {"resolution", &Camera::resolution, count_range, false, "Columns and rows of the picture. Their product is below 2^31."},
    {"pixel_filter", &Camera::pixel_filter, no_range, false, "Rays through pixel centres, or spread over the pixel."},
    {"pupil_diameter_mm", &Camera::pupil_diameter_mm, positive_length, false, "Of a thin-lens camera.", "a pinhole"},
    {"focus_distance_mm", &Camera::focus_distance_mm, positive_length, false,
     "Along the line of sight, of a thin-lens camera. Needs pupil_diameter_mm.", "the target's distance"},
};

constexpr Key<Content> content_keys[] = {
    {"model", &Content::model, no_range, false,
     "Mesh file, relative to the description's folder, or built-in:spheres. Not together with [[content.object]].",
     "built-in:spheres, five chequered spheres, or the objects"},
    {"depth_mm", &Content::depth_mm, any_length, false,
     "Of the model's centre, from the array's viewer-side vertex plane; of objects, which it moves together, of the point midway "
     "in "
     "depth between the nearest and the furthest one's middle.",
     "the central depth plane, or 0 where that is further from the lenses than half the viewer's distance; objects stay"},
    {"height_mm", &Content::height_mm, positive_length, false,
     "Of the model; of objects the height of their common box, scaled about the point of depth_mm, on the display's axis.",
     "half the panel's height; objects stay"},
    {"tilt_deg", &Content::tilt_deg, turn, false,
     "The model's rotation about the horizontal axis, before the yaw; positive raises its front. Objects turn about that point."},
    {"yaw_deg", &Content::yaw_deg, turn, false,
     "The model's rotation, counter-clockwise seen from above. Objects turn about that point."},
    {"viewing_distance_mm", &Content::viewing_distance_mm, Range{shortest_mm, infinity}, false,
     "From the panel to the viewer that the elemental images are made for. inf: elemental images stand straight behind their "
     "lenses."},
    {"view_cone_deg", &Content::view_cone_deg, Range{0, 170, true}, false,
     "The angle that quilts made for this display span, as its maker states it. A quilt that says nothing of its cameras is then "
     "shown as such a display shows it: each view has an equal part of the elemental images' width.",
     "quilts are taken for pictures of cameras that span 40 degrees"},
    {"pickup", &Content::pickup, no_range, false,
     "Along which lines elemental images are made: through the nodal points of a perfect lens; where the real lens sends each "
     "pixel's light, in the mean; the mean of what many of those rays see. inverse: for the best views, by all rays together."},
    {"pickup_rays", &Content::pickup_rays, Range{1, 1024}, false, "Of the integrated pick-up, for each pixel or subpixel."},
    {"inverse", &Content::inverse, no_range, false, ""},
    {"sampling", &Content::sampling, no_range, false,
     "On a panel with subpixels: each colour of a pixel is made for the place where it shines, or all for the pixel's middle."},
    {"made_for", &Content::made_for, no_range, false,
     "Whether elemental images are made for the display as described, or as it was built, with its [errors]: calibrated content."},
    {"light", &Content::light, no_range, false, ""},
    {"object", &Content::objects, no_range, false, ""},
};

constexpr Key<ContentLight> light_keys[] = {
    {"direction", &ContentLight::direction, any_length, false,
     "Towards the light, which is far away: x to the viewer's right, y up, z to the viewer. Of any length but 0."},
    {"strength", &ContentLight::strength, Range{0, 100}, false, "What a surface that faces the light adds to the ambient term."},
    {"ambient", &ContentLight::ambient, Range{0, 100}, false,
     "Share of its colour that a surface turned away from the light shows."},
};

constexpr std::string_view no_size = "given by another size; exactly one of height_mm, width_mm and unit_mm is required";

constexpr Key<SceneObject> object_keys[] = {
    {"model", &SceneObject::model, no_range, false,
     "Mesh file, relative to the description's folder, or built-in:spheres. Each object has this or image."},
    {"image", &SceneObject::image, no_range, false,
     "Picture file (PNG, JPEG, BMP, TGA, GIF), likewise, on a rectangle that faces the viewer until it is turned. The light does "
     "not "
     "matter to it; it is seen from both sides, mirrored from behind, and through where its alpha says so."},
    {"position_mm", &SceneObject::position_mm, any_length, false,
     "Where the middle of the image, or of the turned model's bounding box, stands: x and y from the panel's middle, z from the "
     "array's viewer-side vertex plane, towards the viewer."},
    {"height_mm", &SceneObject::height_mm, positive_length, false,
     "Of the turned model's box, or of the image before it is turned.", no_size},
    {"width_mm", &SceneObject::width_mm, positive_length, false, "Likewise.", no_size},
    {"unit_mm", &SceneObject::unit_mm, positive_length, false, "Length of the model file's unit.", no_size},
    {"roll_deg", &SceneObject::roll_deg, turn, false, "Rotation about the z axis, the first one; counter-clockwise to the viewer."},
    {"tilt_deg", &SceneObject::tilt_deg, turn, false, "Rotation about the x axis, after the roll; positive raises the front."},
    {"yaw_deg", &SceneObject::yaw_deg, turn, false,
     "Rotation about the y axis, after the tilt; counter-clockwise seen from above. All three axes are the display's."},
    {"colour", &SceneObject::colour, Range{0, 1}, false,
     "Red, green, blue as a screen shows them (sRGB), in place of the model file's colours, textures and vertex colours.",
     "as the model file says"},
    {"shading", &SceneObject::shading, no_range, false,
     "A model's normals: those of its file, or new ones, smoothed over all edges or one for each triangle."},
};

constexpr Key<Render> render_keys[] = {
    {"estimator", &Render::estimator, no_range, false,
     "`filtered`: averages of the panel over lenses' footprints where they agree with points, else points, on a GPU points alone; "
     "`point`: by brute force, each sample reads one panel pixel; `lens_by_lens`: averages over footprints whether they agree or "
     "not, on the CPU. Without a diffuser and pixel filter, samples are points in any case."},
    {"samples", &Render::samples, Range{1, 16777216}, false,
     "Per picture pixel, where a diffuser, filter or pupil spreads the light. Filtered ones are rounded up to a square number, "
     "3844 at most.",
     "points: 100, on a GPU in place of filtered ones 256; filtered: 4, or as many points as a small error takes"},
    {"sampling", &Render::sampling, no_range, false, "Of point samples: low-discrepancy points, or plain random ones."},
    {"fresnel", &Render::fresnel, no_range, false,
     "What each glass surface transmits: by Fresnel's equations, by Schlick's formula, or all light."},
    {"seed", &Render::seed, Range{0, two_to_63}, false, "Of the samples. The same seed gives the same picture."},
    {"wavelength_samples", &Render::wavelength_samples, Range{1, double(max_wavelength_samples)}, false,
     "K: each channel is the sum over so many wavelengths of its spectrum (Gauss-Hermite quadrature). More than 1 needs "
     "panel.primary_widths_nm."},
};

constexpr Key<Display> display_keys[] = {
    {"name", &Display::name, no_range, false, "What reports and image files call the display.", "", TextOf::label},
    {"glass_catalogues", &Display::glass_catalogues, no_range, false,
     "AGF files with glasses, relative to the description's folder; looked up before the glasses that ship. At most 8."},
    {"panel", &Display::panel, no_range, true, ""},
    {"lens", &Display::lens, no_range, true, ""},
    {"array", &Display::array, no_range, true, ""},
    {"errors", &Display::errors, no_range, false, ""},
    {"diffuser", &Display::diffuser, no_range, false, ""},
    {"camera", &Display::camera, no_range, false, ""},
    {"content", &Display::content, no_range, false, ""},
    {"render", &Display::render, no_range, false, ""},
};

// A number as a person writes it: powers of two where they are limits.
std::string number(double x) {
    if (x == two_to_31) return "2^31";
    if (x == two_to_63) return "2^63 - 1";
    if (x == shortest_mm) return "1e-6";
    if (std::abs(x) == 1e6) return x > 0 ? "1e6" : "-1e6";
    return fmt::format("{}", x);
}

}  // namespace

template <>
const Table<Display>& table_of<Display>() {
    static constexpr Table<Display> table{"", "", display_keys};
    return table;
}
template <>
const Table<Panel>& table_of<Panel>() {
    static constexpr Table<Panel> table{
        "panel", "The screen behind the lenses. It lies in z = 0, centred, and faces the viewer at +z.", panel_keys};
    return table;
}
template <>
const Table<Layer>& table_of<Layer>() {
    static constexpr Table<Layer> table{
        "layer", "A plane plate on the panel, the first one lying on it: cover glass, polariser, adhesive. At most 8.", layer_keys};
    return table;
}
template <>
const Table<Subpixel>& table_of<Subpixel>() {
    static constexpr Table<Subpixel> table{
        "subpixel", "A rectangle that shines in one colour; every colour needs one. At most 32, for subpixels = \"custom\".",
        subpixel_keys};
    return table;
}
template <>
const Table<Lens>& table_of<Lens>() {
    static constexpr Table<Lens> table{"lens", "One lens of the array.", lens_keys};
    return table;
}
template <>
const Table<PlanoConvex>& table_of<PlanoConvex>() {
    static constexpr Table<PlanoConvex> table{"plano_convex", "A spherical plano-convex lens.", plano_convex_keys};
    return table;
}
template <>
const Table<SurfaceLens>& table_of<SurfaceLens>() {
    static constexpr Table<SurfaceLens> table{"surfaces", "A prescription of surfaces.", surfaces_keys};
    return table;
}
template <>
const Table<IdealLens>& table_of<IdealLens>() {
    static constexpr Table<IdealLens> table{"ideal", "A thin lens without aberrations.", ideal_keys};
    return table;
}
template <>
const Table<Pinhole>& table_of<Pinhole>() {
    static constexpr Table<Pinhole> table{"pinhole", "A black sheet with a hole for each lens, on strips a slit: a barrier.",
                                          pinhole_keys};
    return table;
}
template <>
const Table<Surface>& table_of<Surface>() {
    static constexpr Table<Surface> table{
        "surface", "The surfaces of the lens, from the panel's side to the viewer's; one [[lens.surface]] each, at most 16.",
        surface_keys};
    return table;
}
template <>
const Table<LensArray>& table_of<LensArray>() {
    static constexpr Table<LensArray> table{"array", "How the lenses stand in front of the panel.", array_keys};
    return table;
}
template <>
const Table<Diffuser>& table_of<Diffuser>() {
    static constexpr Table<Diffuser> table{
        "diffuser", "A thin scattering sheet in front of the lenses. Without this table there is none.", diffuser_keys};
    return table;
}
template <>
const Table<Camera>& table_of<Camera>() {
    static constexpr Table<Camera> table{"camera", "The eye or camera that looks at the display.", camera_keys};
    return table;
}
template <>
const Table<Content>& table_of<Content>() {
    static constexpr Table<Content> table{"content", "What elemental images and reference photographs show.", content_keys};
    return table;
}
template <>
const Table<ContentLight>& table_of<ContentLight>() {
    static constexpr Table<ContentLight> table{
        "light", "What lights models: their colour times (ambient + strength x cosine of the angle to the light, if positive).",
        light_keys};
    return table;
}
template <>
const Table<SceneObject>& table_of<SceneObject>() {
    static constexpr Table<SceneObject> table{
        "object",
        "A thing of the scene that is shown in place of content.model: a model or an image. At most 64; what is nearer "
        "hides what is behind it.",
        object_keys};
    return table;
}
template <>
const Table<Render>& table_of<Render>() {
    static constexpr Table<Render> table{"render", "How pictures are computed.", render_keys};
    return table;
}

std::string Range::text() const {
    if (high == infinity) return fmt::format("{} or more, or inf", number(low));
    return fmt::format("{}{} {} {}", low_open ? "more than " : "", number(low), high_open ? "to below" : "to", number(high));
}

// clang-format off
template <> std::span<const std::string_view> words<Encoding>() { static constexpr std::string_view w[] = {"srgb", "linear"}; return w; }
template <> std::span<const std::string_view> words<SubpixelLayout>() { static constexpr std::string_view w[] = {"none", "rgb_stripe", "bgr_stripe", "rgb_rows", "pentile_rgbg", "delta", "custom"}; return w; }
template <> std::span<const std::string_view> words<Channel>() { static constexpr std::string_view w[] = {"r", "g", "b"}; return w; }
template <> std::span<const std::string_view> words<LensType>() { static constexpr std::string_view w[] = {"plano_convex", "surfaces", "ideal", "pinhole"}; return w; }
template <> std::span<const std::string_view> words<LensKind>() { return words<LensType>(); }
template <> std::span<const std::string_view> words<Facing>() { static constexpr std::string_view w[] = {"viewer", "panel"}; return w; }
template <> std::span<const std::string_view> words<Surround>() { static constexpr std::string_view w[] = {"opaque", "clear", "plate"}; return w; }
template <> std::span<const std::string_view> words<LatticeKind>() { static constexpr std::string_view w[] = {"square", "rectangle", "hexagon", "brick", "strips"}; return w; }
template <> std::span<const std::string_view> words<Aperture>() { static constexpr std::string_view w[] = {"circle", "cell"}; return w; }
template <> std::span<const std::string_view> words<Profile>() { static constexpr std::string_view w[] = {"box", "gaussian"}; return w; }
template <> std::span<const std::string_view> words<PickupKind>() { static constexpr std::string_view w[] = {"nodal", "traced", "integrated", "inverse"}; return w; }
template <> std::span<const std::string_view> words<ContentSampling>() { static constexpr std::string_view w[] = {"subpixel", "pixel"}; return w; }
template <> std::span<const std::string_view> words<MadeFor>() { static constexpr std::string_view w[] = {"description", "built"}; return w; }
template <> std::span<const std::string_view> words<Shading>() { static constexpr std::string_view w[] = {"file", "smooth", "flat"}; return w; }
template <> std::span<const std::string_view> words<PixelFilter>() { static constexpr std::string_view w[] = {"center", "box"}; return w; }
template <> std::span<const std::string_view> words<Estimator>() { static constexpr std::string_view w[] = {"filtered", "point", "lens_by_lens"}; return w; }
template <> std::span<const std::string_view> words<Sampling>() { static constexpr std::string_view w[] = {"sobol", "random"}; return w; }
template <> std::span<const std::string_view> words<Fresnel>() { static constexpr std::string_view w[] = {"exact", "schlick", "none"}; return w; }
// clang-format on

}  // namespace lfdsim
