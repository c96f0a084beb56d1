// A picture rendered by a kernel that the caller supplies. Floor 2.
#pragma once
#include "engine/devices/kernel.h"
#include "engine/render.h"

namespace lfdsim {

/// A kernel and the display that it is given with each tile, which may be a base class of a larger one that the kernel expects.
struct Tracer {
    const char* name;
    Kernel run;
    const optics::TracedDisplay<float>& scene;
};

/// Renders as render(), with this kernel in place of those of the table. Throws InputError.
Rendering render_with(const Tracer&, const Display&, const Geometry&, const std::vector<optics::SummedImage>&, const RenderOptions&,
                      Job&);

}  // namespace lfdsim
