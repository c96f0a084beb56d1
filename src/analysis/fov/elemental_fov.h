// The field of view by geometry: from where lenses show their own elemental images. Floor 3. docs/measures.md, "Field of view".
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
/// whole elemental image lies on it, that which comes from the image of the lens that it passed. It depends on no content,
/// picture or pixels: an elemental image is the cell, scaled to the pitch p', about the point where the line from the viewer that
/// images are made for, through the lens's nodal points, meets the panel.
class OwnLens {
  public:
    /// The light with the display's diffuser, or as it leaves the lenses.
    OwnLens(Display, bool with_diffuser);

    /// NaN: the eye sees no such light.
    double share(const Vec3d& eye, std::span<const Choice>) const;

    const EyeRays& rays() const { return rays_; }
    /// Lenses whose whole elemental image lies on the panel.
    std::int64_t whole_images() const;

  private:
    Display display_;
    Geometry geometry_;
    EyeRays rays_;
    Pickup pickup_;
    std::array<double, 2> half_image_mm_;  // how far an image reaches from its middle along x' and, but of strips, y'
    bool is_whole(double centre_x, double centre_y) const;
};

/// The positions at which the share falls to one half on either side of the middle. NaN: it does not, and `missing` says why.
struct OwnRange {
    std::array<double, 2> at, error;
    std::array<std::string, 2> missing;
};

/// The place of an eye on its way past the display, at 0 in the middle, and how far it can go on either side.
struct EyePath {
    std::function<Vec3d(double)> eye;
    double most;   // beyond it an eye is inside the display, or a search makes no sense
    double step;   // finer than the width over which the share falls
    int mirrored;  // the axis along which the other side's lines of sight are the mirror images of this side's: 0 (x') or 1 (y')
};

/// Four independent sets of lines of sight each give a place. The error is their scatter, such that it covers the true value in 95
/// of 100 cases, and how far to either side the share is within 0.005 of one half. More lines are taken until the scatter is below
/// `wanted` or there are 64 times as many. Throws Stopped.
OwnRange where_own(const OwnLens&, const EyePath&, double wanted, std::uint32_t seed, Parts&);
constexpr int own_range_parts = 2;

/// The arc of `analyze fov`: about the panel's centre at the eye's distance, towards the array's x' (axis 0) or y' (1); degrees
/// from the panel's normal.
EyePath arc(const Display&, const Geometry&, double distance_mm, int axis);
/// The edge on that arc by theory: X/E = p'/2g with X = R sin a aside of the axis and E = R cos a - z_r from the rear principal
/// plane.
double arc_edge_deg(const Geometry&, const Theory&, double distance_mm, int axis);
/// The path of an eye in the plane at its distance from the panel, mm from the middle.
EyePath across(const Display&, const Geometry&, double distance_mm, int axis);

}  // namespace lfdsim
