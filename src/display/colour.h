// The colours of a panel: the wavelengths that its channels emit, and the media that their light passes. Floor 0.
#pragma once
#include "display/display.h"

#include <string>
#include <vector>

namespace lfdsim {

/// The channel for whose light every length that depends on an index is stated (docs/model.md, "Colour").
inline constexpr std::size_t green_channel = 1;

/// A wavelength at which a channel is traced, and its share of the channel's light.
struct Node {
    double wavelength_nm, weight;
};

/// Returns the wavelengths of a channel (0 red, 1 green, 2 blue), in ascending order; the weights' sum is 1. With K =
/// render.wavelength_samples > 1 they are the nodes of Gauss-Hermite quadrature over a normal distribution of the primary's
/// width: exact where light depends on the wavelength as a polynomial of degree 2K - 1.
std::vector<Node> wavelengths_of(const Display&, int channel);

/// Returns the index of a medium that has either; 1, air's, where it has neither.
double index_at(const std::optional<double>& index, const std::optional<Glass>&, double wavelength_nm);

/// A medium of a display, as its description gives it. It refers to that display, which must outlive it.
struct Medium {
    std::string table;  // "lens", "lens.surface.0", "panel.layer.1"
    const std::optional<double>& index;
    const std::optional<Glass>& glass;
    bool may_be_air;  // the description may give neither index nor glass
    bool is_passed;   // light passes it; false of the medium that a prescription names after its last surface
};
/// Returns the media of a display, from the panel upwards.
std::vector<Medium> media_of(const Display&);

/// Whether the path of light depends on its wavelength: a glass has different indices at the wavelengths that are used.
bool disperses(const Display&);

/// Returns a valid display as light of one wavelength meets it: each glass is replaced by its index there, and the lenses are where
/// the gap puts them in green light.
Display at_wavelength(Display, double wavelength_nm);

}  // namespace lfdsim
