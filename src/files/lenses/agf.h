// Glass catalogues in AGF, the format of Zemax: makers publish their glasses in it. Floor 2.
#pragma once
#include "base/input_error.h"
#include "display/glass.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// A doubt about a glass that was left out, or whose stated n_d is not that of its coefficients.
struct GlassDoubt {
    std::string glass;
    Problem problem;  // where: "file:line"
};

struct GlassCatalogue {
    std::string file;
    std::vector<Glass> glasses;
    std::vector<GlassDoubt> doubts;
};

inline constexpr std::size_t largest_agf_bytes = std::size_t(8) << 20, most_glasses = 10000;

/// The glasses of a catalogue in UTF-8, Latin-1, or UTF-16 with its mark. Indices are relative to air, at the catalogue's own
/// temperature. Throws InputError with "name:line" where a number cannot be read, or where there is no glass at all.
GlassCatalogue parse_agf(std::string_view bytes, std::string_view name);

/// Reads the catalogue of a file of at most 8 MiB.
GlassCatalogue read_agf(const std::filesystem::path&);

}  // namespace lfdsim
