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

/// Dimensions of the sampler that a display needs; 0: there is nothing to sample, one ray tells all.
int sample_dimensions(const Display&);

const optics::Directions& sobol_directions();

}  // namespace lfdsim
