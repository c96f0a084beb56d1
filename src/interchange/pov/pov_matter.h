// What POV-Ray's shapes are made of. Floor 2.
#pragma once
#include "interchange/peers/scene_text.h"

#include <string>

namespace lfdsim::peers {

inline std::string black() { return "texture { Black }"; }
inline std::string medium(double index) { return fmt::format("texture {{ Clear }} interior {{ ior {} }}", text(index)); }

}  // namespace lfdsim::peers
