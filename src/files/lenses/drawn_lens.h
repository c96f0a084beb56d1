// A lens as a lens design program saved it, whatever the file's format. Floor 2.
#pragma once
#include "base/input_error.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// What fills the space behind a surface: a named glass, or an index.
struct DrawnMedium {
    std::string glass;         // as the file calls it; empty: none
    double nd = 1;             // where no glass is named
    std::optional<double> vd;  // absent: the index is the same for all wavelengths
    bool is_air() const { return glass.empty() && nd == 1; }
    bool operator==(const DrawnMedium&) const = default;
};

/// A surface of revolution. Light comes from the side of negative sag.
struct DrawnSurface {
    std::string place;  // "lens.zmx:88: surface 3", as messages name it
    double curvature_per_mm = 0;
    double conic = 0;
    std::vector<double> even_asphere;        // a4, a6, ... without zeros at the end
    double distance_mm = 0;                  // to the next surface; may be negative, or infinite where the object is
    DrawnMedium medium;                      // up to the next surface
    std::optional<double> semi_aperture_mm;  // absent: the program finds it from the beam
    bool is_hole = false;                    // it absorbs beyond the semi-aperture even where it is not glass
    bool is_stop = false;
};

/// The light that a lens is drawn for.
struct DrawnBeam {
    std::optional<double> wavelength_nm;      // the main one
    std::optional<double> entrance_pupil_mm;  // its diameter
    std::optional<double> f_number;           // for an object at infinity
    std::optional<double> field_deg;          // from the axis to the edge of the field
};

struct DrawnLens {
    std::string title;
    std::vector<DrawnSurface> surfaces;  // in the order of light; the first is the object, the last the image
    DrawnBeam beam;
    std::vector<std::string> notes;  // what was assumed, or not read though it could matter
};

// Read text or bytes of Zemax (.zmx), Optiland (.json) and ray-optics (.roa); `name` stands for the file in messages. They throw
// InputError with every problem and its place; what cannot be traced here is named and refused.
DrawnLens parse_zmx(std::string_view bytes, std::string_view name);
DrawnLens parse_optiland(std::string_view text, std::string_view name);
DrawnLens parse_rayoptics(std::string_view text, std::string_view name);

/// Multiplies all lengths of the lens by a factor.
void scale(DrawnLens&, double factor);

/// A surface with a term in r^2 beside its conic, as both formats may have it, a2 in 1/mm. Whether it could be written without the
/// term: two paraboloids add up to one.
bool fold_r2(DrawnSurface&, double a2);

}  // namespace lfdsim
