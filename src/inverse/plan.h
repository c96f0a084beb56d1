// Which eyes are fitted, and by how many rays. Floor 3.
#pragma once
#include "base/input_error.h"
#include "base/job.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "image/image.h"
#include "inverse/eye_places.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace lfdsim {

/// Computes what an eye should see: the picture of a display's camera, `samples` rays a pixel, linear light.
using ContentOf = std::function<Image(const Display& seen, const Geometry&, std::int64_t samples, Job&)>;

/// What a panel picture is made for and from.
struct Request {
    const Display& display;     // that content is made for
    const Geometry& geometry;   // of it
    const Display& shown;       // with its errors, which held-out eyes see
    double content_z_mm;        // height of the content's middle, on which eyes focus
    ContentOf content_of;       // not used of eyes with given pictures
    std::vector<EyeBox> boxes;  // none where pictures are given
    int threads;                // 0: all
    Job& job;
    const Inverse& keys() const { return display.content.inverse; }
};

/// An eye, and what a view of it is made of.
struct Eye {
    Vec3d place;                     // mm, in the display's frame
    std::int64_t number;             // decides the shift of its grid of elements, and its rays
    float weight = 1;                // of its errors
    const Image* picture = nullptr;  // what it should see, where that is given
};
/// Returns eyes at these places, with numbers from `first` on.
std::vector<Eye> eyes_at(std::span<const Vec3d> places, std::int64_t first, float weight = 1);

/// Returns the display with the camera that represents an eye, and `rays` for each element of its view. Throws InputError for a
/// place from which the display cannot be seen.
Display display_of(const Request&, const Display&, const Geometry&, const Eye&, std::int64_t rays);

/// The error of eyes to which the panel sends no light.
InputError no_light(const Request&);

/// What eyes meet of a panel.
struct EyeCounts {
    double pixels = 0, rows = 0, lit = 0;  // panel pixels met; elements with light; rays with light, with one ray an element
};
/// Counts these with a few rays for each element. Unfinished where the job is cancelled. Throws InputError if there is none.
EyeCounts count(const Request&, std::span<const Eye>);

/// The intended numbers of elements of views and of rays with light for each panel pixel that eyes meet.
inline constexpr double rows_wanted = 4, rays_wanted = 160;
/// Returns the rays per element, a multiple of 4 up to 4096, with which each panel pixel met has rays_wanted rays that carry light.
std::int64_t rays_for(const EyeCounts&);

/// Returns whether views have so few elements (`rows`), or rays with light, for each panel pixel that they meet that a fit follows
/// noise.
bool are_few_rays(double rows_per_pixel, double rays_per_pixel);
/// Returns the warning of that, for views from `places` eyes, with what to give instead.
std::string warning_of_few_rays(const Request&, std::int64_t places, double rows_per_pixel, double rays_per_pixel);
/// The prior of a fit with few rays.
inline constexpr double careful_prior = 0.3;

/// Returns the number of points by which an element's light of a white panel is computed: four with light, in each colour, for each
/// ray of its row, 16 for each at most, so that it is known better than from those rays.
std::int64_t white_points_for(const Request&, const EyeCounts&, std::int64_t rays);

/// Which eyes are fitted, and with which rays.
struct Plan {
    std::vector<Eye> eyes;        // in the boxes, then around them
    std::int64_t in_boxes, rays;  // number of the former; rays of an element
    EyeCounts counts;             // of all eyes together
};
/// Plans the eyes and the rays of an element, from the boxes and what their eyes meet. Throws InputError for boxes from which no
/// ray ends on the panel, and for too few places.
Plan plan(const Request&);

/// Throws InputError if there is no memory for the unknowns and a panel picture; before the first array of the panel's size is
/// made.
void require_memory_for_panel(const Display&);

/// Returns the bytes of rays that may be kept: content.inverse.memory_mb, or half of what is free beside the unknowns. Throws
/// InputError if there is no room for one view of the display as it is seen.
double memory_for_rays(const Request&, const Display& seen);

}  // namespace lfdsim
