#include "display/glass.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace lfdsim {
namespace {

constexpr SpectralLine lines[] = {{"i", 365.0146}, {"h", 404.6561},  {"g", 435.8343}, {"F'", 479.9914}, {"F", F_line_nm},
                                  {"e", 546.074},  {"d", d_line_nm}, {"D", 589.2938}, {"C'", 643.8469}, {"C", C_line_nm},
                                  {"r", 706.5188}, {"s", 852.11},    {"t", 1013.98}};

/// 1/l^2, l in micrometres.
double inverse_square(double wavelength_nm) { return 1e6 / (wavelength_nm * wavelength_nm); }

/// Returns n = A + B/l^2, which is n_d at the d line and has n_F - n_C = (n_d - 1)/V_d: B = (n_d - 1)/V_d / (1/F^2 - 1/C^2).
double through_d(double nd, double vd, double wavelength_nm) {
    const double B = (nd - 1) / vd / (inverse_square(F_line_nm) - inverse_square(C_line_nm));
    return nd + B * (inverse_square(wavelength_nm) - inverse_square(d_line_nm));
}

/// Returns the sum of B l^2/(l^2 - C) over the pairs B, C.
double resonant(std::span<const double> pairs, double l2) {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) sum += pairs[k] * l2 / (l2 - pairs[k + 1]);
    return sum;
}

/// Returns the sum of c l^p over the pairs c, p.
double powers(std::span<const double> pairs, double l) {
    double sum = 0;
    for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) sum += pairs[k] * std::pow(l, pairs[k + 1]);
    return sum;
}

}  // namespace

std::string_view key_of(Formula formula) {
    static constexpr std::string_view keys[] = {"",           "nd",          "cauchy",     "conrady",    "herzberger",  "sellmeier",
                                                "resonances", "sellmeier_2", "handbook_1", "handbook_2", "power_series"};
    static_assert(std::size(keys) == std::size_t(Formula::power_series) + 1);  // in the order of Formula
    return keys[std::size_t(formula)];
}

bool takes(Formula formula, std::size_t count) {
    switch (formula) {
        case Formula::unknown:
            return false;
        case Formula::nd_vd:
            return count == 2;
        case Formula::cauchy:
        case Formula::conrady:
            return count == 3;
        case Formula::handbook_1:
        case Formula::handbook_2:
            return count == 4;
        case Formula::sellmeier_2:
            return count == 5;
        case Formula::herzberger:
            return count == 6;
        case Formula::resonances:
            return count % 2 == 1;
        case Formula::sellmeier:
        case Formula::power_series:
            return count > 0 && count % 2 == 0;
    }
    return false;
}

double index_of(const Glass& glass, double wavelength_nm) {
    const std::span<const double> c = glass.coefficients;
    const double l = wavelength_nm / 1000, l2 = l * l;
    if (!takes(glass.formula, c.size())) return std::numeric_limits<double>::quiet_NaN();
    switch (glass.formula) {
        case Formula::unknown:
            break;
        case Formula::nd_vd:
            return through_d(c[0], c[1], wavelength_nm);
        case Formula::cauchy:
            return c[0] + c[1] / l2 + c[2] / (l2 * l2);
        case Formula::conrady:
            return c[0] + c[1] / l + c[2] / std::pow(l, 3.5);
        case Formula::herzberger: {
            const double L = 1 / (l2 - 0.028);
            return c[0] + c[1] * L + c[2] * L * L + c[3] * l2 + c[4] * l2 * l2 + c[5] * l2 * l2 * l2;
        }
        case Formula::sellmeier:
            return std::sqrt(1 + resonant(c, l2));
        case Formula::resonances:
            return std::sqrt(c[0] + resonant(c.subspan(1), l2));
        case Formula::sellmeier_2:
            return std::sqrt(1 + c[0] + c[1] * l2 / (l2 - c[2] * c[2]) + c[3] / (l2 - c[4] * c[4]));
        case Formula::handbook_1:
            return std::sqrt(c[0] + c[1] / (l2 - c[2]) - c[3] * l2);
        case Formula::handbook_2:
            return std::sqrt(c[0] + c[1] * l2 / (l2 - c[2]) - c[3] * l2);
        case Formula::power_series:
            return std::sqrt(powers(c, l));
    }
    return std::numeric_limits<double>::quiet_NaN();
}

std::span<const SpectralLine> spectral_lines() { return lines; }

double abbe_number(const Glass& glass) {
    return (index_of(glass, d_line_nm) - 1) / (index_of(glass, F_line_nm) - index_of(glass, C_line_nm));
}

const ShippedGlass* shipped_glass(std::string_view name) {
    const std::vector<ShippedGlass>& all = shipped_glasses();
    const auto found = std::find_if(all.begin(), all.end(), [&](const ShippedGlass& s) { return same_name(s.glass.name, name); });
    return found == all.end() ? nullptr : &*found;
}

bool same_name(std::string_view a, std::string_view b) { return same_without_case(a, b); }

}  // namespace lfdsim
