// What follows from a display description: the positions of all parts, and paraxial theory. Floor 0, public.
#pragma once
#include "base/input_error.h"
#include "display/display.h"
#include "geometry/lattice.h"

#include <array>
#include <optional>
#include <vector>

namespace lfdsim {

/// Form of a surface: a glass surface of revolution about the lens's axis, or the plane of an ideal thin lens.
enum class SurfaceForm { revolution, thin };

/// A surface with its position: its points are at the heights z_mm + sag_mm(). A thin lens has no sag, and air on both sides.
struct PlacedSurface {
    double z_mm;                       // of its vertex on the axis, from the panel
    double curvature_per_mm;           // c; negative: convex to the viewer
    double conic;                      // k, the conic constant
    std::vector<double> even_asphere;  // a4 in 1/mm^3, a6 in 1/mm^5, ...
    double semi_aperture_mm;           // distance from the axis beyond which it absorbs
    double index_below, index_above;   // media on the panel's and on the viewer's side
    SurfaceForm form = SurfaceForm::revolution;
    double focal_length_mm = 0;  // f of a thin lens; infinite for a pinhole
};

/// A plane plate on the panel.
struct PlacedLayer {
    double thickness_mm, index;  // refractive index
};

/// A lens's pupil as an eye far away on its axis sees it, by paraxial optics: of the images of all apertures through the
/// surfaces in front of them, the narrowest. A ray parallel to the axis at the height 1 passes an aperture of radius r at the
/// height h: its image has the radius r / |h|.
struct Pupil {
    double radius_mm;               // of the round one: of surfaces and of the stop
    std::optional<double> inner_z;  // where that image is, from the panel, if it is not of what light meets first
    double cells;                   // the pupil's part of a cell that the lens fills, 1 or less: 1 over the greatest |h|
};

/// A valid display resolved to lengths on the z axis, with the errors of its array as a whole but for wedge and bow. All z in
/// mm from the panel.
struct Geometry {
    Lattice<double> lattice;              // where the lenses are
    double turn_deg;                      // of the array's frame against the display's, counter-clockwise to the viewer
    std::vector<PlacedSurface> surfaces;  // panel side first; at least one
    std::vector<PlacedLayer> layers;      // on the panel, from it upwards
    double layers_top_mm;                 // T, of the layers
    bool glued;                           // the lens's flat panel-side face lies on them, or on the panel, without air
    double base_z_mm;                     // lowest z of a lens, rims and sags included
    double top_z_mm;                      // highest z of a lens, rims and sags included
    double entrance_z_mm;                 // vertex of the surface that an eye's rays meet first
    double reduced_vertex_plane_mm;       // of the media on a lens's axis from the panel up to there: sum of thickness / index
    double vertex_plane_mm;               // viewer-side vertex plane: highest z of a lens on its axis
    double front_principal_mm;            // panel-side principal (= nodal) point
    double rear_principal_mm;             // viewer-side one
    double gap_mm;                        // g, panel to front_principal, layers counted by thickness / index
    double focal_length_mm;               // f, paraxial; infinite for an afocal lens
    double glass_radius_mm;  // plano_convex: r of the cap in glass (a lens that fills its cell: at least to the corners); else semi
                             // aperture
    Pupil pupil;             // of a lens
    std::array<double, 2> clear_aperture_mm;  // D, the pupil's width along the array's x' and y'
    double stop_z_mm;                         // plane of the curved vertex (last vertex for surfaces, lens for ideal)
    std::optional<double> diffuser_z_mm;
    double panel_width_mm, panel_height_mm;   // W and H
    double array_width_mm, array_height_mm;   // of the box about all cells, in the array's frame
    double frame_width_mm;                    // of the camera, resolved from frame_width_mm | fov_deg | default
    double focus_distance_mm;                 // of the camera
    double content_depth_mm;                  // of the model's centre; of objects midway between the nearest and the furthest
    std::optional<double> content_height_mm;  // absent: as high as the objects make it
};

/// Paraxial figures along one of the array's axes, x' or y', with p the pitch there (docs/model.md, "Theory").
struct AxisTheory {
    double fov_deg;                    // 2 atan(p / 2g)
    double fov_exact_deg;              // of the ray from p'/2 to the axis at the principal point, by Snell; NaN for glass lenses
    double fov_elemental_deg;          // 2 atan(p' / 2g), p' the elemental pitch: field of view of whole elemental images
    double views;                      // N = p / a; of strips p over a pixel's width across them, along line_of_eyes()
    double view_step_deg;              // FOV / N, of strips both along that line
    double viewing_zone_parallel_deg;  // whole screen, with elemental images of the pitch p
    double viewing_zone_deg;           // whole screen, with elemental images for the viewing distance, at the eye's distance
    double eyebox_mm;           // width of the region from which an eye sees the image that belongs to the middle lens: E p'/g
    double elemental_pitch_mm;  // p' = p (1 + g / (D' - z_H')), D' the viewing distance
    double lens_sampling_limit_per_mm;  // 1 / 2p
    double gap_closing_diffuser_deg;    // 2 atan(p / 2L), as published: of a diffuser at L
    double gap_closing_here_deg;        // 2 atan(p / 2d), d the diffuser's actual height above the apertures (dark_bands.h)
};

/// Paraxial theory, docs/model.md section "Theory". Infinite where a figure has no finite value, NaN where it is undefined.
struct Theory {
    std::array<AxisTheory, 2> along;  // along x' and y'; of strips, which do nothing along y', that is NaN
    // Of strips along the line of eyes (lattice.h), 2 atan(p / (2 g c)), c the width across strips of a width of 1 along it;
    // NaN for others.
    double fov_of_eyes_deg;
    // For pinholes, which have no image plane, all of these but the gap are NaN.
    double focal_length_mm;
    double gap_mm;
    double central_depth_mm;   // L, from the rear principal plane; negative: virtual
    double pixel_image_mm;     // P_I = a |L| / g
    double depth_of_field_mm;  // 2 |L| P_I / D, as published; D the lens's wider clear aperture, here and below
    // Depths z from the rear principal plane at which a lens's spot is no wider than a panel pixel's image, D |1 - z/L| <= a |z|/g:
    // |1/z - 1/L| <= a/(g D). One interval of 1/z, whatever L; where it contains 0, infinity is sharp.
    double depth_near_per_mm;         // 1/L + a/(g D)
    double depth_far_per_mm;          // 1/L - a/(g D)
    double pixel_image_limit_per_mm;  // 1 / 2 P_I
};

/// Returns all problems of a description, each with its TOML key ("lens.index") as `where`; none if it is valid.
std::vector<Problem> validate(const Display&);

/// Resolves a valid description, in the light of the green channel. Throws InputError with validate()'s problems otherwise.
Geometry resolve(const Display&);
/// Resolves a display in light of another wavelength, 100 to 10000 nm. Positions are those for green; indices, focal length,
/// principal points, gap and reduced lengths are those of that light. Throws InputError as the other resolve().
Geometry resolve(const Display&, double wavelength_nm);

/// Returns the paraxial theory of a display, for content made for the display as built.
Theory theory(const Display&, const Geometry&);

/// Returns the eye's distance from the panel that theory and measures assume, mm: that of the camera from the panel's centre.
double camera_distance_mm(const Display&);

/// Returns the depth 1/per_mm, mm from the rear principal plane towards the viewer; infinite for 0.
double depth_mm(double per_mm);

/// Returns whether theory calls a depth sharp by the pixel, |1/z - 1/L| <= a/(g D); z from the rear principal plane.
bool is_sharp(const Theory&, double z_mm);

/// Returns the sag z - z_vertex, mm, of a surface at distance s, mm, from its axis: c s^2/(1 + sqrt(1 - (1+k) c^2 s^2)) + a4 s^4
/// + ..., c in 1/mm; NaN where it is not real.
double sag_mm(double curvature, double conic, const std::vector<double>& even_asphere, double s);

/// Returns the least distance of an eye from the panel, mm: it must be in front of the diffuser, the lenses and their principal
/// plane.
double nearest_eye_mm(const Geometry&);

}  // namespace lfdsim
