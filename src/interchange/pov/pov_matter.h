// What POV-Ray's shapes are made of. Floor 2.
#pragma once
#include "interchange/peers/scene_text.h"

#include <string>

namespace lfdsim::peers {

/// Returns the material of what absorbs.
inline std::string black() { return "texture { Black }"; }
/// Returns the material of a face behind which the medium has this refractive index.
inline std::string medium(double index) { return fmt::format("texture {{ Clear }} interior {{ ior {} }}", text(index)); }

}  // namespace lfdsim::peers
