// Look-up of glasses by name, in the user's catalogues and among those that ship. Floor 2.
#pragma once
#include "display/display.h"
#include "files/lenses/agf.h"

#include <span>
#include <string>
#include <string_view>

namespace lfdsim {

/// Returns the glass of a name, in any case of letters: the first in the catalogues in their order, else the one that ships; null
/// if there is none, or if a catalogue has one that cannot be used. The pointer is into the catalogues.
const Glass* find_glass(std::string_view name, std::span<const GlassCatalogue>);

/// Returns a message about a name that find_glass() does not find: why a catalogue's glass is left out, else up to three names that
/// are near.
std::string unknown_glass(std::string_view name, std::span<const GlassCatalogue>);

/// Returns the doubts about glasses that a display takes from its glass_catalogues. The files are read again, and InputError is
/// thrown where one cannot be.
std::vector<Problem> doubts_of_glasses(const Display&);

}  // namespace lfdsim
