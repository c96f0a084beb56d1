// Texts of models that Assimp 5.2 would misread, with the same meaning in a form that it reads rightly.
#pragma once
#include "content/reader/limits/not_shown.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace lfdsim::reader {

/// OBJ, OFF and text STL: their positions relative to the middle of their box, where that is so far from the origin that float
/// would round them; none where nothing has to change. `ending`: ".obj" and so on.
std::optional<std::string> nearer_the_origin(std::string_view text, std::string_view ending);

/// What a .mtl file does with texture coordinates before it looks them up: offset + scale (u, v).
struct Tiling {
    std::array<double, 2> offset{0, 0}, scale{1, 1};
};

/// A .mtl file without the options of its colour textures; those that move or scale a texture go to `tilings`, by the materials'
/// names, others are not shown.
std::string without_texture_options(std::string_view text, std::map<std::string, Tiling>& tilings, NotShown&);

}  // namespace lfdsim::reader
