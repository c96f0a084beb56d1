// A light field display and the eye that looks at it, as its description file gives them. Floor 0, public: plain data, no I/O.
// Lengths in millimetres, angles in degrees (fields that end in _deg). Keys, ranges and defaults: docs/format.md.
// Frame: the panel lies in z = 0 centred on the origin and faces +z; +x is the viewer's right, +y is up.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "display/enums.h"
#include "display/glass.h"
#include "display/misalignment.h"

namespace lfdsim {

using Vec3d = std::array<double, 3>;

// A medium has an index that is the same for all wavelengths, or a glass.

/// A plane plate, wide without end.
struct Layer {
    double thickness_mm = 0;
    std::optional<double> index = {};
    std::optional<Glass> glass = {};
    bool operator==(const Layer&) const = default;
};

/// A rectangle of the panel that shines in one colour.
struct Subpixel {
    Channel channel = Channel::r;
    std::array<std::int64_t, 2> pixel{};  // whose value it shows: column and row in the cell
    std::array<double, 4> rect{};         // left, top, right, bottom in pixels from the cell's top left corner
    bool operator==(const Subpixel&) const = default;
};

struct Panel {
    std::array<std::int64_t, 2> pixels{};  // columns, rows
    double pixel_pitch_mm = 0;
    Encoding encoding = Encoding::srgb;
    double emission_exponent = 0;  // m of cos(theta)^m, 0 = Lambertian
    double aperture_ratio = 1;     // q, the share of each subpixel that shines; in the black matrix around it there is no light
    SubpixelLayout subpixels = SubpixelLayout::none;           // none: a pixel shines in all colours at once
    std::optional<std::array<std::int64_t, 2>> subpixel_cell;  // of a custom layout: the columns and rows after which it repeats
    std::vector<Layer> layers;                                 // on the panel, from it upwards: cover glass, polariser, adhesive
    std::vector<Subpixel> custom;                              // of a custom layout
    Vec3d wavelengths_nm{611.4, 549.1, 464.2};                 // of red, green and blue; dominant ones of the sRGB primaries
    std::optional<Vec3d> primary_widths_nm = {};               // full widths at half maximum; absent: single wavelengths
    bool operator==(const Panel&) const = default;
};

/// A surface of revolution about the lens axis, as a lens prescription lists it, from the panel side to the viewer's.
struct Surface {
    double curvature_per_mm = 0;       // c; positive sag is +z, so a last surface convex to the viewer has c < 0
    double conic = 0;                  // k
    std::vector<double> even_asphere;  // a4, a6, ... (1/mm^3, 1/mm^5, ...)
    double semi_aperture_mm = 0;
    double distance_mm = 0;            // vertex to vertex, to the next surface; ignored on the last
    std::optional<double> index = {};  // of the medium up to the next surface; ignored on the last
    std::optional<Glass> glass = {};   // without both: air
    bool operator==(const Surface&) const = default;
};

struct PlanoConvex {
    double sphere_radius_mm = 0;               // R
    std::optional<double> aperture_radius_mm;  // r; may be absent of a lens that fills its cell
    double cylinder_height_mm = 0;             // h
    std::optional<double> index = {};          // n
    Facing facing = Facing::viewer;
    std::optional<Glass> glass = {};
    bool operator==(const PlanoConvex&) const = default;
};

struct SurfaceLens {
    std::vector<Surface> surfaces;
    bool operator==(const SurfaceLens&) const = default;
};

struct IdealLens {
    std::optional<double> aperture_radius_mm;  // r; may be absent of a lens that fills its cell
    double focal_length_mm = 0;                // f
    bool operator==(const IdealLens&) const = default;
};

/// A black sheet with a hole for each lens, of strips a slit.
struct Pinhole {
    double aperture_radius_mm = 0;
    bool operator==(const Pinhole&) const = default;
};

using LensKind = std::variant<PlanoConvex, SurfaceLens, IdealLens, Pinhole>;  // in the order of LensType

struct Lens {
    LensKind kind;
    std::optional<double> stop_radius_mm;  // aperture stop in the plane of the curved vertex

    LensType type() const { return LensType(kind.index()); }
    bool is_thin() const { return type() == LensType::ideal || type() == LensType::pinhole; }  // a plane without glass
    template <class Kind>
    Kind& as() {  // throws std::bad_variant_access for a lens of another kind
        return std::get<Kind>(kind);
    }
    template <class Kind>
    const Kind& as() const {
        return std::get<Kind>(kind);
    }
    bool operator==(const Lens&) const = default;
};

/// The distances between neighbouring lenses along the array's own x (0) and y (1), mm. A description has one number where both
/// are the same.
struct Pitch : std::array<double, 2> {
    Pitch() : array{} {}
    Pitch(double both) : array{both, both} {}
    Pitch(double along_x, double along_y) : array{along_x, along_y} {}
    bool is_one() const { return !(at(0) < at(1) || at(0) > at(1)); }  // also for NaN, which both then are
    double least() const { return std::min(at(0), at(1)); }
};

struct LensArray {
    LatticeKind lattice = LatticeKind::square;
    std::optional<std::array<std::int64_t, 2>> count;  // nx, ny; absent: the least that cover the panel (lattice.h)
    Pitch pitch_mm;                                    // px, py
    std::optional<double> gap_mm;                      // panel to the lens's panel-side principal plane; exactly one of the two
    std::optional<double> base_z_mm;                   // panel to the lens's lowest z
    Surround surround = Surround::opaque;
    Aperture aperture = Aperture::circle;
    std::array<double, 2> offset_mm{};
    double rotation_deg = 0;          // counter-clockwise as the viewer sees it, about the array's centre, before the offset
    std::optional<double> slant_deg;  // of strips' axes from the vertical, their upper ends to the viewer's right

