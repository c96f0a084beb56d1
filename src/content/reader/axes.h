// Up axes of model formats: they differ, and Assimp rotates some formats but not others.
#pragma once
#include <assimp/scene.h>

#include <string>

namespace lfdsim::reader {

/// A quarter turn about x, or none, from the axes in which Assimp gives a scene to +y up, front towards +z.
class AxesTurn {
  public:
    enum Quarter { none, z_to_y, y_to_z };
    explicit AxesTurn(Quarter quarter) : quarter_(quarter) {}

    aiVector3D operator()(const aiVector3D& v) const {
        switch (quarter_) {
            case z_to_y:
                return {v.x, v.z, -v.y};
            case y_to_z:
                return {v.x, -v.z, v.y};
            default:
                return v;
        }
    }

  private:
    Quarter quarter_;
};

/// Returns the turn for a scene. `format`: the name of Assimp's importer; `up`: "y" or "z", the file's axis that points up, "" by
/// format.
AxesTurn turn(const aiScene& scene, const std::string& format, const std::string& up);

}  // namespace lfdsim::reader
