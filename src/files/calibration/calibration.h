// The calibration of a display with a slanted lenticular sheet, and a description made of it. Floor 2.
//
// A calibration says where on the panel the views of each lens are, not what the lenses are. docs/model.md, "Calibrations".
#pragma once
#include "files/lenses/import_lens.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// The centres of a pixel's red, green and blue subpixels: pixels to the right of its centre (0) and above it (1).
using CellPlaces = std::array<std::array<double, 2>, 3>;

/// A Looking Glass display's visual.json. Rows of pixels are counted from the bottom.
struct Calibration {
    std::string place;                     // in the file, where it is only a part of it: "devices[0].calibration"
    std::string serial;                    // empty: none is given
    double pitch_per_inch = 0;             // lenses, or elemental images, per inch across the strips: p' = 25.4 mm / this
    double slope = 0;                      // lens axes are the lines x + y / slope = const, y upwards
    double center = 0;                     // in lenses; subtracted from the phase
    double dpi = 0;                        // pixels per inch
    std::array<std::int64_t, 2> pixels{};  // W, H
    std::optional<double> view_cone_deg;
    bool flip_image_x = false;       // sigma = -1: the signs of the slope and of the subpixels' order change
    bool flip_subpixels = false;     // blue is the first subpixel, not red
    std::vector<CellPlaces> cells;   // the number that the pattern has; empty: stripes, a third of a pixel each
    int cell_pattern = 0;            // CellPatternMode, an index into cell_patterns
    std::vector<std::string> notes;  // sentences: what was not read
};

/// The columns and rows of pixels after which the cells repeat, and the number of different cells.
struct CellPattern {
    int columns, rows, cells;
};
inline constexpr CellPattern cell_patterns[] = {{1, 1, 1}, {2, 2, 2}, {2, 1, 2}, {2, 4, 4}, {1, 2, 2}};  // by CellPatternMode
/// Returns the index of the cell that a pixel has, by its column and its row from the bottom, both 0 or more.
int cell_of(int pattern, std::int64_t column, std::int64_t row_from_bottom);

/// What a calibration does not say.
struct CalibrationRequest {
    std::optional<double> gap_mm;       // g, reduced distance from panel to lenses; absent: by the view cone
    std::optional<double> distance_mm;  // D' of the eye that it was made for; absent: where the panel is 14 degrees high
    std::optional<double> index;        // n of cylinders in a sheet on the panel; absent: lenses without aberrations, in air
};

/// Whether a text in JSON is a calibration or contains one: its top level has a key that only calibrations have, or an object
/// within has three of them. Throws InputError if it is not JSON.
bool is_calibration(std::string_view text, std::string_view name);
/// Returns the calibration in a text, at any depth: services deliver it within other data. Throws InputError with every problem and
/// its place, and for several calibrations that differ.
Calibration parse_calibration(std::string_view text, std::string_view name);

/// Returns a valid display whose elemental images have the calibration's phases. Throws InputError with the key, or the option of
/// `lfdsim import`, of everything that is wrong; `name` is the file's name in messages.
Imported import_calibration(const Calibration&, const CalibrationRequest&, const std::string& name);

}  // namespace lfdsim
