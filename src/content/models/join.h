// The objects of a scene as one model. Floor 2, internal to content.
#pragma once
#include "content/content.h"
#include "content/models/model.h"

namespace lfdsim {

/// Returns the models of the objects joined in their order, each rotated, scaled and moved to its position: k (R p - m) +
/// position (docs/model.md, "Pose"). Positions are in mm about the point on the display's axis at the depth middle_z_mm(). Throws
/// InputError for a model that cannot have the size that it is given, and for too many triangles.
std::shared_ptr<const Model> joined(const ContentParts&, const std::vector<SceneObject>&);

}  // namespace lfdsim
