// A lens from a lens design program as the lens of a display. Floor 2.
#pragma once
#include "display/display.h"
#include "files/lenses/drawn_lens.h"
#include "files/lenses/glasses.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// What the user takes for a glass of the file: an index, a glass by its coefficients, or one by another name.
struct GlassChoice {
    std::string name;
    std::optional<double> index;
    std::optional<Glass> glass;
};

/// How the lens is to stand, and before what. Lengths are those of the display, not of the file.
struct ImportRequest {
    bool flip = false;                       // the file's object side faces the panel, not its image side
    double scale = 1;                        // of all lengths of the lens
    std::optional<double> gap_mm;            // absent: the panel stands where the file's image (flipped: its object) is
    std::optional<double> pitch_mm;          // absent: as wide as the lens
    std::optional<double> semi_aperture_mm;  // of surfaces for which the file has none
    double panel_inch = 24;
    std::array<std::int64_t, 2> pixels{3840, 2160};
    double distance_mm = 600;  // of the eye from the panel
    std::vector<GlassChoice> glasses;
    std::vector<GlassCatalogue> catalogues;
};

struct Imported {
    std::string what;  // it is: a noun phrase
    Display display;
    std::vector<std::string> surfaces;    // where in the file each surface of the lens stands
    std::vector<std::string> catalogues;  // files of the request whose glasses the lens has
    std::vector<std::string> notes;       // what was assumed
};

/// A valid display. Throws InputError with the file's place, or the option of `lfdsim import`, of all that cannot be.
Imported import_lens(DrawnLens, const ImportRequest&);

/// TOML that reads back as the display, with the notes and the places of surfaces as comments. `made_by`: the command line.
/// `catalogues`: those of the lens, as seen from the description's folder.
std::string write_imported(const Imported&, const std::vector<std::string>& catalogues, const std::string& made_by);

}  // namespace lfdsim
