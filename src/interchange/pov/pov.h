// A display as a scene of POV-Ray 3.7. Floor 2.
#pragma once
#include "interchange/peers/peers.h"

#include <string>

namespace lfdsim::peers {

/// Adds the scene's file, picture and command, and its deviations. `head`: lines for its first comment, before the deviations.
void write_pov(const Display&, const Geometry&, const PeerOptions&, std::vector<std::string> head, PeerScene&);

}  // namespace lfdsim::peers
