// The tracer's input: a display as plain numbers of one type S (float or double), without functions, common to all instruction sets
// and ready for another device. Floor 1.
//
// Lengths are in mm, z is counted from the panel. Surfaces are in the order in which backward rays meet them, from the viewer's
// side. engine/scene/traced_display.cpp fills these structs from a Display and its Geometry. The equations that use the numbers are
// in docs/model.md, "Lenses" and the sections after it.
#pragma once
#include <cstdint>

#include "display/enums.h"
#include "geometry/lattice.h"

namespace lfdsim::optics {

/// The form of a surface, which decides how a ray's intersection is computed: in closed form, but for an asphere.
enum class Shape : std::int32_t { plane, sphere, conic, asphere };

/// The two media at a surface, as Snell's law and Fresnel's equations need them.
template <class S>
struct Interface {
    S eta;               // n_above / n_below, for rays that go down
    S n_above, n_below;  // refractive indices on the viewer's side and on the panel's
    S schlick_t0;        // 1 - R0, R0 = ((n_above - n_below)/(n_above + n_below))^2: what passes at normal incidence
};

/// A surface of revolution about its lens's axis; of a strip the section of a cylinder along y'. Sags are along +z from the vertex.
template <class S>
struct SurfaceData {
    Shape shape;
    std::int32_t terms;            // number of asphere coefficients in use; 0 unless `shape` is asphere
    S z;                           // height of the vertex
    S curvature;                   // c, 1/mm; negative: convex to the viewer
    S conic;                       // k, the conic constant
    S asphere[max_asphere_terms];  // a4 in 1/mm^3, a6 in 1/mm^5, ...
    S semi_aperture;               // distance from the axis beyond which the surface absorbs
    S rim;                         // sag at the semi-aperture
    S low, high;                   // lowest and highest sag within the semi-aperture, of any lens where curvatures differ
    S c_rim;                       // curvature x rim: c z <= c_rim inside the rim, on the sheet that contains the vertex
    Interface<S> media;
};

/// A plate on the panel.
template <class S>
struct LayerData {
    S thickness;
    Interface<S> media;  // at its upper face: of the top one air above it, however the lens lies on it
};

/// A rectangle of the panel that emits one channel, in a cell of panel pixels that repeats over the panel (docs/model.md,
/// "Subpixels"). Pairs are along x, then y; places are shares of the cell's width and height, from its left and top.
template <class S>
struct SubpixelPart {
    std::int32_t channel;      // 0, 1, 2: red, green, blue; 3: all colours
    std::int32_t cell[2];      // size of the cell, pixels
    S per_cell[2];             // 1 / cell
    std::int32_t pixel[2];     // the pixel whose light it shows, column and row from the cell's first
    std::int32_t plane;        // number of the picture that consists of these pixels of all cells (engine/estimator/panel_planes.h)
    S from[2], to[2], per[2];  // its left and top; its right and bottom; 1 / (to - from)
    S share;                   // its share of the channel's light
};

/// The parts of a panel that emit. The panel is dark around them and brighter in them, by share / ((to - from)_x (to - from)_y), so
/// that the mean over a cell is its pixels' light.
template <class S>
struct Emission {
    bool whole;          // each pixel emits all its colours over its whole area: there are no parts
    std::int32_t count;  // number of parts
    SubpixelPart<S> part[max_subpixel_parts];
};

/// Pose of a misaligned lens relative to its lattice position (array frame).
template <class S>
struct MisalignedLens {
    S place[4];  // x', y', z of its viewer-side vertex from there, mm; the factor 1 + e of its curvatures (ideal lens: of 1/f)
    S turn[4];   // cosine and sine of its tilt about x', cosine and sine of that about y'
};

/// An array with errors (docs/model.md, "Errors"; optics/misaligned.h). The last four rows bound which lenses a ray may meet.
template <class S>
struct MisalignedArray {
    bool given;                     // there are errors that the tracer treats; else no other member counts
    bool tilted, curved, wedged;    // some lens is tilted; curvatures differ; the array is not parallel to the panel
    const MisalignedLens<S>* lens;  // row by row from the lower left; null: all are at their lattice positions
    S vertex_z;                     // height of the viewer-side vertex plane above the panel, in the array's middle
    S wedge[3][3];                  // from the array's frame to that turned about z alone
    S overhang;                     // the most by which a lens protrudes from its cell; negative: all end that far inside
    S radius;                       // of a circle about a lens's lattice position that contains the lens, in a view from above
    S lowest, highest;              // of the heights of vertices over their lattice positions; lowest <= 0 <= highest
    S search_top, search_bottom;    // highest and lowest z from the vertex plane at which rays meet first surfaces
};

/// A display for one wavelength. "Ideal" lenses include pinholes, whose power is 0.
template <class S>
struct TracedDisplay {
    // panel
    std::uint32_t columns, rows;
    S pixels_per_mm;      // 1/a
    S emission_exponent;  // m of cos^m; 0: Lambertian
    Emission<S> emission;
    std::int32_t layer_count;
    LayerData<S> layer[max_layers];  // from the top one downwards
    S layers_top;                    // height of the top layer's upper face

