// A display as a scene of POV-Ray 3.7. Floor 2.
#pragma once
#include "peers/peers.h"

#include <string>

namespace lfdsim::peers {

/// Adds the scene's file, picture and command, and what deviates. `head`: lines that go into its first comment, deviations after
/// them.
void write_pov(const Display&, const Geometry&, const PeerOptions&, std::vector<std::string> head, PeerScene&);

}  // namespace lfdsim::peers
