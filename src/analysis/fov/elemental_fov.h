// The field of view by geometry: the positions from which lenses show their own elemental images. Floor 3. docs/measures.md,
// "Field of view".
#pragma once
#include "analysis/core/eye_rays.h"
#include "analysis/core/parallel.h"
#include "content/pickup/pickup.h"

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// The share of light from own elemental images: of the light that an eye sees of a white, Lambertian panel through lenses whose
/// whole elemental image lies on it, the part that comes from the image of the lens that it passed. It depends on no content,
/// picture or pixels: an elemental image is the cell, scaled to the pitch p', about the centre that the content's pick-up gives it:
/// that of the lens as described, or as built.
class OwnLens {
  public:
    /// A valid display, with its diffuser or as light leaves the lenses.
    OwnLens(Display, bool with_diffuser);

    /// Returns the share by these lines of sight of an eye, mm, display frame; NaN if it sees no such light.
    double share(const Vec3d& eye, std::span<const Choice>) const;

    const EyeRays& rays() const { return rays_; }
    /// Returns the number of lenses whose whole elemental image lies on the panel.
    std::int64_t whole_images() const;

  private:
    Display display_;
    Geometry geometry_;
    EyeRays rays_;
    Pickup pickup_;
    std::array<double, 2> half_image_mm_;  // from an image's middle to its border along x' and, except of strips, y'
    bool is_whole(double centre_x, double centre_y) const;
};

/// The positions on either side of the middle at which the share falls to one half, and their errors, in the units of the eye's
/// path. NaN: it does not, and `missing` says why.
struct OwnRange {
    std::array<double, 2> at, error;
    std::array<std::string, 2> missing;
};

/// The path of an eye past the display, which starts in the middle at 0 and goes to either side.
struct EyePath {
    std::function<Vec3d(double)> eye;  // the position, mm, display frame
    double most;                       // end of the search to either side: beyond it an eye is inside the display, or sees nothing
    double step;                       // of the search: less than the width over which the share falls
    int mirrored;  // axis of the array, 0 (x') or 1 (y'), along which lines of sight are mirrored for the other side
};

/// Finds the range by four independent sets of lines of sight, each of which gives a position. The error is the Student 95 %
/// error of their mean, and how far to either side the share is within 0.005 of one half. The number of lines grows until the
/// former is at most `wanted`, or to 64 times as many. Throws Stopped.
OwnRange where_own(const OwnLens&, const EyePath&, double wanted, std::uint32_t seed, Parts&);
/// The number of parts that where_own() runs.
constexpr int own_range_parts = 2;

/// Returns the path of `analyze fov`: an arc about the panel's centre at the eye's distance, towards x' (axis 0) or y' (1);
/// degrees from the panel's normal.
EyePath arc(const Display&, const Geometry&, double distance_mm, int axis);
/// Returns the edge on that arc by theory, degrees: X/E = p'/2g with X = R sin a, E = R cos a - z_H', R the eye's distance from
/// the panel's centre.
double arc_edge_deg(const Geometry&, const Theory&, double distance_mm, int axis);
/// Returns the path of an eye in the plane at its distance from the panel; mm from the middle.
EyePath across(const Display&, const Geometry&, double distance_mm, int axis);

}  // namespace lfdsim
