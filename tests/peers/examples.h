// Displays that are exported in tests, and what is said of them.
#pragma once
#include "files/description/display_file.h"
#include "interchange/peers/peers.h"

#include <string>
#include <vector>

namespace lfdsim {

inline Display desktop(const std::vector<std::string>& overrides = {}) {
    std::vector<std::string> all{"diffuser=none", "render.fresnel=\"none\""};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return read_display(LFDSIM_SOURCE_DIR "/displays/desktop-spherical.toml", all);
}

inline std::string scene_text(Peer peer, const Display& d, const PeerOptions& options = {}) {
    return peer_scene(peer, d, resolve(d), options).files.front().bytes;
}

inline std::vector<std::string> refused_keys(Peer peer, const Display& d, const PeerOptions& options = {}) {
    std::vector<std::string> keys;
    for (const Problem& p : not_expressed(peer, d, resolve(d), options)) keys.push_back(p.where);
    return keys;
}

}  // namespace lfdsim
