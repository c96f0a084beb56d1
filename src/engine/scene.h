// From a display description to the tracer's plain numbers. Floor 2.
#pragma once
#include "model/display.h"
#include "model/geometry.h"
#include "optics/scene.h"

namespace lfdsim {

/// The display for an S of float (kernels) or double (the accuracy reference). Throws InputError if a lens has more surfaces or
/// asphere terms than the tracer holds.
template <class S>
optics::Scene<S> make_scene(const Display&, const Geometry&);

/// The camera, with the height of the plane where the tracer begins.
optics::View make_view(const Display&, const Geometry&);

/// The estimator that a display is rendered with: what it asks for, but points where the filtered one does not apply (no diffuser;
/// a pixel filter, a pupil or a turned array beside it).
Estimator estimator_of(const Display&);

/// Samples a pixel: what the display asks for or the default; of the filtered estimator a square number, of rows and columns of
/// strata.
std::int64_t samples_of(const Display&);

/// Dimensions of the sampler that a display needs; 0: there is nothing to sample, one ray tells all.
int sample_dimensions(const Display&);

/// Pixels along the side of the blocks in which the filtered estimator shares its rays, if it cuts each axis into so many strata:
/// 16, 8 or 4, less than what a pixel sees of a lens, and much less where many strata ask for a fine picture; nearly as much for a
/// rough one.
int block_side(const optics::Scene<float>&, const optics::View&, int strata, bool rough = false);

const optics::Directions& sobol_directions();

}  // namespace lfdsim
