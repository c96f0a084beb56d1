// The keys of [content.inverse].
#include "base/constants.h"
#include "display/keys.h"

namespace lfdsim {
namespace {

constexpr Key<Inverse> inverse_keys[] = {
    {"eyes_mm", &Inverse::eyes_mm, Range{-longest_mm, infinity}, false,
     "Opposite corners of the box in which eyes are, [[x, y, z], [x, y, z]]; two more corners for a second box. z = inf: the "
     "camera's "
     "distance.",
     "the zone in which at most 1 % of the rays are wrong, at the viewing distance"},
    {"levels", &Inverse::levels, Range{0, 1}, false,
     "Light of the content's black and white, over that of a white panel: room in which crosstalk can be subtracted."},
    {"places", &Inverse::places, Range{1, 100000}, false, "Eyes that are fitted.",
     "as many as views fit into the box, at least 24, and more until there are four elements of a view for each panel pixel"},
    {"rays", &Inverse::rays, Range{1, 4096}, false, "Of each element of a view.",
     "as many as give each panel pixel that is met 160 rays with light"},
    {"held_out", &Inverse::held_out, Range{1, 1000}, false,
     "Further eyes in the box, which are never fitted: they choose the panel."},
    {"rim", &Inverse::rim, Range{0, 100}, false,
     "View steps around the box in which as many further eyes count a quarter, so that eyes beside the box lose nothing.",
     "3, of strips 0"},
    {"pupil_mm", &Inverse::pupil_mm, Range{shortest_mm, 100}, false, "Of these eyes.", "the camera's pupil, or 4"},
    {"pixel_mm", &Inverse::pixel_mm, Range{shortest_mm, 1000}, false,
     "Width of an element of a view, in the plane of the content's middle.",
     "half the finer of the lens pitch and a pixel's image, with subpixels at least six pixel pitches; at least an arc minute"},
    {"prior", &Inverse::prior, Range{0, 1000}, false, "How strongly the fit is pulled to traced content.",
     "0.001, or 0.3 where there are too few rays"},
    {"weighting", &Inverse::weighting, no_range, false, "Errors of code values, as eyes weight them, or of light."},
    {"iterations", &Inverse::iterations, Range{1, 1000}, false, "At most; the fit ends where held-out eyes gain nothing more."},
    {"start", &Inverse::start, no_range, false, "Panel picture that the fit begins with, as that of the last frame.",
     "traced content"},
    {"memory_mb", &Inverse::memory_mb, Range{1, 1e9}, false, "For rays that are kept; others are traced again in each step.",
     "half of what is free"},
};

}  // namespace

template <>
const Table<Inverse>& table_of<Inverse>() {
    static constexpr Table<Inverse> table{
        "inverse", "The inverse pick-up: for which eyes the panel picture is fitted, and how. See inverse.md.", inverse_keys};
    return table;
}
template <>
std::span<const std::string_view> words<ErrorOf>() {
    static constexpr std::string_view w[] = {"eye", "light"};
    return w;
}

}  // namespace lfdsim
