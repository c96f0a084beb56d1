// A display as a Python script for Blender's Cycles or for Mitsuba 3. Floor 2.
#pragma once
#include "interchange/peers/peers.h"

#include <string>
#include <vector>

namespace lfdsim::peers {

// The part of a script that follows the data: the files cycles.py and mitsuba.py of this folder.
extern const char* const cycles_script;
extern const char* const mitsuba_script;

/// Adds the scene's files, picture and command, and its deviations, for cycles or mitsuba, as write_pov() does. options.triangles
/// must be set.
void write_python(Peer, const Display&, const Geometry&, const PeerOptions&, std::vector<std::string> head, PeerScene&);

}  // namespace lfdsim::peers
