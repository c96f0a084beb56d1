// Where the eyes are whose views are fitted, and the cameras that represent them. Floor 3, public as a part of inverse.h.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"

#include <cstdint>
#include <span>
#include <vector>

namespace lfdsim {

/// A box of eye places, mm, in the display's frame. Each low[k] <= high[k].
struct EyeBox {
    Vec3d low, high;
};

/// Returns the boxes of content.inverse.eyes_mm, which has two corners for each; infinite coordinates stand for the camera's. None
/// if the key is absent.
std::vector<EyeBox> eye_boxes(const Display&);

/// Returns whether a position is in the box, or on its surface.
bool is_inside(const EyeBox&, const Vec3d&);

/// Returns the distance between the centres of neighbouring views for an eye at distance z from the panel: D a/g, D from the rear
/// principal plane, a the panel's pixel pitch, g the gap. Of strips over subpixels it is a third of that.
double view_step_mm(const Display&, const Geometry&, double z_mm);

/// Returns the number of views side by side along the longer sides of the boxes (of strips along x), added up; 0 of points.
double views_within(std::span<const EyeBox>, const Display&, const Geometry&);

/// Returns eye places spread evenly over boxes by an additive recurrence with the powers of a generalised golden ratio (M. Roberts
/// 2018), the boxes in turn. They are those from number `first` on, so that held-out places continue the fitted ones.
std::vector<Vec3d> places_within(std::span<const EyeBox>, std::int64_t first, std::int64_t count);

/// Returns eye positions around the boxes, up to `view_steps` view steps from them, and no farther than where the views begin to
/// repeat: an eye beyond sees, through the next lenses, the pixels of eyes at the other end of the box. Fewer than `count` where
/// that rim is very narrow.
std::vector<Vec3d> places_around(std::span<const EyeBox>, const Display&, const Geometry&, double view_steps, std::int64_t count);

/// Returns the width of an element of a view, mm in the plane of the content's middle: content.inverse.pixel_mm, or half of what
/// the display can show (the lens pitch, or the image of a panel pixel if that is narrower), but an arc minute at least, and with
/// subpixels six panel pixels.
double element_mm(const Display&, const Geometry&, const Vec3d& eye, double content_z_mm);

/// Returns the display with its camera at `eye`: it looks at the panel's centre, is focused on the plane z = content_z_mm, has a
/// pupil and a box filter, and its frame just covers the array with elements of element_mm(). (shift_x, shift_y): by how many
/// elements, each 0 to 1, its frame is moved. Throws InputError for a place from which the display cannot be seen.
Display seen_by_eye(const Display&, const Geometry&, const Vec3d& eye, double content_z_mm, double shift_x, double shift_y);

/// Returns the display with its camera moved to `eye`, with a pupil, a box filter and this many columns and rows. Throws InputError
/// for a place from which the display cannot be seen.
Display seen_by_camera_at(const Display&, const Geometry&, const Vec3d& eye, std::array<std::int64_t, 2> resolution);

}  // namespace lfdsim
