// Conversion of a display description to the tracer's plain numbers. Floor 2.
#pragma once
#include "display/display.h"
#include "engine/devices/kernel.h"
#include "geometry/geometry.h"
#include "optics/traced_display.h"

#include <memory>
#include <vector>

namespace lfdsim {

/// A display as the tracer reads it, and the memory that it points to, which copies share.
template <class S>
struct StoredDisplay : optics::TracedDisplay<S> {
    std::shared_ptr<const std::vector<optics::MisalignedLens<S>>> lenses;  // null if all are at their lattice positions
};

/// Returns the display for an S of float (kernels) or double (the accuracy reference), at the wavelength of the geometry. Throws
/// InputError if it has more surfaces, asphere terms, layers or subpixel parts than the tracer holds, or too many misaligned lenses
/// for the memory.
template <class S>
StoredDisplay<S> make_traced_display(const Display&, const Geometry&);

/// Returns the camera, with the height of the plane where the tracer starts.
optics::RayOrigin make_ray_origin(const Display&, const Geometry&);

/// Returns the estimator that a display is rendered with: that of its description, but points where the filtered one does not apply
/// (neither a diffuser nor a pixel filter).
Estimator estimator_of(const Display&);

/// Points a pixel of by_points() where the description has no number.
constexpr std::int64_t points_on_gpu = 256;
/// Returns the display as a GPU renders it: by points.
Display by_points(const Display&);

/// Returns the samples per pixel: those of the description, or the default; for the filtered estimator rounded up to a square
/// number, rows times columns of strata.
std::int64_t samples_of(const Display&);

/// Returns the number of dimensions of the sampler that a display needs; 0: there is nothing to sample, one ray a pixel is exact.
int sample_dimensions(const Display&);

/// The blocks in which the filtered estimator renders a display.
struct BlockShape {
    bool shared;  // blocks of pixels cut the diffuser's angles by one grid of strata, and share its rays; else lens by lens
    int side;     // of such a block, pixels: 16, 8 or 4
};
/// Returns the blocks for `strata` rows and columns of strata. Pixels share a grid for a pinhole camera that looks through pixels'
/// middles and a diffuser that spreads rays over lenses in rows and columns along its axes, where pixels are not too coarse. A
/// block is narrower than what a pixel sees of a lens: much narrower where there are many strata, for a fine picture, nearly as
/// wide for a `rough` one. The limits are in engine/estimator/limits.h.
BlockShape block_shape(const optics::TracedDisplay<float>&, const optics::RayOrigin&, int strata, bool rough = false);

/// Returns whether lenses' outlines cut the pixel's area, not the diffuser's angles: because the diffuser, if there is one, spreads
/// rays over less of the lenses than the pixel does.
bool cuts_pixel(const optics::TracedDisplay<float>&, const optics::RayOrigin&);

/// Returns the direction numbers of the Sobol sequence, computed once.
const optics::DirectionNumbers& sobol_directions();

}  // namespace lfdsim
