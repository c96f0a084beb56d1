// The colours of a panel: at which wavelengths its channels shine, and the media that their light passes. Floor 0.
#pragma once
#include "display/display.h"

#include <string>
#include <vector>

namespace lfdsim {

/// The channel whose light decides every length that depends on an index.
inline constexpr std::size_t green_channel = 1;

/// A wavelength at which a channel is traced, and its share of the channel's light.
struct Node {
    double wavelength_nm, weight;
};

/// The wavelengths of a channel (0 red, 1 green, 2 blue), in ascending order; the weights' sum is 1. With K =
/// render.wavelength_samples > 1 they are the nodes of Gauss-Hermite quadrature over a normal distribution of the primary's
/// width.
std::vector<Node> wavelengths_of(const Display&, int channel);

/// Index of a medium given by either; of neither: air's.
double index_at(const std::optional<double>& index, const std::optional<Glass>&, double wavelength_nm);

/// A medium of a display, as its description gives it.
struct Medium {
    std::string table;  // "lens", "lens.surface.0", "panel.layer.1"
    const std::optional<double>& index;
    const std::optional<Glass>& glass;
    bool may_be_air;
    bool is_passed;  // light meets it: not what a prescription names after its last surface
};
/// Returns the media of a display, from the panel upwards.
std::vector<Medium> media_of(const Display&);

/// Whether the path of light depends on its wavelength: an index differs between those that are used.
bool disperses(const Display&);

/// What light of one wavelength meets of a valid display, as one that does not disperse: each glass has its index there, and
/// lenses stand where green has put them.
Display at_wavelength(Display, double wavelength_nm);

}  // namespace lfdsim
