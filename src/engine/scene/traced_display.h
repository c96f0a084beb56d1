// Conversion of a display description to the tracer's plain numbers. Floor 2.
#pragma once
#include "display/display.h"
#include "engine/devices/kernel.h"
#include "geometry/geometry.h"
#include "optics/traced_display.h"

#include <memory>
#include <vector>

namespace lfdsim {

/// A scene and what it points to. Copies share that.
template <class S>
struct StoredDisplay : optics::TracedDisplay<S> {
    std::shared_ptr<const std::vector<optics::MisalignedLens<S>>> lenses;
};

/// The display for an S of float (kernels) or double (the accuracy reference). Throws InputError if a lens has more surfaces or
/// asphere terms than the tracer holds.
template <class S>
StoredDisplay<S> make_traced_display(const Display&, const Geometry&);

/// The camera, with the height of the plane where the tracer starts.
optics::RayOrigin make_ray_origin(const Display&, const Geometry&);

/// The estimator that a display is rendered with: the one it asks for, but points where the filtered one does not apply (neither a
/// diffuser nor a pixel filter).
Estimator estimator_of(const Display&);

/// The display as a GPU renders it: by points, so many unless it says how many.
constexpr std::int64_t points_on_gpu = 256;
Display by_points(const Display&);

/// Samples per pixel: what the display asks for, or the default; for the filtered estimator rounded up to a square number, rows
/// times columns of strata.
std::int64_t samples_of(const Display&);

/// Dimensions of the sampler that a display needs; 0: there is nothing to sample, one ray a pixel is exact.
int sample_dimensions(const Display&);

/// The blocks in which the filtered estimator renders a display.
struct BlockShape {
    bool shared;  // blocks of pixels cut the diffuser's angles by one grid of strata, and share its rays; else lens by lens
    int side;     // of such a block, pixels: 16, 8 or 4
};
/// One grid serves a pinhole camera that looks through pixels' middles and a diffuser that spans lenses, in rows and columns along
/// its axes, not too coarsely. A block spans less than a pixel sees of a lens, much less where many strata, so many along an axis,
/// ask for a fine picture, nearly as much for a rough one.
BlockShape block_shape(const optics::TracedDisplay<float>&, const optics::RayOrigin&, int strata, bool rough = false);

/// Whether lenses' outlines cut the pixel's area, because the diffuser, if there is one, spreads rays over less of the lenses?
bool cuts_pixel(const optics::TracedDisplay<float>&, const optics::RayOrigin&);

const optics::DirectionNumbers& sobol_directions();

}  // namespace lfdsim
