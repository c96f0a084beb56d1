// The keys of [errors].
#include "display/keys.h"

namespace lfdsim {
namespace {

constexpr Range tilt_range{-30, 30}, seed_range{0, two_to_63};

constexpr Key<Errors> errors_keys[] = {
    {"shift_mm", &Errors::shift_mm, any_length, false, "Of the whole array, along the panel's x and y."},
    {"gap_mm", &Errors::gap_mm, any_length, false, "Of the whole array, towards the viewer. The diffuser stays."},
    {"rotation_deg", &Errors::rotation_deg, tilt_range, false, "Of the whole array, counter-clockwise as the viewer sees it."},
    {"pitch_ppm", &Errors::pitch_ppm, Range{-1e5, 1e5}, false,
     "The lenses, and their cells, stand so many millionths further apart, about the array's middle; they themselves are as large "
     "as described."},
    {"wedge_deg", &Errors::wedge_deg, tilt_range, false,
     "Turn of the whole array about the panel's x axis (positive: its upper edge comes towards the viewer), then about its y axis "
     "(positive: its left edge does)."},
    {"bow_mm", &Errors::bow_mm, any_length, false,
     "How much lenses in the array's middle stand out over those in its corners (of strips: at its sides), falling off with the "
     "square of the distance."},
    {"decenter_sd_mm", &Errors::decenter_sd_mm, length_or_zero, false,
     "Of each lens along the array's x and y (of strips: across)."},
    {"height_sd_mm", &Errors::height_sd_mm, length_or_zero, false, "Of each lens, towards the viewer."},
    {"tilt_sd_deg", &Errors::tilt_sd_deg, Range{0, 10}, false,
     "Of each lens about the array's x and y (of strips: about their axes), through its vertex."},
    {"curvature_sd", &Errors::curvature_sd, Range{0, 0.25}, false,
     "Of each lens: all its curvatures are 1 + e times as large, vertices and aspheric terms as described."},
    {"seed", &Errors::seed, seed_range, false,
     "Of what is drawn for each lens: normal distributions with these standard deviations, redrawn beyond three of them."},
    {"table", &Errors::table, no_range, false,
     "CSV file of further errors of single lenses, which are added; relative to the description's folder. `lfdsim errors` writes "
     "one.",
     "none"},
};

}  // namespace

template <>
const Table<Errors>& table_of<Errors>() {
    static constexpr Table<Errors> table{
        "errors",
        "How the array that was built differs from the one described. Pictures and measures are of "
        "the display with these errors, elemental images are made without (content.made_for).",
        errors_keys};
    return table;
}

}  // namespace lfdsim
