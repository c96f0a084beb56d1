// Glasses by their names, in catalogues of the user's and in the one that ships. Floor 2.
#pragma once
#include "display/display.h"
#include "files/lenses/agf.h"

#include <span>
#include <string>
#include <string_view>

namespace lfdsim {

/// The glass of a name, whatever its case: the first in the catalogues in their order, or the one that ships; null if there is
/// none.
const Glass* find_glass(std::string_view name, std::span<const GlassCatalogue>);

/// What is wrong with a name that find_glass() does not find, and which ones are near.
std::string unknown_glass(std::string_view name, std::span<const GlassCatalogue>);

/// What is doubtful of the glasses that a display takes from its own catalogues, which are read again.
std::vector<Problem> doubts_of_glasses(const Display&);

}  // namespace lfdsim
