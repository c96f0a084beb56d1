// The modulation transfer function from pictures of slanted edges, after ISO 12233. Floor 3.
//
// Levels are known here: black is 0, and a second picture shows what white would be at each pixel. So gaps between lenses and
// uneven light drop out, and nothing is normalised: light that strays farther than the edge's reach counts as lost contrast. The
// edges' direction is known, too: a line fitted to the picture would follow the facets in which a lens array shows an edge.
// docs/measures.md, "Resolution", edges.
#pragma once
#include "analysis/core/estimate.h"
#include "image/image.h"

#include <array>
#include <span>
#include <vector>

namespace lfdsim {

/// Parallel, nearly upright edges that cross a picture from its first row to its last. Positions in pixels from its upper left
/// corner.
struct Edges {
    /// An edge of a picture: a straight line between black and white.
    struct EdgeLine {
        double at;    // column at which it meets row 0
        bool rising;  // bright on its right
    };
    std::vector<EdgeLine> lines;
    double slope = 0;  // columns per row
    double reach = 0;  // distance to either side, across the edge, within which pixels belong to it; at least 1
};

/// The edge spread function: light as a share of white's over the distance to the right of the edge, in bins of a quarter pixel,
/// from all edges of all pictures that are added. A falling edge counts by its difference from white, so that all edges rise. The
/// upper and lower halves of pictures are assigned in turn to `independent_sets` sets.
class EdgeSpread {
  public:
    /// `reach`: that of all edges that are added, pixels.
    explicit EdgeSpread(double reach);
    /// Adds the edges of a picture; `white` shows white instead of the edges, in a picture of the same size. Parts of edges
    /// outside the picture are ignored.
    void add(const Edges&, const Image& picture, const Image& white);

    /// Returns the MTF of red, green and blue at frequencies in cycles per pixel, 0 to 1: the modulus of the Fourier transform of
    /// the edge spread function's derivative, over sinc^2(f/4) for bins and differences. NaN if there is no light. `without`: the
    /// set that is left out; -1: none.
    std::array<std::vector<double>, 3> mtf(std::span<const double> frequencies, int without = -1) const;

  private:
    /// The light of a bin, red, green and blue, and that of white.
    struct Bin {
        std::array<double, 3> light{}, white{};
    };
    double reach_;
    std::array<std::vector<Bin>, independent_sets> sets_;
    int pictures_ = 0;
};

/// Returns the frequency at which a curve over ascending frequencies first falls below a level, by linear interpolation; NaN if
/// it never does.
double falls_below(std::span<const double> frequencies, std::span<const double> curve, double level);

}  // namespace lfdsim
