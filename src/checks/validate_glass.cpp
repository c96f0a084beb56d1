// Checks of media: each has either an index or a glass, whose index is known and plausible at every wavelength that is used.

#include "base/counted.h"
#include "checks/findings.h"
#include "display/colour.h"

namespace lfdsim {
namespace {

constexpr double least_index = 1, greatest_index = 4;

std::string named(const Glass& glass) { return glass.name.empty() ? "the glass" : fmt::format("\"{}\"", glass.name); }

// Checks a glass at each wavelength that is used and reports the first problem; the other wavelengths mostly have the same one.
void check_wavelengths(const std::string& where, const Glass& glass, const Display& d, Findings& findings) {
    for (int channel = 0; channel < 3; ++channel)
        for (const auto& [nm, weight] : wavelengths_of(d, channel)) {
            const double n = index_of(glass, nm);
            const bool apart = nm != d.panel.wavelengths_nm[std::size_t(channel)];
            if (!glass.covers(nm))
                return findings.add(
                    where, "{} is valid from {:.6g} to {:.6g} nm, but is used at {:.6g} nm; take another glass, or {}",
                    named(glass), glass.range_nm[0], glass.range_nm[1], nm,
                    apart ? "fewer render.wavelength_samples, or less panel.primary_widths_nm" : "other panel.wavelengths_nm");
            if (!(n >= least_index && n <= greatest_index))
                return findings.add(where, "{} has an index of {:.6g} at {:.6g} nm, allowed is {} to {}", named(glass), n, nm,
                                    least_index, greatest_index);
        }
}

// Checks the glass's formula and coefficients, then its index at the wavelengths, if these are sound.
void check_glass(const std::string& where, const Glass& glass, const Display& d, Findings& findings) {
    if (glass.formula == Formula::unknown) return findings.add(where, "{} has not been looked up in a catalogue", named(glass));
    if (!takes(glass.formula, glass.coefficients.size()))
        return findings.add(where, "{} has {}, too few or too many for its formula", named(glass),
                            counted(glass.coefficients.size(), "coefficient"));
    if (glass.formula == Formula::nd_vd && !(glass.coefficients[1] > 0))
        return findings.add(where, "has vd = {}; an Abbe number is more than 0", glass.coefficients[1]);
    if (findings.sound("panel.wavelengths_nm") && findings.sound("panel.primary_widths_nm") && findings.sound("render."))
        check_wavelengths(where, glass, d, findings);
}

void check_medium(const Medium& medium, const Display& d, Findings& findings) {
    const std::string index = medium.table + ".index", glass = medium.table + ".glass";
    if (!findings.sound(index) || !findings.sound(glass)) return;
    if (medium.index && medium.glass) return findings.add(glass, "both {} and {} given; leave one out", index, glass);
    if (!medium.index && !medium.glass && !medium.may_be_air)
        return findings.add(index, "is missing; give {}, or {}", index, glass);
    if (medium.glass) check_glass(glass, *medium.glass, d, findings);
}

}  // namespace

void validate_glass(const Display& d, Findings& findings) {
    if (d.render.wavelength_samples > 1 && !d.panel.primary_widths_nm && findings.sound("panel.primary_widths_nm") &&
        findings.sound("render.wavelength_samples"))
        findings.add("render.wavelength_samples", "is {}, but panel.primary_widths_nm is missing; give it, or leave this out",
                     d.render.wavelength_samples);
    for (const Medium& medium : media_of(d))
        if (findings.sound("lens.type") || !medium.table.starts_with("lens")) check_medium(medium, d, findings);
}

}  // namespace lfdsim
