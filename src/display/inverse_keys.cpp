// The keys of [content.inverse].
#include "base/constants.h"
#include "display/keys.h"

namespace lfdsim {
namespace {

constexpr Key<Inverse> inverse_keys[] = {
    {"eyes_mm", &Inverse::eyes_mm, Range{-longest_mm, infinity}, false,
     "Opposite corners of the box that contains the eyes, [[x, y, z], [x, y, z]]; two more corners for a second box. z = inf: the "
     "camera's distance.",
     "the zone in which at most 1 % of the rays are wrong, at the viewing distance; up and down at most 20 mm of it"},
    {"levels", &Inverse::levels, Range{0, 1}, false,
     "Light of the content's black and white, relative to a white panel. A raised black level leaves a margin in which crosstalk "
     "can be subtracted."},
    {"places", &Inverse::places, Range{1, 100000}, false, "Number of eyes that are fitted.",
     "the number of views along the box, at least 24, and more until there are four elements of a view for each panel pixel"},
    {"rays", &Inverse::rays, Range{1, 4096}, false, "Rays per element of a view.",
     "as many as give each panel pixel that rays meet 160 rays that carry light"},
    {"held_out", &Inverse::held_out, Range{1, 1000}, false,
     "Number of further eyes in the box that are not fitted; the panel picture that is best for them is chosen."},
    {"rim", &Inverse::rim, Range{0, 100}, false,
     "Width, in view steps, of a margin around the box with as many further eyes (four times as many around one with width and "
     "height), which together have a quarter of the weight, so that views just outside the box are not degraded.",
     "3; 0 for strips"},
    {"pupil_mm", &Inverse::pupil_mm, Range{shortest_mm, 100}, false, "Pupil diameter of these eyes.", "the camera's pupil, or 4"},
    {"pixel_mm", &Inverse::pixel_mm, Range{shortest_mm, 1000}, false,
     "Width of an element of a view, in the plane of the content's middle.",
     "half the smaller of the lens pitch and the image of a pixel, with subpixels at least six pixel pitches; at least one arc "
     "minute"},
    {"prior", &Inverse::prior, Range{0, 1000}, false, "Weight that pulls the fit towards traced or integrated content.",
     "0.001, or 0.3 where there are too few rays"},
    {"weighting", &Inverse::weighting, no_range, false,
     "Errors are weighted as code values, about as eyes see them, or as linear light."},
    {"iterations", &Inverse::iterations, Range{1, 1000}, false,
     "Maximum number of steps; the fit ends earlier when held-out eyes no longer improve."},
    {"start", &Inverse::start, no_range, false, "Panel picture at which the fit starts, such as that of the previous frame.",
     "traced or integrated content, whichever is better for held-out eyes"},
    {"memory_mb", &Inverse::memory_mb, Range{1, 1e9}, false, "Memory for stored rays; others are traced again in each step.",
     "half of the free memory"},
};

}  // namespace

template <>
constinit const Table<Inverse> TableOf<Inverse>::table{
    "inverse", "The inverse pick-up: for which eyes the panel picture is fitted, and how. See inverse.md.", inverse_keys};
template <>
std::span<const std::string_view> words<ErrorOf>() {
    static constexpr std::string_view w[] = {"eye", "light"};
    return w;
}

}  // namespace lfdsim