    // lens
    bool ideal;  // ideal or a pinhole
    bool glued;  // its last surface borders on the layers, or on the panel
    std::int32_t surface_count;
    SurfaceData<S> surface[max_surfaces];
    S ideal_z, ideal_power;  // height of an ideal lens's plane; 1/f in 1/mm, of a pinhole 0
    S aperture_radius;       // of an ideal lens, where `aperture` is a circle
    Aperture aperture;
    bool has_stop;
    S stop_z, stop_radius2;  // height of the sheet; the square of its holes' radius, mm^2

    // array; the tracer works in the frame of the array, turned by the rotation about z
    Surround surround;
    Lattice<S> lattice;
    S pitch_pixels[2];  // the pitch in panel pixels
    bool rotated;       // the array's axes are not the panel's
    MisalignedArray<S> misaligned;
    S start_above;            // height of the first plane above the first vertex (ideal: above the lens); 0 without a diffuser
    S zone_top, zone_bottom;  // where an entering ray may meet the first surface: highest and lowest z of its caps
    S body_top, body_bottom;  // highest and lowest z of a lens
    S wall_bottom;            // the lowest rim: where the black part ends
    bool concave_front;       // the first surface lies below its rim (concave to the viewer): its rim is the entrance
    bool concave_back;        // the last surface lies above the lowest rim (concave to the panel)

    // the holes through which light enters the lenses, for the filtered estimator (strata.h)
    S holes_below[2];  // height of the first plane of the display above the holes' edges across x' and y'
    S hole_radius;     // of round ones; 0: the cells themselves, or slits
    S hole_half;       // strips: half the width of what light enters
    bool lit_between;  // light goes on between them too

    // light
    Fresnel fresnel;
    bool has_diffuser;
    Profile diffuser_profile;
    S angle_scale[2];     // about y and about x, radians: see diffuser.h
    S within_horizon[2];  // the share of the light that is turned by less than 89 degrees
    bool small_angles;    // box: both half angles below 0.05 rad

    // camera
    bool box_filter, thin_lens;  // rays are spread over the pixel's area; over a pupil
};

/// The camera, and what is needed to start a ray near a lens, in double precision; mm, in the display's frame.
struct RayOrigin {
    double position[3], forward[3], right[3], up[3];  // orthonormal; forward looks into the picture
    double distance;                                  // to the frame, along forward
    double pixel_mm;                                  // width of the picture's pixels in the plane of the frame
    double pupil_radius, frame_per_focus;             // thin lens: radius; distance of the frame / distance of focus
    std::int32_t width, height;                       // of the whole frame, pixels
    double start_z;                                   // height of the display's first plane: the diffuser, or the first vertex
    Lattice<double> lattice;
    bool wedged;         // the array is turned about its middle, at the height of its vertex plane:
    double wedge[3][3];  // from the array's frame to that turned about z alone
    double panel_width, panel_height, pixels_per_mm;
    std::uint64_t seed;  // of the sample numbers
};

/// An image of columns x rows pixels, 4 floats each (R, G, B, 0), and its summed-area table (docs/model.md, "Filtered estimator").
struct SummedImage {
    /// Units of light that a white pixel has in the table, and the number of white pixels whose sum is still below 2^31. Light of
    /// 16-bit linear codes is a whole number of units.
    static constexpr int units = 8 * 65535, most_pixels = 4096;

    const float* texels;
    const std::uint32_t* sums;  // (columns + 1) x (rows + 1) x 4: of all pixels above and to the left, modulo 2^32; null: none
    float light_per_unit;       // 1/units, larger by a power of two where the image has light above white
    std::uint32_t columns, rows;
};

/// What the filtered estimator reads of a panel: the panel itself, then the further planes of its subpixels
/// (engine/estimator/summed_panel.h).
struct PanelLight {
    const SummedImage* plane;
    bool whole;                       // emission->whole: each pixel emits all its colours over its whole area
    const Emission<float>* emission;  // the parts that emit
};

/// The number of a sample's dimensions: 0 and 1 are the diffuser's, 2 and 3 the position in the pixel, 4 and 5 that in the pupil.
constexpr int sampler_dimensions = 6;

/// Direction numbers of the Sobol sequence (Joe and Kuo 2008, new-joe-kuo-6), one row a dimension.
struct DirectionNumbers {
    std::uint32_t v[sampler_dimensions][32];
};

}  // namespace lfdsim::optics
