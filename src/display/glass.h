// Glasses and plastics: the refractive index against the wavelength. Floor 0, public as a part of display.h; no I/O.
#pragma once
#include <array>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// How the index n follows from a glass's coefficients c0, c1, ... and the wavelength l in micrometres, so that a coefficient
/// beside l^2 is in square micrometres. docs/model.md, "Colour".
enum class Formula {
    unknown,       // of a name that has not been looked up
    nd_vd,         // n = A + B/l^2 through n_d = c0 with the Abbe number V_d = c1
    cauchy,        // n = c0 + c1/l^2 + c2/l^4
    conrady,       // n = c0 + c1/l + c2/l^3.5
    herzberger,    // n = c0 + c1 L + c2 L^2 + c3 l^2 + c4 l^4 + c5 l^6, L = 1/(l^2 - 0.028)
    sellmeier,     // n^2 = 1 + c0 l^2/(l^2 - c1) + c2 l^2/(l^2 - c3) + ...
    resonances,    // n^2 = c0 + c1 l^2/(l^2 - c2) + c3 l^2/(l^2 - c4) + ...
    sellmeier_2,   // n^2 = 1 + c0 + c1 l^2/(l^2 - c2^2) + c3/(l^2 - c4^2)
    handbook_1,    // n^2 = c0 + c1/(l^2 - c2) - c3 l^2
    handbook_2,    // n^2 = c0 + c1 l^2/(l^2 - c2) - c3 l^2
    power_series,  // n^2 = c0 l^c1 + c2 l^c3 + ...: Schott's formula and its extensions
};

/// A medium whose index depends on the wavelength, relative to air. Glass absorbs nothing.
struct Glass {
    std::string name;  // in a catalogue; empty: the glass is given by its coefficients alone
    Formula formula = Formula::unknown;
    std::vector<double> coefficients = {};                                       // c0, c1, ... of the formula
    std::array<double, 2> range_nm{0, std::numeric_limits<double>::infinity()};  // wavelengths in air for which the formula holds

    bool covers(double wavelength_nm) const { return wavelength_nm >= range_nm[0] && wavelength_nm <= range_nm[1]; }
    bool operator==(const Glass&) const = default;
};

/// Returns the formula's key in descriptions, JSON and Python, "sellmeier"; "nd" for nd_vd, which has two; empty for unknown.
std::string_view key_of(Formula);

/// Whether a formula takes this number of coefficients.
bool takes(Formula, std::size_t coefficients);

/// Returns n at a wavelength in air, in or beyond the glass's range. It is NaN or infinite where the formula has no value, and NaN
/// where takes() is false.
double index_of(const Glass&, double wavelength_nm);

/// Wavelengths in air at which makers state indices.
struct SpectralLine {
    std::string_view name;
    double wavelength_nm;
};
inline constexpr double F_line_nm = 486.1327, d_line_nm = 587.5618, C_line_nm = 656.2725;
/// Returns the lines from i (365 nm) to t (1014 nm), by wavelength.
std::span<const SpectralLine> spectral_lines();

/// Returns V_d = (n_d - 1) / (n_F - n_C); infinite for an index that does not change.
double abbe_number(const Glass&);

/// A glass that ships with the program, and whose measurement it is.
struct ShippedGlass {
    Glass glass;
    std::string_view source;          // catalogue or publication of the coefficients
    std::string_view successor = {};  // of an older glass: the newer one of the same glass code, whose coefficients it has here
};
/// Returns all glasses that ship: plastics first, then glasses by name.
const std::vector<ShippedGlass>& shipped_glasses();

/// Returns the glass that ships under a name, in any case of letters; null if there is none.
const ShippedGlass* shipped_glass(std::string_view name);

/// Whether two names are equal apart from the case of letters A to Z.
bool same_name(std::string_view a, std::string_view b);

}  // namespace lfdsim
