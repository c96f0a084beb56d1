// Texts of models that Assimp 5.2 would misread, rewritten with the same meaning in a form that it reads rightly.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace lfdsim::reader {

/// A text whose positions are multiplied by 2^exponent.
struct ScaledText {
    std::string text;
    int exponent;
};

/// Returns an OBJ, OFF or text STL file with positions relative to the middle of their box, if that is so far from the origin that
/// floats would round them, and scaled, if they are so small that Assimp does not read all their digits; nothing if no change is
/// needed, or if positions are unusual. `ending`: ".obj", ".off" or ".stl".
std::optional<ScaledText> readable_positions(std::string_view text, std::string_view ending);

/// The transformation of texture coordinates by a .mtl file: offset + scale (u, v).
struct Tiling {
    std::array<double, 2> offset{0, 0}, scale{1, 1};
};

/// Returns a .mtl file without the options of its colour textures. Those that move or scale a texture go to `tilings`, by the
/// materials' names; others are not shown.
std::string without_texture_options(std::string_view text, std::map<std::string, Tiling>& tilings, NotShown&);

}  // namespace lfdsim::reader