    /// The array's frame is turned by this against the display's, counter-clockwise.
    double turn_deg() const { return slant_deg ? -*slant_deg : rotation_deg; }
    bool operator==(const LensArray&) const = default;
};

struct Diffuser {
    double distance_mm = 0;             // from the array's viewer-side vertex plane
    std::array<double, 2> angle_deg{};  // full angles (box) or full widths at half maximum (gaussian): horizontal, vertical
    Profile profile = Profile::box;
    bool operator==(const Diffuser&) const = default;
};

struct Camera {
    Vec3d position_mm{0, 0, 2000};
    Vec3d target_mm{0, 0, 0};
    Vec3d up{0, 1, 0};
    std::optional<double> frame_width_mm;  // width of the frame in the plane through the target; or fov_deg; default in geometry.h
    std::optional<double> fov_deg;         // horizontal
    std::array<std::int64_t, 2> resolution{3840, 2160};
    PixelFilter pixel_filter = PixelFilter::center;
    std::optional<double> pupil_diameter_mm;  // thin-lens camera; absent: pinhole
    std::optional<double> focus_distance_mm;  // along the view axis; default: the target's distance
    bool operator==(const Camera&) const = default;
};

/// The light in which content is shaded.
struct ContentLight {
    Vec3d direction{0.3, 0.5, 0.81};  // towards it; only the direction counts
    double strength = 0.8;            // added to the ambient term where a surface faces it
    double ambient = 0.2;
    bool operator==(const ContentLight&) const = default;
};

/// An object of a scene: a mesh, or a picture on a rectangle.
struct SceneObject {
    std::string model;                // mesh file, as content.model; one of the two is given, the other empty
    std::string image;                // picture file
    Vec3d position_mm{};              // of its middle: x and y from the panel's, z from the viewer-side vertex plane
    std::optional<double> height_mm;  // exactly one of these three
    std::optional<double> width_mm;
    std::optional<double> unit_mm;  // length of a model file's unit
    double roll_deg = 0;            // about z, first; counter-clockwise as the viewer sees it
    double tilt_deg = 0;            // about x, then; positive raises the front
    double yaw_deg = 0;             // about y, last; counter-clockwise seen from above
    std::optional<Vec3d> colour;    // sRGB, in place of a model file's colours and textures
    Shading shading = Shading::file;
    bool operator==(const SceneObject&) const = default;
};

/// The inverse pick-up (docs/inverse.md): the panel picture whose views are best.
struct Inverse {
    std::vector<Vec3d> eyes_mm;          // opposite corners of boxes of eye places, two for each box; default: the viewing zone
    std::array<double, 2> levels{0, 1};  // light of the content's black and white, over that of a white panel
    std::optional<std::int64_t> places;  // eyes fitted
    std::optional<std::int64_t> rays;    // of an element of a view
    std::int64_t held_out = 8;           // further eyes, never fitted, which choose the panel
    std::optional<double> rim;           // view steps around a box in which further eyes count a quarter; default 3, of strips 0
    std::optional<double> pupil_mm;      // default: the camera's, else 4
    std::optional<double> pixel_mm;      // an element of a view, in the plane of the content's middle
    std::optional<double> prior;         // pull to traced content; default 0.001
    ErrorOf weighting = ErrorOf::eye;
    std::int64_t iterations = 20;     // at most
    std::string start;                // picture that the fit begins with; empty: traced content
    std::optional<double> memory_mb;  // for rays that are kept; default: half of what is free
    bool operator==(const Inverse&) const = default;
};

struct Content {
    std::string model;               // mesh file; relative to the description file; empty: none
    std::optional<double> depth_mm;  // of the model's centre, from the viewer-side vertex plane; default L, or 0 where L is too far
    std::optional<double> height_mm;      // default half the panel's height; of objects as they are
    double tilt_deg = 0;                  // about x, before the yaw; positive raises the front
    double yaw_deg = 0;                   // counter-clockwise seen from above
    double viewing_distance_mm = 2000;    // from the panel; infinity allowed
    std::optional<double> view_cone_deg;  // that the views of a quilt made for the display span; absent: quilts have another one
    PickupKind pickup = PickupKind::nodal;
    std::int64_t pickup_rays = 16;  // of the integrated pick-up
    Inverse inverse;
    ContentSampling sampling = ContentSampling::subpixel;
    MadeFor made_for = MadeFor::description;
    ContentLight light;
    std::vector<SceneObject> objects;  // in place of the model; depth, height, tilt and yaw are then of them all together
    bool operator==(const Content&) const = default;
};

/// Default samples per pixel where single rays are cast.
inline constexpr std::int64_t default_points = 100;

struct Render {
    Estimator estimator = Estimator::filtered;
    std::optional<std::int64_t> samples;  // default: 4 filtered ones, or 100 points
    Sampling sampling = Sampling::sobol;
    Fresnel fresnel = Fresnel::exact;
    std::int64_t seed = 0;
    std::int64_t wavelength_samples = 1;  // K, wavelengths at which each channel is traced
    bool operator==(const Render&) const = default;
};

struct Display {
    std::string name;
    std::vector<std::string> glass_catalogues;  // AGF files, relative to the working directory; glasses are looked up already
    Panel panel;
    Lens lens;
    LensArray array;
    Errors errors;
    std::optional<Diffuser> diffuser;
    Camera camera;
    Content content;
    Render render;
    bool operator==(const Display&) const = default;
};

}  // namespace lfdsim
