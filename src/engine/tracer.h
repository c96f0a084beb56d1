// A picture by a kernel of the caller's. Floor 2.
#pragma once
#include "engine/kernel.h"
#include "engine/render.h"

namespace lfdsim {

/// What turns tiles into light, and the scene that it is given with each. The scene may be a part of a larger one that the kernel
/// knows.
struct Tracer {
    const char* name;
    Kernel run;
    const optics::Scene<float>& scene;
};

/// As render(), which is this with the kernels of the table. Throws InputError.
Rendering render_with(const Tracer&, const Display&, const Geometry&, const std::vector<optics::PanelLevel>&, const RenderOptions&,
                      Job&);

}  // namespace lfdsim
