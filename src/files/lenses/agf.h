// Glass catalogues in AGF, the format of Zemax: makers publish their glasses in it. Floor 2.
#pragma once
#include "base/input_error.h"
#include "display/glass.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// A doubt about a glass: it was left out, or its stated n_d differs from that of its coefficients by more than 1e-4.
struct GlassDoubt {
    std::string glass;
    Problem problem;  // where: "file:line"
};

/// The glasses of one file, in its order.
struct GlassCatalogue {
    std::string file;  // its name as it was given
    std::vector<Glass> glasses;
    std::vector<GlassDoubt> doubts;
};

inline constexpr std::size_t largest_agf_bytes = std::size_t(8) << 20, most_glasses = 10000;

/// Reads a catalogue in UTF-8, Latin-1, or UTF-16 with its mark. Indices are relative to air, at the temperature of the catalogue.
/// Throws InputError with "name:line" where a number cannot be read, or where there is no glass at all; a glass that cannot be used
/// is a doubt, not an error.
GlassCatalogue parse_agf(std::string_view bytes, std::string_view name);

/// Reads the catalogue of a file of at most 8 MiB, and throws like parse_agf().
GlassCatalogue read_agf(const std::filesystem::path&);

}  // namespace lfdsim
