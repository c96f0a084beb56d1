#pragma once
#include "optics/sequential.h"
namespace lfdsim::optics::inline LFDSIM_ISA {
template <class F>
LFDSIM_FN PanelHit<F> trace_glass(const Scene<Scalar<F>>& scene, const Extent<F>& extent, const PanelBase<F>& base,
                                  Passage<F> way) {
    return trace_opaque(scene, extent, base, way);
}
}  // namespace lfdsim::optics::inline LFDSIM_ISA
