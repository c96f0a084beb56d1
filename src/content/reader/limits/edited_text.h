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

/// Writes the keywords of a text STL file in small letters, the only ones that Assimp knows, and leaves names and binary files
/// alone. This function and the next two return whether they changed the text.
bool lower_keywords(std::string& text);

/// Inverts bit 15 of the facets of a binary STL file with Materialise's "COLOR=" in its header: set, it means the header's colour,
/// and clear, one of the facet's own, but Assimp takes it the other way round, as VisCAM does. If all attributes are 0, no facet is
/// coloured, and the file is right as it is.
bool invert_materialise_bits(std::string& bytes);

/// Gives each file of "mtllib a.mtl b.mtl" a line of its own, without blanks behind it: Assimp takes the line for one name.
bool separate_libraries(std::string& text);

/// Writes "0.5" for ".5" in the positions, normals and texture coordinates of an OBJ file: Assimp does not count words that begin
/// with a point as numbers.
bool lead_with_digits(std::string& text);

/// Notes what else of an OBJ file Assimp leaves out: free-form curves and surfaces.
void note_free_forms(std::string_view text, NotShown&);

/// Notes colours of faces, which Assimp leaves out in OFF and gives to vertices, one after another, in X3D. `ending`: ".off" or
/// ".x3d".
void note_face_colours(std::string_view text, std::string_view ending, NotShown&);

/// The transformation of texture coordinates by a .mtl file: offset + scale (u, v).
struct Tiling {
    std::array<double, 2> offset{0, 0}, scale{1, 1};
};

/// Returns a .mtl file whose colours of one number have three, without the options of its colour textures. Those that move or scale
/// a texture go to `tilings`, by the materials' names; others are not shown. Throws std::runtime_error, which names the file by
/// `name`, for colours that cannot be.
std::string readable_materials(std::string_view text, const std::string& name, std::map<std::string, Tiling>& tilings, NotShown&);

}  // namespace lfdsim::reader
