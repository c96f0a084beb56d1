#include "content/reader/axes.h"

#include <initializer_list>

namespace lfdsim::reader {
namespace {

bool any_of(const std::string& format, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        if (format.starts_with(name)) return true;
    }
    return false;
}

}  // namespace

AxesTurn turn(const aiScene& scene, const std::string& format, const std::string& up) {
    // Assimp rotates the formats of the first list to +y up itself; those of the second are +z up by specification or by their
    // program. All others are +y up: by specification (glTF, X3D, Collada after Assimp's rotation) or by custom (OBJ, PLY, OFF).
    // A file's "UpAxis", and before it `up`, take precedence.
    const bool turned =
        any_of(format, {"3D Studio", "Discreet 3DS", "ASE", "Industry Foundation", "Quake", "Doom 3", "Inter-Quake", "Unreal"});
    bool z_up = any_of(format, {"Stereolithography", "Blender", "Additive", "3mf", "Drawing Interchange", "TrueSpace", "Valve SMD",
                                "3D GameStudio Heightmap"});
    if (int axis = 1; scene.mMetaData && scene.mMetaData->Get("UpAxis", axis)) z_up = axis == 2;
    if (!up.empty()) z_up = up == "z";
    if (turned) return AxesTurn(up == "y" ? AxesTurn::y_to_z : AxesTurn::none);
    return AxesTurn(z_up ? AxesTurn::z_to_y : AxesTurn::none);
}

}  // namespace lfdsim::reader
