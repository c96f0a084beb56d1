// A lens as a lens design program saved it, whatever the file's format. Floor 2.
#pragma once
#include "base/input_error.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// The medium after a surface: a named glass, or an index.
struct DrawnMedium {
    std::string glass;         // as the file calls it; empty: none
    double nd = 1;             // index at the d line, where no glass is named
    std::optional<double> vd;  // absent: the index is the same for all wavelengths
    bool is_air() const { return glass.empty() && nd == 1; }
    bool operator==(const DrawnMedium&) const = default;
};

/// A surface of revolution in the frame of the file: light goes along +z, and sag is measured from the vertex along +z.
struct DrawnSurface {
    std::string place;  // "lens.zmx:88: surface 3", as messages name it
    double curvature_per_mm = 0;
    double conic = 0;
    std::vector<double> even_asphere;        // a4, a6, ... without zeros at the end
    double distance_mm = 0;                  // to the next surface; may be negative, and infinite of the object
    DrawnMedium medium;                      // up to the next surface
    std::optional<double> semi_aperture_mm;  // absent: the design program finds it from the beam
    bool is_hole = false;                    // the file gives it an aperture, which absorbs light even where there is no glass
    bool is_stop = false;
};

/// The light that a lens was designed for.
struct DrawnBeam {
    std::optional<double> wavelength_nm;      // the main one
    std::optional<double> entrance_pupil_mm;  // diameter of the entrance pupil
    std::optional<double> f_number;           // of the lens before an object at infinity, wherever the object is
    std::optional<double> working_f_number;   // 1/(2 tan) of half the angle at which the axial beam meets the image
    std::optional<double> field_slope;        // of the chief ray from the edge of the field, before it enters the lens
    std::optional<double> object_height_mm;   // from the axis to the edge of the field, in place of the slope
};

/// A lens of a file, in mm whatever the unit of the file.
struct DrawnLens {
    std::string title;
    std::vector<DrawnSurface> surfaces;  // at least 3, in the order of light; the first is the object, the last the image
    DrawnBeam beam;
    std::vector<std::string> notes;  // sentences: what was assumed, or not read though it could matter
};

// The parsers read text or bytes of Zemax (.zmx), Optiland (.json) and ray-optics (.roa); `name` is the file's name in messages.
// They throw InputError with every problem and its place; what cannot be traced (mirrors, tilts, other shapes) is named and
// refused. A new format needs a parser that fills a DrawnLens, a line in read_importable(), and a fuzzer.
DrawnLens parse_zmx(std::string_view bytes, std::string_view name);
DrawnLens parse_optiland(std::string_view text, std::string_view name);
DrawnLens parse_rayoptics(std::string_view text, std::string_view name);

/// Returns the slope of a direction that a field point's two angles, degrees, define: its slopes in x and y are their tangents.
double slope_of_field(double x_deg, double y_deg);

/// Multiplies all lengths of the lens by a factor.
void scale(DrawnLens&, double factor);

/// Removes a term a2 r^2 (a2 in 1/mm) that a format has beside the conic, by adding 2 a2 to the curvature: near the vertex sag is
/// c r^2/2, and for a paraboloid (k = -1) or a plane everywhere. Returns false, and changes nothing, for other conics.
bool fold_r2(DrawnSurface&, double a2);

}  // namespace lfdsim
