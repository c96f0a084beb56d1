// The keys of [errors].
#include "display/keys.h"

namespace lfdsim {
namespace {

constexpr Range tilt_range{-30, 30}, seed_range{0, two_to_63};

constexpr Key<Errors> errors_keys[] = {
    {"shift_mm", &Errors::shift_mm, any_length, false, "Shift of the whole array along the panel's x and y."},
    {"gap_mm", &Errors::gap_mm, any_length, false,
     "Displacement of the whole array towards the viewer. The diffuser keeps its place."},
    {"rotation_deg", &Errors::rotation_deg, tilt_range, false,
     "Rotation of the whole array, counter-clockwise as the viewer sees it."},
    {"pitch_ppm", &Errors::pitch_ppm, Range{-1e5, 1e5}, false,
     "Pitch error of the lenses and their cells, in parts per million, about the array's centre; lenses keep their size, but ideal "
     "ones that fill their cells."},
    {"wedge_deg", &Errors::wedge_deg, tilt_range, false,
     "Rotation of the whole array about the panel's x axis (positive: its upper edge moves towards the viewer), then about its y "
     "axis (positive: its left edge does)."},
    {"bow_mm", &Errors::bow_mm, any_length, false,
     "Height of the lenses at the array's centre above those at its corners (strips: at its sides); it falls with the square of "
     "the distance from the centre."},
    {"decenter_sd_mm", &Errors::decenter_sd_mm, length_or_zero, false,
     "Standard deviation of each lens's decentre along the array's x and y (strips: across their axes)."},
    {"height_sd_mm", &Errors::height_sd_mm, length_or_zero, false,
     "Standard deviation of each lens's displacement towards the viewer."},
    {"tilt_sd_deg", &Errors::tilt_sd_deg, Range{0, 10}, false,
     "Standard deviation of each lens's tilt about the array's x and y (strips: about their axes), through its vertex."},
    {"curvature_sd", &Errors::curvature_sd, Range{0, 0.25}, false,
     "Standard deviation of each lens's relative curvature error e: all its curvatures are 1 + e times the described ones; "
     "vertices and aspheric terms are unchanged."},
    {"seed", &Errors::seed, seed_range, false,
     "Seed of the random errors: normal distributions with these standard deviations, redrawn beyond three of them."},
    {"table", &Errors::table, no_range, false,
     "CSV file with further errors of single lenses, which are added to the random ones; relative to the description's folder. "
     "`lfdsim errors` writes one.",
     "none"},
};

}  // namespace

template <>
constinit const Table<Errors> TableOf<Errors>::table{
    "errors",
    "Deviations of the array as built from the description. Pictures and measures are of the display with these errors; "
    "elemental images are made without them, unless content.made_for says otherwise.",
    errors_keys};

}  // namespace lfdsim
