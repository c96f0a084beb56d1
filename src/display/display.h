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

// A medium has an index that is the same for all wavelengths, or a glass. Layers and lenses have exactly one of the two; a surface
// without both is followed by air.

/// A plane plate on the panel, laterally infinite. docs/model.md, "Layers on the panel, and lenses glued on".
struct Layer {
    double thickness_mm = 0;
    std::optional<double> index = {};
    std::optional<Glass> glass = {};
    bool operator==(const Layer&) const = default;
};

/// A rectangle of a custom layout that emits one channel, repeated with its cell of pixels. docs/model.md, "Subpixels".
struct Subpixel {
    Channel channel = Channel::r;
    std::array<std::int64_t, 2> pixel{};  // whose value it shows: column and row in the cell, from 0
    std::array<double, 4> rect{};         // left, top, right, bottom in pixels from the cell's top left corner
    bool operator==(const Subpixel&) const = default;
};

/// The emitting surface in the plane z = 0, W = columns a by H = rows a. docs/model.md, "Panel".
struct Panel {
    std::array<std::int64_t, 2> pixels{};  // columns, rows
    double pixel_pitch_mm = 0;             // a, along both axes
    Encoding encoding = Encoding::srgb;
    double emission_exponent = 0;  // m of cos(theta)^m, 0 = Lambertian
    double aperture_ratio = 1;     // q, the share of the panel's area that emits; the mean of a white panel is 1 for any q
    SubpixelLayout subpixels = SubpixelLayout::none;           // none: all of a pixel's area emits its colour
    std::optional<std::array<std::int64_t, 2>> subpixel_cell;  // of a custom layout: the columns and rows after which it repeats
    std::vector<Layer> layers;                                 // on the panel, from it upwards: cover glass, polariser, adhesive
    std::vector<Subpixel> custom;                              // of a custom layout
    Vec3d wavelengths_nm{611.4, 549.1, 464.2};                 // of red, green and blue; dominant ones of the sRGB primaries
    std::optional<Vec3d> primary_widths_nm = {};               // full widths at half maximum; absent: single wavelengths
    bool operator==(const Panel&) const = default;
};

/// A surface of revolution about the lens axis, of strips extruded along y', as a prescription lists it from the panel's side to
/// the viewer's: sag(s) = c s^2 / (1 + sqrt(1 - (1 + k) c^2 s^2)) + a4 s^4 + a6 s^6 + ... docs/model.md, "Lenses".
struct Surface {
    double curvature_per_mm = 0;       // c; positive sag is +z, so a last surface convex to the viewer has c < 0
    double conic = 0;                  // k
    std::vector<double> even_asphere;  // a4, a6, ... (1/mm^3, 1/mm^5, ...), max_asphere_terms at most
    double semi_aperture_mm = 0;       // distance from the axis beyond which the surface absorbs
    double distance_mm = 0;            // vertex to vertex, to the next surface; ignored on the last
    std::optional<double> index = {};  // of the medium up to the next surface; ignored on the last
    std::optional<Glass> glass = {};   // without both: air
    bool operator==(const Surface&) const = default;
};

/// A flat disk of radius r, a cylinder on it, and on that the cap of a sphere. docs/model.md, "Lenses".
struct PlanoConvex {
    double sphere_radius_mm = 0;               // R >= r
    std::optional<double> aperture_radius_mm;  // r; may be absent of a lens that fills its cell
    double cylinder_height_mm = 0;             // h <= 2 sqrt(R^2 - r^2), or the sphere would cut the disk
    std::optional<double> index = {};          // n
    Facing facing = Facing::viewer;
    std::optional<Glass> glass = {};
    bool operator==(const PlanoConvex&) const = default;
};

/// A lens by its prescription.
struct SurfaceLens {
    std::vector<Surface> surfaces;  // 1 to max_surfaces, from the panel's side to the viewer's
    bool operator==(const SurfaceLens&) const = default;
};

/// A thin lens in one plane, without aberration and loss: at the distance q from its axis it changes a slope by q/f.
struct IdealLens {
    std::optional<double> aperture_radius_mm;  // r; may be absent of a lens that fills its cell
    double focal_length_mm = 0;                // f > 0
    bool operator==(const IdealLens&) const = default;
};

