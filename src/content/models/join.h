// Objects of a scene as one model. Floor 2, internal to content.
#pragma once
#include "content/content.h"
#include "content/models/model.h"
#include "geometry/resolve.h"

namespace lfdsim {

/// The models of the objects in their order, each turned, scaled and put in its place, joined. Positions are in millimetres about
/// the point on the display's axis in the depth middle_z_mm(). Throws InputError for a model that cannot have the size it is
/// given, and where all together need more memory than there is.
std::shared_ptr<const Model> joined(const ContentParts&, const std::vector<SceneObject>&);

}  // namespace lfdsim
