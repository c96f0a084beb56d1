// A display as a scene for another renderer, for a second opinion on what lfdsim shows of it. Floor 2.
//
// Same camera, same pixel centres, nearest panel pixels, linear light. What the other program cannot express is either refused or
// named as a deviation, in words that stand in the scene too.
#pragma once
#include "image/texels.h"
#include "model/display.h"
#include "model/geometry.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

enum class Peer { pov, cycles, mitsuba };
enum class MeshNormals { flat, smooth };

struct PeerOptions {
    std::optional<std::int64_t> triangles;  // of a lens; absent: true surfaces for pov, default_triangles for the others
    MeshNormals normals = MeshNormals::flat;
};

/// The lens that the 2019 paper tells of has so many.
inline constexpr std::int64_t default_triangles = 3386;
/// A scene of POV-Ray holds its triangles as text.
inline constexpr std::int64_t most_pov_triangles = 1'000'000;

struct PeerFile {
    std::string name, bytes;
};

struct PeerScene {
    std::vector<PeerFile> files;  // the scene first
    std::string panel_file;       // what the scene calls the panel image: .png, 16-bit codes linear in light, or .exr
    Display shown;                // the display that the scene shows: the given one less what deviates, as panel_file encodes it
    std::string command;          // shell words that render it in its folder, to `picture`
    std::string picture;
    std::vector<std::string> deviations;
};

std::string_view name_of(Peer);  // of the program

/// All that keeps a display from being expressed for that program, each with the key and the remedy. Empty: it can be.
std::vector<Problem> not_expressed(Peer, const Display&, const Geometry&, const PeerOptions&);

/// Throws InputError with the problems of not_expressed().
PeerScene peer_scene(Peer, const Display&, const Geometry&, const PeerOptions&);

/// What a scene adds to its deviations when its panel file cannot hold this light.
std::optional<std::string> panel_deviation(const PeerScene&, const Texels&);

}  // namespace lfdsim