/// A black sheet with a hole for each lens, of strips a slit.
struct Pinhole {
    double aperture_radius_mm = 0;  // of the hole; half the width of a slit
    bool operator==(const Pinhole&) const = default;
};

using LensKind = std::variant<PlanoConvex, SurfaceLens, IdealLens, Pinhole>;  // in the order of LensType

/// The lens of which the array has one in each cell.
struct Lens {
    LensKind kind;
    std::optional<double> stop_radius_mm;  // aperture stop in the plane of the curved vertex; docs/model.md, "Apertures and stops"

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

/// The distances p_x (0) and p_y (1) between neighbouring lens axes along the array's x' and y', mm. A description has one number
/// where both are the same.
struct Pitch : std::array<double, 2> {
    Pitch() : array{} {}
    Pitch(double both) : array{both, both} {}
    Pitch(double along_x, double along_y) : array{along_x, along_y} {}
    bool is_one() const { return !(at(0) < at(1) || at(0) > at(1)); }  // also for NaN, which both then are
    double least() const { return std::min(at(0), at(1)); }
};

/// The arrangement of the lenses before the panel. docs/model.md, "Lens array and surround".
struct LensArray {
    LatticeKind lattice = LatticeKind::square;
    std::optional<std::array<std::int64_t, 2>> count;  // nx, ny; absent: the least that cover the panel (lattice.h)
    Pitch pitch_mm;                                    // px, py
    std::optional<double> gap_mm;                      // g, reduced distance from the panel to H; given: base_z_mm is not
    std::optional<double> base_z_mm;                   // z of the lens's lowest point; given: gap_mm is not
    Surround surround = Surround::opaque;
    Aperture aperture = Aperture::circle;
    std::array<double, 2> offset_mm{};  // of the array's centre from the panel's, along the display's x and y
    double rotation_deg = 0;            // counter-clockwise as the viewer sees it, about the array's centre, before the offset
    std::optional<double> slant_deg;    // of strips' axes from the vertical, their upper ends to the viewer's right

