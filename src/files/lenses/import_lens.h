// A lens from a lens design program as the lens of a display: docs/import.md. Floor 2.
#pragma once
#include "display/display.h"
#include "files/lenses/drawn_lens.h"
#include "files/lenses/glasses.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace lfdsim {

/// The index or glass that the user gives in place of a glass of the file.
struct GlassChoice {
    std::string name;  // of the glass in the file
    std::optional<double> index;
    std::optional<Glass> glass;
};

/// How the lens is placed, and before which panel and eye. Lengths are those of the display, not of the file.
struct ImportRequest {
    bool flip = false;                       // the file's object side faces the panel, not its image side
    double scale = 1;                        // factor of all lengths of the lens
    std::optional<double> gap_mm;            // absent: the panel is at the file's image (flipped: at its object)
    std::optional<double> pitch_mm;          // absent: the width of the widest surface
    std::optional<double> semi_aperture_mm;  // of surfaces for which the file has none
    double panel_inch = 24;                  // the panel's diagonal
    std::array<std::int64_t, 2> pixels{3840, 2160};
    double distance_mm = 600;  // of the eye from the panel
    std::vector<GlassChoice> glasses;
    std::vector<GlassCatalogue> catalogues;
};

/// A display that was made from a file of another program.
struct Imported {
    std::string what;  // a noun phrase that says what it is
    Display display;
    std::vector<std::string> surfaces;    // the place in the file of each surface of the display's lens
    std::vector<std::string> catalogues;  // files of the request whose glasses the lens has
    std::vector<std::string> notes;       // sentences: what was assumed, changed or left out
};

/// Returns a valid display with the lens. Throws InputError with the place in the file, or the option of `lfdsim import`, of
/// everything that is wrong.
Imported import_lens(DrawnLens, const ImportRequest&);

/// Returns TOML that reads back as the display, with the notes and the places of surfaces as comments. `made_by`: the command line.
/// `catalogues`: those of the lens, relative to the description's folder.
std::string write_imported(const Imported&, const std::vector<std::string>& catalogues, const std::string& made_by);

}  // namespace lfdsim
