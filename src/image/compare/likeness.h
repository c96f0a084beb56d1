// How similar a view of a display is to a photograph of the scene that it shows. Floor 0.
#pragma once
#include "image/compare/region.h"
#include "image/image.h"

namespace lfdsim {

/// How a view and the photograph of the scene agree. docs/measures.md, "Field of view".
struct Likeness {
    double screen, content;  // SSIM (ssim.h) over these regions; NaN where no window lies in them
    /// Over the screen, linear light: covariance of view and photograph divided by the photograph's variance. A view that blends a
    /// share s of the right picture with an uncorrelated one has s; SSIM falls much faster. NaN where the photograph has only one
    /// colour.
    double share;
};

/// Compares a view, its light multiplied by `gain`, with a photograph. The bits are the same on any number of threads. Throws
/// InputError unless both pictures have the same size.
Likeness likeness(Image view, float gain, const Image& photograph, const Region& screen, const Region& content);

/// The sums over the screen that the share is computed from: luma of linear light, of the view and of the photograph.
enum CoverSum { of_view, of_photograph, of_both, of_photograph_squared, cover_sums };

/// Returns the share from these sums over a number of pixels: cov(view, photograph) / var(photograph). NaN where the photograph's
/// variance is below 1e-9 of its mean square.
double covered_share(const double (&sums)[cover_sums], std::int64_t pixels);

}  // namespace lfdsim
