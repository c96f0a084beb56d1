// From pictures of slanted edges to the modulation transfer function, after ISO 12233. Floor 3.
//
// Levels are known here: black is 0, and a second picture shows what white would be at each pixel. So gaps between lenses, uneven
// light and the like drop out, and nothing is normalised: light that strays farther than the edge's reach counts as lost contrast.
// The edges' direction is known, too. A line fitted to the picture would follow the facets in which a lens array shows an edge.
#pragma once
#include "analysis/core/estimate.h"
#include "analysis/resolution/fourier.h"
#include "base/constants.h"
#include "image/image.h"

#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace lfdsim {

/// Parallel edges, nearly upright, that cross a picture from its first row to its last. In pixels from its upper left corner.
struct Edges {
    /// An edge of a picture: a straight line between black and white.
    struct EdgeLine {
        double at;    // where it meets row 0
        bool rising;  // bright on its right
    };
    std::vector<EdgeLine> lines;
    double slope = 0;  // columns a row
    double reach = 0;  // how far on each side, across the edge, pixels belong to this edge; at least 1
};

/// The edge spread function: light as a share of white's against the distance to the right of the edge, in bins of a quarter pixel;
/// the mean of all edges of all pictures that are added. A falling edge counts by its difference from white, so that all have the
/// same direction. The upper and lower halves of pictures are assigned in turn to `independent_sets` sets.
class EdgeSpread {
  public:
    /// The reach of all edges that are added.
    explicit EdgeSpread(double reach);
    /// Pictures of one size. Parts of edges outside the picture are ignored.
    void add(const Edges&, const Image& picture, const Image& white);

    /// The MTF of red, green and blue at frequencies in cycles a pixel, 0 to 1: the modulus of the Fourier transform of the
    /// spread function's derivative, corrected for the attenuation by the bins and by the differences between them. NaN where
    /// there is no light. Of all sets but the one numbered `without`.
    std::array<std::vector<double>, 3> mtf(std::span<const double> frequencies, int without = -1) const;

  private:
    struct Bin {
        std::array<double, 3> light{}, white{};
    };
    double reach_;
    std::array<std::vector<Bin>, independent_sets> sets_;
    int pictures_ = 0;
};

/// The frequency at which a curve over rising frequencies first falls below a level; NaN if it never does.
double falls_below(std::span<const double> frequencies, std::span<const double> curve, double level);

}  // namespace lfdsim