    /// Returns the rotation of the array's frame against the display's, degrees counter-clockwise: a slant is one of opposite sign.
    double turn_deg() const { return slant_deg ? -*slant_deg : rotation_deg; }
    bool operator==(const LensArray&) const = default;
};

/// A thin plane that turns rays by random angles, laterally infinite. docs/model.md, "Diffuser".
struct Diffuser {
    double distance_mm = 0;             // from the array's viewer-side vertex plane
    std::array<double, 2> angle_deg{};  // full angles (box) or full widths at half maximum (gaussian): horizontal, vertical
    Profile profile = Profile::box;
    bool operator==(const Diffuser&) const = default;
};

/// The eye or camera, a pinhole or a thin lens, in the display's frame. docs/model.md, "Camera".
struct Camera {
    Vec3d position_mm{0, 0, 2000};
    Vec3d target_mm{0, 0, 0};
    Vec3d up{0, 1, 0};                     // only its direction counts, across the line of sight
    std::optional<double> frame_width_mm;  // width of the frame in the plane through the target; or fov_deg; default in geometry.h
    std::optional<double> fov_deg;         // horizontal
    std::array<std::int64_t, 2> resolution{3840, 2160};
    PixelFilter pixel_filter = PixelFilter::center;
    std::optional<double> pupil_diameter_mm;  // thin-lens camera; absent: pinhole
    std::optional<double> focus_distance_mm;  // along the view axis; default: the target's distance
    bool operator==(const Camera&) const = default;
};

/// The light in which content is shaded: a surface shows its colour times ambient + strength max(cos(angle to the light), 0).
struct ContentLight {
    Vec3d direction{0.3, 0.5, 0.81};  // towards the light; only the direction counts
    double strength = 0.8;
    double ambient = 0.2;
    bool operator==(const ContentLight&) const = default;
};

/// An object of a scene: a mesh, or a picture on a rectangle.
struct SceneObject {
    std::string model;                // mesh file, as content.model; one of the two is given, the other empty
    std::string image;                // picture file
    Vec3d position_mm{};              // of its middle: x and y from the panel's, z from the viewer-side vertex plane
    std::optional<double> height_mm;  // of the rotated model's bounding box, or the unrotated image; exactly one of these three
    std::optional<double> width_mm;   // of the same box or image
    std::optional<double> unit_mm;    // length of a model file's unit
    double roll_deg = 0;              // about z, first; counter-clockwise as the viewer sees it
    double tilt_deg = 0;              // about x, second; positive raises the front
    double yaw_deg = 0;               // about y, last; counter-clockwise seen from above
    std::optional<Vec3d> colour;      // sRGB, in place of a model file's colours and textures
    Shading shading = Shading::file;
    bool operator==(const SceneObject&) const = default;
};

/// The inverse pick-up (docs/inverse.md): the panel picture whose views are best.
struct Inverse {
    std::vector<Vec3d> eyes_mm;          // opposite corners of boxes of eye places, two for each box; default: the viewing zone
    std::array<double, 2> levels{0, 1};  // light of the content's black and white, over that of a white panel
    std::optional<std::int64_t> places;  // number of eyes that are fitted
    std::optional<std::int64_t> rays;    // rays for each element of a view
    std::int64_t held_out = 8;           // further eyes, never fitted: the panel picture that is best for them is taken
    std::optional<double> rim;           // view steps around a box in which further eyes count a quarter; default 3, of strips 0
    std::optional<double> pupil_mm;      // default: the camera's, else 4
    std::optional<double> pixel_mm;      // width of an element of a view, in the plane of the content's middle
    std::optional<double> prior;         // pull to traced or integrated content; default 0.001, or 0.3 where there are too few rays
    ErrorOf weighting = ErrorOf::eye;
    std::int64_t iterations = 20;     // at most
    std::string start;                // picture that the fit begins with; empty: traced or integrated content
    std::optional<double> memory_mb;  // for rays that are kept; default: half of what is free
    bool operator==(const Inverse&) const = default;
};

/// What elemental images and reference photographs show. docs/model.md, "Elemental images" and "Scene".
struct Content {
    std::string model;               // mesh file; relative to the description file; empty: none
    std::optional<double> depth_mm;  // of the model's centre, from the viewer-side vertex plane; default L, or 0 where L is too far
    std::optional<double> written_depth_mm;  // no key: that default in the description before changes, which takes its place
    std::optional<double> height_mm;         // default half the panel's height; of objects as they are
    double tilt_deg = 0;                     // about x, before the yaw; positive raises the front
    double yaw_deg = 0;                      // counter-clockwise seen from above
    double viewing_distance_mm = 2000;       // from the panel; infinity allowed
    std::optional<double> view_cone_deg;  // A, that the views of a quilt made for the display span; absent: as docs/views.md says
    PickupKind pickup = PickupKind::nodal;
    std::int64_t pickup_rays = 16;  // of the integrated pick-up
    Inverse inverse;
    ContentSampling sampling = ContentSampling::subpixel;
    MadeFor made_for = MadeFor::description;
    ContentLight light;
    std::vector<SceneObject> objects;  // in place of the model; depth, height, tilt and yaw then apply to all of them together
    bool operator==(const Content&) const = default;
};

/// Default samples per pixel where each sample is a ray that reads one panel pixel.
inline constexpr std::int64_t default_points = 100;

/// How pictures are computed. docs/model.md, "Sampling" and "Filtered estimator".
struct Render {
    Estimator estimator = Estimator::filtered;
    std::optional<std::int64_t> samples;  // default: 4 filtered ones, or default_points, or as many as docs/model.md says
    Sampling sampling = Sampling::sobol;
    Fresnel fresnel = Fresnel::exact;
    std::int64_t seed = 0;
    std::int64_t wavelength_samples = 1;  // K, wavelengths at which each channel is traced
    bool operator==(const Render&) const = default;
};

/// A whole description. A Display that read_display() returned has passed validate() and has the formula of every glass.
struct Display {
    std::string name;                           // free text for reports and image files
    std::vector<std::string> glass_catalogues;  // AGF files, relative to the working directory; max_catalogues at most
    Panel panel;
    Lens lens;
    LensArray array;
    Errors errors;  // how the array as built differs from `array` and `lens`
    std::optional<Diffuser> diffuser;
    Camera camera;
    Content content;
    Render render;
    bool operator==(const Display&) const = default;
};

}  // namespace lfdsim
