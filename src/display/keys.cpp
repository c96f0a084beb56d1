#include "display/keys.h"

#include "base/constants.h"

#include <fmt/format.h>

#include <cmath>

namespace lfdsim {
namespace {

constexpr Range count_range{1, two_to_31, false, true}, index_range{1, 4}, turn{-360, 360};
constexpr Range wavelength_range{100, 10000}, width_range{0, 1000, true, false};
constexpr Range angle{0, 180, false, true}, open_angle{0, 180, true, true}, slant_range{-90, 90, true, true};
// Curvatures have radii down to a nanometre, and coefficients are hardly limited: the sag that they give is checked instead.
constexpr Range curvature_range{-1 / shortest_mm, 1 / shortest_mm}, coefficient_range{-1e6, 1e6};

constexpr Key<Panel> panel_keys[] = {
    {"pixels", &Panel::pixels, count_range, true, "Number of columns and rows. Their product is below 2^31."},
    {"pixel_pitch_mm", &Panel::pixel_pitch_mm, positive_length, true,
     "Distance between the centres of neighbouring pixels, the same in both directions."},
    {"encoding", &Panel::encoding, no_range, false,
     "Encoding of the panel image's code values: sRGB (IEC 61966-2-1), or proportional to light."},
    {"emission_exponent", &Panel::emission_exponent, Range{0, 100}, false,
     "m: in the medium on the panel, radiance falls as cos(theta)^m with the angle theta from the normal. 0 is a Lambertian "
     "panel."},
    {"aperture_ratio", &Panel::aperture_ratio, Range{1e-4, 1}, false,
     "q: each subpixel (without subpixels, each pixel) emits light from a rectangle about its centre, sqrt(q) of its width and "
     "height, surrounded by a black matrix. The luminance of these rectangles is increased so that the mean luminance of a white "
     "panel stays the same."},
    {"subpixels", &Panel::subpixels, no_range, false,
     "Layout within a pixel: none, the whole pixel emits its colour; vertical stripes from the left, or horizontal rows from the "
     "top; RGBG of OLED panels, in cells of 2 x 2 pixels; thirds, with odd rows shifted by half a pixel to the right; or the "
     "rectangles of [[panel.subpixel]]."},
    {"subpixel_cell", &Panel::subpixel_cell, Range{1, 16}, false,
     "Period of custom subpixels: columns and rows of pixels after which they repeat, from the panel's top left corner.",
     "required for custom subpixels"},
    {"wavelengths_nm", &Panel::wavelengths_nm, wavelength_range, false,
     "Wavelengths at which red, green and blue are traced through dispersive glass. The default: dominant wavelengths of the sRGB "
     "primaries. Lengths that depend on an index are stated for green."},
    {"primary_widths_nm", &Panel::primary_widths_nm, width_range, false,
     "Full widths at half maximum of the primaries' spectra, for render.wavelength_samples.", "one wavelength each"},
    {"layer", &Panel::layers, no_range, false, ""},
    {"subpixel", &Panel::custom, no_range, false, ""},
};

constexpr Key<Subpixel> subpixel_keys[] = {
    {"channel", &Subpixel::channel, no_range, true, "Colour that it emits."},
    {"pixel", &Subpixel::pixel, Range{0, 15}, true, "Pixel of the cell whose value it shows: column and row, counted from 0."},
    {"rect", &Subpixel::rect, Range{-16, 32}, true,
     "Left, top, right and bottom edge, in pixels from the cell's top left corner. It may extend beyond the cell and repeats with "
     "it. Rectangles do not overlap."},
};

constexpr std::string_view no_index = "given by glass; exactly one of the two is required";
constexpr std::string_view glass_doc = "Glass, whose index depends on the wavelength: a name, or a table, as under Glass above.";
constexpr std::string_view no_glass = "given by index; exactly one of the two is required";

constexpr Key<Layer> layer_keys[] = {
    {"thickness_mm", &Layer::thickness_mm, positive_length, true, "Thickness of the plate."},
    {"index", &Layer::index, index_range, false, "Refractive index, the same for all wavelengths.", no_index},
    {"glass", &Layer::glass, no_range, false, glass_doc, no_glass},
};

constexpr std::string_view aperture_radius_doc =
    "r, radius of the lens's aperture. Circular apertures: 2 r is at most the smallest lens pitch. Cylindrical lenses: half the "
    "width. It may be left out for lenses that fill their cells: the lens then reaches the cell's corners, r = pitch/sqrt(2) in "
    "square cells.";
constexpr std::string_view no_aperture_radius = "required for round lenses; otherwise up to the cell's corners";

constexpr Key<Lens> lens_keys[] = {
    {"type", &Lens::kind, no_range, true,
     "A spherical plano-convex lens, a prescription of surfaces, a thin lens without aberrations, or a pinhole."},
    {"stop_radius_mm", &Lens::stop_radius_mm, positive_length, false,
     "Radius of an aperture stop in the plane of the curved vertex (of the last surface, of the thin lens): a black sheet with a "
     "hole for each lens.",
     "none"},
};

constexpr Key<PlanoConvex> plano_convex_keys[] = {
    {"sphere_radius_mm", &PlanoConvex::sphere_radius_mm, positive_length, true, "R, radius of the spherical cap. R >= r."},
    {"aperture_radius_mm", &PlanoConvex::aperture_radius_mm, positive_length, false, aperture_radius_doc, no_aperture_radius},
    {"cylinder_height_mm", &PlanoConvex::cylinder_height_mm, length_or_zero, false,
     "h, height of the wall under the cap. h <= 2 sqrt(R^2 - r^2)."},
    {"index", &PlanoConvex::index, index_range, false, "Refractive index, the same for all wavelengths.", no_index},
    {"glass", &PlanoConvex::glass, no_range, false, glass_doc, no_glass},
    {"facing", &PlanoConvex::facing, no_range, false, "Side to which the convex surface faces."},
};

constexpr Key<SurfaceLens> surfaces_keys[] = {
    {"surface", &SurfaceLens::surfaces, no_range, false, ""},
};

constexpr Key<IdealLens> ideal_keys[] = {
    {"aperture_radius_mm", &IdealLens::aperture_radius_mm, positive_length, false, aperture_radius_doc, no_aperture_radius},
    {"focal_length_mm", &IdealLens::focal_length_mm, positive_length, true, "Focal length of the thin lens."},
};

constexpr Key<Pinhole> pinhole_keys[] = {
    {"aperture_radius_mm", &Pinhole::aperture_radius_mm, positive_length, true,
     "Radius of a round hole; for strips, half the width of a slit. Twice this is at most the smallest lens pitch."},
};

constexpr Key<Surface> surface_keys[] = {
    {"curvature_per_mm", &Surface::curvature_per_mm, curvature_range, false,
     "1/R at the vertex. Sag is positive towards the viewer, so a last surface convex to the viewer has a negative curvature."},
    {"conic", &Surface::conic, coefficient_range, false, "Conic constant k: 0 for a sphere, -1 for a paraboloid."},
    {"even_asphere", &Surface::even_asphere, coefficient_range, false,
     "Aspheric coefficients [a4, a6, ...], in mm^-3, mm^-5, ... At most 8."},
    {"semi_aperture_mm", &Surface::semi_aperture_mm, positive_length, true, "Rays further than this from the axis are absorbed."},
    {"distance_mm", &Surface::distance_mm, length_or_zero, false,
     "Distance from this surface's vertex to that of the next. Ignored for the last surface."},
    {"index", &Surface::index, index_range, false,
     "Refractive index of the medium up to the next surface. Ignored for the last surface: air follows.",
     "1 (air), or given by glass"},
    {"glass", &Surface::glass, no_range, false, glass_doc, "given by index; not both"},
};

constexpr Key<LensArray> array_keys[] = {
    {"lattice", &LensArray::lattice, no_range, false,
     "Shape and arrangement of the lenses' cells: squares; rectangles; hexagons, corners up and down; rectangles whose rows "
     "alternate by half a pitch; or strips, which hold cylindrical lenses."},
    {"count", &LensArray::count, count_range, false,
     "Number of lenses across and up. Their product is below 2^31. Strips form one row.",
     "the smallest number that covers the panel"},
    {"pitch_mm", &LensArray::pitch_mm, positive_length, true,
     "Distance between the centres of neighbouring lenses: one number, or for rectangles and bricks two, along the array's rows "
     "and from row to row."},
    {"gap_mm", &LensArray::gap_mm, positive_length, false,
     "Reduced distance from the panel to the lens's panel-side principal plane: the sum of thickness / index of the layers and of "
     "the air.",
     "given by base_z_mm; exactly one of the two is required"},
    {"base_z_mm", &LensArray::base_z_mm, length_or_zero, false,
     "Distance from the panel to the lens's lowest point. A lens that is flat there and lies on the layers (or on the panel) is "
     "glued to them, without air between.",
     "given by gap_mm; exactly one of the two is required"},
    {"surround", &LensArray::surround, no_range, false,
     "Medium between the lenses: black walls; air and polished walls; or one moulded sheet. The last two need a lens of one glass "
     "body."},
    {"aperture", &LensArray::aperture, no_range, false, "Round lenses, or lenses that fill their cells."},
    {"offset_mm", &LensArray::offset_mm, any_length, false, "Offset of the array's centre from the panel's, after the rotation."},
    {"rotation_deg", &LensArray::rotation_deg, turn, false,
     "Rotation about the array's centre, counter-clockwise as the viewer sees it. Content of strips is for eyes side by side, of "
     "strips nearer to the horizontal than 15 degrees for eyes one above the other."},
    {"slant_deg", &LensArray::slant_deg, slant_range, false,
     "Slant of strips, in place of the rotation: angle of their axes from the vertical, positive where the upper ends lean to the "
     "viewer's right.",
     "the rotation with the opposite sign"},
};

constexpr Key<Diffuser> diffuser_keys[] = {
    {"distance_mm", &Diffuser::distance_mm, positive_length, true,
     "Distance from the array's viewer-side vertex plane. The diffuser is in front of all glass."},
    {"angle_deg", &Diffuser::angle_deg, angle, true,
     "Full scattering angles, or full widths at half maximum: horizontal, vertical."},
    {"profile", &Diffuser::profile, no_range, false, "Distribution of the scattering angles: uniform within the angle, or normal."},
};

constexpr Key<Camera> camera_keys[] = {
    {"position_mm", &Camera::position_mm, any_length, false, "Position, in front of the lenses and the diffuser."},
    {"target_mm", &Camera::target_mm, any_length, false, "Point that the camera looks at."},
    {"up", &Camera::up, any_length, false,
     "Direction that is upwards in the picture; not along the line of sight. Any length but 0."},
    {"frame_width_mm", &Camera::frame_width_mm, positive_length, false,
     "Width of the frame in the plane through the target, normal to the line of sight. Not together with fov_deg.",
     "1.03 x the larger of the panel's width and 16/9 of its height"},
    {"fov_deg", &Camera::fov_deg, open_angle, false, "Horizontal angle of view.", "given by frame_width_mm"},
    {"resolution", &Camera::resolution, count_range, false,
     "Number of columns and rows of the picture. Their product is below 2^31."},
    {"pixel_filter", &Camera::pixel_filter, no_range, false, "Rays through pixel centres, or distributed over the pixel."},
    {"pupil_diameter_mm", &Camera::pupil_diameter_mm, positive_length, false, "Pupil diameter of a thin-lens camera.", "a pinhole"},
    {"focus_distance_mm", &Camera::focus_distance_mm, positive_length, false,
     "Focus distance of a thin-lens camera, along the line of sight. Needs pupil_diameter_mm.", "the target's distance"},
};

constexpr Key<Render> render_keys[] = {
    {"estimator", &Render::estimator, no_range, false,
     "`filtered`: averages of the panel over the lenses' footprints where these agree with point samples, and point samples "
     "elsewhere and on a GPU; `point`: brute force, each sample reads one panel pixel; `lens_by_lens`: averages over footprints "
     "whether they agree or not, on the CPU. Without a diffuser and a pixel filter all samples are points."},
    {"samples", &Render::samples, Range{1, 16777216}, false,
     "Samples per picture pixel, where a diffuser, filter or pupil spreads the light. For filtered samples the number is rounded "
     "up to a square, 3844 at most.",
     "point: 100, or 256 on a GPU in place of filtered; filtered: 4, or as many points as a small error requires"},
    {"sampling", &Render::sampling, no_range, false, "Distribution of point samples: low-discrepancy, or plain random."},
    {"fresnel", &Render::fresnel, no_range, false,
     "Transmission of each glass surface: by Fresnel's equations, by Schlick's formula, or without loss."},
    {"seed", &Render::seed, Range{0, two_to_63}, false, "Seed of the samples. The same seed gives the same picture."},
    {"wavelength_samples", &Render::wavelength_samples, Range{1, double(max_wavelength_samples)}, false,
     "K: each channel is the sum over K wavelengths of its spectrum (Gauss-Hermite quadrature). More than 1 needs "
     "panel.primary_widths_nm."},
};

constexpr Key<Display> display_keys[] = {
    {"name", &Display::name, no_range, false, "Name of the display in reports and image files.", "", TextOf::label},
    {"glass_catalogues", &Display::glass_catalogues, no_range, false,
     "AGF files with glasses, relative to the description's folder; searched before the glasses that ship. At most 8."},
    {"panel", &Display::panel, no_range, true, ""},
    {"lens", &Display::lens, no_range, true, ""},
    {"array", &Display::array, no_range, true, ""},
    {"errors", &Display::errors, no_range, false, ""},
    {"diffuser", &Display::diffuser, no_range, false, ""},
    {"camera", &Display::camera, no_range, false, ""},
    {"content", &Display::content, no_range, false, ""},
    {"render", &Display::render, no_range, false, ""},
};

// Returns a number as a person writes it: limits that are powers of two as such.
std::string number(double x) {
    if (x == two_to_31) return "2^31";
    if (x == two_to_63) return "2^63 - 1";
    if (x == shortest_mm) return "1e-6";
    if (std::abs(x) == 1e6) return x > 0 ? "1e6" : "-1e6";
    return fmt::format("{}", x);
}

}  // namespace

template <>
constinit const Table<Display> TableOf<Display>::table{"", "", display_keys};
template <>
constinit const Table<Panel> TableOf<Panel>::table{
    "panel", "The screen behind the lenses. It lies in z = 0, centred, and faces the viewer at +z.", panel_keys};
template <>
constinit const Table<Layer> TableOf<Layer>::table{
    "layer", "A plane plate on the panel, the first one lying on it: cover glass, polariser, adhesive. At most 8.", layer_keys};
template <>
constinit const Table<Subpixel> TableOf<Subpixel>::table{
    "subpixel", "A rectangle that emits one colour; every colour needs one. At most 32, for subpixels = \"custom\".",
    subpixel_keys};
template <>
constinit const Table<Lens> TableOf<Lens>::table{"lens", "One lens of the array.", lens_keys};
template <>
constinit const Table<PlanoConvex> TableOf<PlanoConvex>::table{"plano_convex", "A spherical plano-convex lens.", plano_convex_keys};
template <>
constinit const Table<SurfaceLens> TableOf<SurfaceLens>::table{"surfaces", "A prescription of surfaces.", surfaces_keys};
template <>
constinit const Table<IdealLens> TableOf<IdealLens>::table{"ideal", "A thin lens without aberrations.", ideal_keys};
template <>
constinit const Table<Pinhole> TableOf<Pinhole>::table{
    "pinhole", "A black sheet with a hole for each lens, or for strips with a slit for each (a parallax barrier).", pinhole_keys};
template <>
constinit const Table<Surface> TableOf<Surface>::table{
    "surface", "The surfaces of the lens, from the panel's side to the viewer's; one [[lens.surface]] each, at most 16.",
    surface_keys};
template <>
constinit const Table<LensArray> TableOf<LensArray>::table{"array", "Arrangement of the lenses in front of the panel.", array_keys};
template <>
constinit const Table<Diffuser> TableOf<Diffuser>::table{
    "diffuser", "A thin scattering sheet in front of the lenses. Without this table there is none.", diffuser_keys};
template <>
constinit const Table<Camera> TableOf<Camera>::table{"camera", "The eye or camera that looks at the display.", camera_keys};
template <>
constinit const Table<Render> TableOf<Render>::table{"render", "How pictures are computed.", render_keys};

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
