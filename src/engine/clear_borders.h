// Where light enters lenses that fill their cells, for the filtered estimator's outlines. Floor 2.
#pragma once
#include "model/display.h"
#include "model/geometry.h"
#include "optics/scene.h"

namespace lfdsim {

/// Fills scene.clear_borders for the slopes at which a picture sees the display: rays of each are traced to both sides of a border.
/// None where light also enters beside the lenses, or a stop cuts it, nor of slopes that leave not even the middle of a lens lit,
/// or whose borders are bent beside the parts of the square, so wide on the lenses: outlines have straight sides, and the rays of
/// narrow parts find out better what is hidden.
void add_clear_borders(optics::Scene<float>& scene, const Display&, const Geometry&, const optics::View&, double part_mm);

}  // namespace lfdsim
