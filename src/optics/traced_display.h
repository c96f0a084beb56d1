// The tracer's input: a display as plain numbers of one type S (float or double), without functions, common to all instruction sets
// and ready for another device. Floor 1.
//
// z is in mm from the panel. Surfaces are in the order in which backward rays meet them, from the viewer's side.
// Filled by engine/scene/traced_display.cpp from a Display and its Geometry.
#pragma once
#include <cstdint>

#include "display/enums.h"
#include "geometry/lattice.h"

namespace lfdsim::optics {

enum class Shape : std::int32_t { plane, sphere, conic, asphere };

/// The two media at a surface, as Snell's law and Fresnel's equations need them.
template <class S>
struct Interface {
    S eta;  // index of the viewer's side / index of the panel's side: for rays going down
    S n_above, n_below;
    S schlick_t0;  // 1 - R0
};

/// A surface of revolution about its lens's axis.
template <class S>
struct SurfaceData {
    Shape shape;
    std::int32_t terms;            // of the even asphere
    S z;                           // vertex
    S curvature;                   // 1/mm
    S conic;                       // k
    S asphere[max_asphere_terms];  // a4, a6, ...
    S semi_aperture;
    S rim;        // sag at the semi aperture
    S low, high;  // of the sag within the aperture
    S c_rim;      // curvature x rim: c z <= c_rim inside the rim, on the sheet that contains the vertex
    Interface<S> media;
};

/// A plate on the panel.
template <class S>
struct LayerData {
    S thickness;
    Interface<S> media;  // at its upper face: of the top one air above it, however the lens lies on it
};

/// A part of a panel's subpixel, in a cell of some pixels that repeats over the panel. Places are shares of the cell's width and
/// height, from its left and top (x, y).
template <class S>
struct SubpixelPart {
    std::int32_t channel;      // 0, 1, 2; 3: all colours
    std::int32_t cell[2];      // pixels
    S per_cell[2];             // 1 / cell
    std::int32_t pixel[2];     // whose light it shows, from the cell's first
    std::int32_t plane;        // the number of the picture of those pixels of all cells (engine/estimator/panel_planes.h)
    S from[2], to[2], per[2];  // per: 1 / (to - from)
    S share;                   // of the channel's light
};

/// The parts of a panel that shine; dark around them, and so much brighter in them that a cell's mean is its pixels' light.
template <class S>
struct Emission {
    bool whole;  // each pixel shines all over, in its colour: no parts
    std::int32_t count;
    SubpixelPart<S> part[max_subpixel_parts];
};

/// Pose of a misaligned lens relative to its lattice position (array frame).
template <class S>
struct MisalignedLens {
    S place[4];  // x, y, z of its viewer-side vertex from there, mm; its curvature as a share of that of the others
    S turn[4];   // cosine and sine of its turn about x', and then of that about y'
};

/// An array with errors (optics/misaligned.h).
template <class S>
struct MisalignedArray {
    bool given;                     // else none of the rest means anything
    bool tilted, curved, wedged;    // some lens is; the array is not parallel to the panel
    const MisalignedLens<S>* lens;  // row by row from the lower left; null: all are at their lattice positions
    S vertex_z;                     // of the viewer-side vertex plane, in the array's middle
    S wedge[3][3];                  // from the array's frame to that turned about z alone
    S overhang;                     // mm by which a lens stands out of its cell at most; negative: by which it stays inside
    S radius;                       // of a circle about a lens's place in the lattice in which it stays
    S lowest, highest;              // of all lenses' z
    S search_top, search_bottom;    // highest and lowest z from the vertex plane at which lenses are met
};

template <class S>
struct TracedDisplay {
    // panel
    std::uint32_t columns, rows;
    S pixels_per_mm;
    S emission_exponent;
    Emission<S> emission;
    std::int32_t layer_count;
    LayerData<S> layer[max_layers];  // from the top one downwards
    S layers_top;

    // lens
    bool ideal;  // ideal or a pinhole
    bool glued;  // its last surface borders on the layers, or on the panel
    std::int32_t surface_count;
    SurfaceData<S> surface[max_surfaces];
    S ideal_z, ideal_power;  // of a thin lens; 1/f, of a pinhole 0
    S aperture_radius;       // of a thin lens, if it is round
    Aperture aperture;
    bool has_stop;
    S stop_z, stop_radius2;

    // array; the tracer works in the frame of the array, turned by the rotation about z
    Surround surround;
    Lattice<S> lattice;
    S pitch_pixels[2];  // the pitch in panel pixels
    bool rotated;
    MisalignedArray<S> misaligned;
    S start_above;            // height of the first plane above the first vertex (ideal: above the lens)
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
    S within_horizon[2];  // the share of a normal distribution that is turned by less than 89 degrees
    bool small_angles;    // box: both half angles below 0.05 rad

    // camera samples
    bool box_filter, thin_lens;
};

/// The camera, and what is needed to start a ray near a lens, in double precision. Units: mm.
struct RayOrigin {
    double position[3], forward[3], right[3], up[3];  // orthonormal; forward looks into the picture
    double distance;                                  // to the frame, along forward
    double pixel_mm;                                  // size of a picture element in the plane of the frame
    double pupil_radius, frame_per_focus;             // thin lens: radius; distance of the frame / distance of focus
    std::int32_t width, height;                       // of the whole frame
    double start_z;                                   // the first plane
    Lattice<double> lattice;
    bool wedged;         // the array is turned about its middle, at the height of its vertex plane:
    double wedge[3][3];  // from the array's frame to that turned about z alone
    double panel_width, panel_height, pixels_per_mm;
    std::uint64_t seed;
};

/// An image of columns x rows pixels, 4 floats each (R, G, B, 0), and its summed-area table.
struct SummedImage {
    /// Units of light that a white pixel has in the table, and the most white pixels whose sum is below 2^31. Light of 16-bit
    /// linear codes is a whole number of units.
    static constexpr int units = 8 * 65535, most_pixels = 4096;

    const float* texels;
    const std::uint32_t* sums;  // (columns + 1) x (rows + 1) x 4: of all pixels above and to the left, modulo 2^32; null: none
    float light_per_unit;
    std::uint32_t columns, rows;
};

/// What the filtered estimator reads of a panel: the panel itself, then the further planes of its subpixels
/// (engine/estimator/summed_panel.h).
struct PanelLight {
    const SummedImage* plane;
    bool whole;  // each pixel shines all over, in its colour, as `emission` says, which else has the parts
    const Emission<float>* emission;
};

/// Dimensions 0, 1: diffuser; 2, 3: position in the pixel; 4, 5: position in the pupil.
constexpr int sampler_dimensions = 6;

/// Direction numbers (Joe and Kuo 2008, new-joe-kuo-6), one row a dimension.
struct DirectionNumbers {
    std::uint32_t v[sampler_dimensions][32];
};

}  // namespace lfdsim::optics
