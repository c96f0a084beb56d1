// Which eyes are fitted, and by how many rays. Floor 3.
#pragma once
#include "base/job.h"
#include "display/display.h"
#include "geometry/geometry.h"
#include "image/image.h"
#include "inverse/eye_places.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace lfdsim {

/// What an eye should see: the picture of a display's camera, `samples` rays a pixel.
using ContentOf = std::function<Image(const Display& seen, const Geometry&, std::int64_t samples, Job&)>;

/// What was asked for, with what it is of.
struct Request {
    const Display& display;  // that content is made for
    const Geometry& geometry;
    const Display& shown;  // as described, which held-out eyes see
    double content_z_mm;
    ContentOf content_of;
    std::vector<EyeBox> boxes;
    int threads;
    Job& job;
    const Inverse& keys() const { return display.content.inverse; }
};

/// An eye, and what a view of it is made of.
struct Eye {
    Vec3d place;
    std::int64_t number;  // decides its grid's shift
    float weight;
    const Image* picture = nullptr;  // what it should see, where that is given
};
std::vector<Eye> eyes_at(std::span<const Vec3d> places, std::int64_t first, float weight);

/// The display with the camera that stands for an eye, and so many rays for each element of its view. Throws InputError.
Display display_of(const Request&, const Display&, const Geometry&, const Eye&, std::int64_t rays);

/// The numbers of panel pixels that the eyes meet, of elements that see light, and of rays with light.
struct EyeCounts {
    double pixels = 0, rows = 0, lit = 0;
};
EyeCounts count(const Request&, std::span<const Eye>);

/// The intended numbers of elements of views and of rays with light for each panel pixel that eyes meet.
inline constexpr double rows_wanted = 4, rays_wanted = 160;
/// Returns the rays per element with which each panel pixel met has rays_wanted rays that carry light.
std::int64_t rays_for(const EyeCounts&);

/// Returns the number of points by which an element's light of a white panel is computed: four with light, in each colour, for each
/// ray of its row, 16 for each at most, so that it is known better than from those rays.
std::int64_t white_points_for(const Request&, const EyeCounts&, std::int64_t rays);

/// The places and the rays of an element, from the boxes and what their eyes meet.
struct Plan {
    std::vector<Eye> eyes;
    std::int64_t in_boxes, rays;
    EyeCounts counts;  // of all eyes together, with one ray an element
};
/// Throws InputError for boxes from which no ray ends on the panel.
Plan plan(const Request&);

}  // namespace lfdsim
