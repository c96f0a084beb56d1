// A display as a scene for another renderer, for an independent check of lfdsim's pictures. Floor 2.
//
// The scene has the same camera and pixel centres, nearest panel pixels and linear light. What the other program cannot express is
// either refused or listed as a deviation, also in the scene's comments.
#pragma once
#include "display/display.h"
#include "geometry/geometry.h"
#include "image/texels.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lfdsim {

/// The other renderers: POV-Ray, Blender's Cycles, Mitsuba 3.
enum class Peer { pov, cycles, mitsuba };
/// The normals of a lens's triangles: that of each plane, or those of the true surface, interpolated.
enum class MeshNormals { flat, smooth };

/// How a scene is written.
struct PeerOptions {
    std::optional<std::int64_t> triangles;  // of a lens; absent: true surfaces for pov, default_triangles for the others
    MeshNormals normals = MeshNormals::flat;
    std::optional<int> channel;  // 0, 1, 2: a scene of that channel's light alone; absent: of all three
};

/// The number of triangles of a lens in the 2019 paper.
inline constexpr std::int64_t default_triangles = 3386;
/// The most triangles of a lens in a scene of POV-Ray, which holds them as text.
inline constexpr std::int64_t most_pov_triangles = 1'000'000;

/// A file of a scene.
struct PeerFile {
    std::string name, bytes;
};

/// A display as a scene.
struct PeerScene {
    std::vector<PeerFile> files;  // the scene first
    std::string panel_file;       // the panel image's name in the scene: .png, 16-bit codes linear in light, or .exr
    Display shown;                // the display that the scene shows: the given one with its deviations and panel_file's encoding
    std::string command;          // shell words that render it in its folder, to `picture`
    std::string picture;
    std::vector<std::string> deviations;
};

/// Returns the program's name.
std::string_view name_of(Peer);

/// Returns everything in a display that cannot be expressed for that program, each with the key and the remedy.
std::vector<Problem> not_expressed(Peer, const Display&, const Geometry&, const PeerOptions&);

/// Returns the display as a scene, except for the panel image. Throws InputError with the problems of not_expressed().
PeerScene peer_scene(Peer, const Display&, const Geometry&, const PeerOptions&);

/// Returns the panel's light as a scene of such a channel has it, the others being black; of no channel it is unchanged.
Texels light_of_channel(Texels, std::optional<int> channel);

/// Returns a further deviation of a scene, if its panel file cannot hold this light.
std::optional<std::string> panel_deviation(const PeerScene&, const Texels&);

}  // namespace lfdsim
