// The calibration of a display with a slanted lenticular sheet, and a description made of it. Floor 2.
//
// A calibration says where on the panel the views of each lens lie, not what the lenses are. docs/model.md, "Calibrations".
#pragma once
#include "files/lenses/import_lens.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// Where red, green and blue of a pixel shine: pixels to the right of its centre (0) and above it (1).
using CellPlaces = std::array<std::array<double, 2>, 3>;

/// A Looking Glass display's visual.json. Rows of pixels are counted from the bottom.
struct Calibration {
    std::string place;   // in the file, where it is not the whole of it: "devices[0].calibration"
    std::string serial;  // empty: none is given
    double pitch_per_inch = 0;
    double slope = 0;   // lens axes are the lines x + y / slope = const, y upwards
    double center = 0;  // lenses; subtracted from the phase
    double dpi = 0;     // pixels an inch
    std::array<std::int64_t, 2> pixels{};
    std::optional<double> view_cone_deg;
    bool flip_image_x = false;      // the signs of the slope and of the subpixels' order change
    bool flip_subpixels = false;    // blue is the first subpixel, not red
    std::vector<CellPlaces> cells;  // as many as the pattern has; empty: stripes, a third of a pixel each
    int cell_pattern = 0;           // a place in cell_patterns
    std::vector<std::string> notes;
};

/// After how many columns and rows of pixels the cells repeat, and how many there are; by CellPatternMode.
struct CellPattern {
    int columns, rows, cells;
};
inline constexpr CellPattern cell_patterns[] = {{1, 1, 1}, {2, 2, 2}, {2, 1, 2}, {2, 4, 4}, {1, 2, 2}};
/// Which cell the pixel of a column and a row from the bottom has, both 0 or more.
int cell_of(int pattern, std::int64_t column, std::int64_t row_from_bottom);

/// What a calibration does not say. Lengths in mm.
struct CalibrationRequest {
    std::optional<double> gap_mm;  // panel to lenses, reduced; absent: by the view cone
    std::optional<double>
        distance_mm;              // of the eye that it was made for from the panel; absent: where the panel is 14 degrees high
    std::optional<double> index;  // of cylinders in a sheet on the panel; absent: lenses without aberrations, in air
};

/// Whether a text in JSON is meant as a calibration, or holds one: it has one of the keys that only those have, or some of them
/// stand together further inside.
bool is_calibration(std::string_view text, std::string_view name);
/// The calibration in a text, wherever it stands: services hand it out with other things around it. Throws InputError with every
/// problem and its place, and for several that differ.
Calibration parse_calibration(std::string_view text, std::string_view name);

/// A valid display whose elemental images have the calibration's phases. Throws InputError with the key, or the option of `lfdsim
/// import`, of all that cannot be; `name` stands for the file.
Imported import_calibration(const Calibration&, const CalibrationRequest&, const std::string& name);

}  // namespace lfdsim
