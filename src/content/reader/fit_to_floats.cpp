#include "content/reader/fit_to_floats.h"

#include "content/reader/places.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace lfdsim::reader {
namespace {

double largest_of(const Place& p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// The extent of all meshes of a scene and the largest numbers in it.
struct MeshExtent {
    BoxMiddle middle;   // in the scene's coordinates
    BoxMiddle shown;    // of the vertices of faces: others may lie anywhere
    double vertex = 0;  // the largest number of a vertex, in its node's coordinates
    // The largest and the second largest number of nodes' translations: the rounding of a single one moves everything alike.
    double translation = 0, second_translation = 0;
};

// Adds the meshes of a node and of those below it. Throws std::runtime_error for nodes too deep.
void add(const aiScene& scene, const aiNode& node, const aiMatrix4x4t<double>& above, MeshExtent& all, int depth = 0) {
    constexpr int deepest = 1000;
    if (depth > deepest) throw std::runtime_error("has nodes more than 1000 deep");
    const aiMatrix4x4t<double> own(node.mTransformation), here = above * own;
    const double translation = largest_of({own.a4, own.b4, own.c4});
    all.second_translation = std::max(all.second_translation, std::min(all.translation, translation));
    all.translation = std::max(all.translation, translation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *scene.mMeshes[node.mMeshes[i]];
        for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
            const Place p(mesh.mVertices[v]);
            all.middle.add(here * p);
            all.vertex = std::max(all.vertex, largest_of(p));
        }
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                if (const unsigned v = mesh.mFaces[f].mIndices[k]; v < mesh.mNumVertices)  // others are refused later, in words
                    all.shown.add(here * Place(mesh.mVertices[v]));
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c) add(scene, *node.mChildren[c], here, all, depth + 1);
}

std::string details_below(double share) {
    std::ostringstream text;
    text.precision(1);
    text << "details below " << share << " of the model's size, which coordinates so far from the origin do not hold as its format"
         << " is read (move the model to the origin, or save it as glTF or PLY),";
    return text.str();
}

// Multiplies the translations of a node and of those below it.
void scale(aiNode& node, double factor) {
    aiMatrix4x4& m = node.mTransformation;
    for (float* x : {&m.a4, &m.b4, &m.c4}) *x = float(factor * double(*x));
    for (unsigned c = 0; c < node.mNumChildren; ++c) scale(*node.mChildren[c], factor);
}

}  // namespace

int fit_to_floats(aiScene& scene, NotShown& not_shown) {
    MeshExtent extent;
    add(scene, *scene.mRootNode, {}, extent);
    // The largest number stays a float.
    const int exponent = std::min(extent.shown.exponent(), 126 - std::ilogb(std::max({extent.vertex, extent.translation, 1.})));
    const double factor = std::ldexp(1., exponent);
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        for (unsigned v = 0; v < scene.mMeshes[m]->mNumVertices; ++v)
            scene.mMeshes[m]->mVertices[v] = to_float(Place(scene.mMeshes[m]->mVertices[v]) * factor);
    scale(*scene.mRootNode, factor);
    if (const Place offset = extent.middle.offset(); offset != Place()) {
        aiMatrix4x4 back;
        aiMatrix4x4::Translation(to_float(offset * -factor), back);
        scene.mRootNode->mTransformation = back * scene.mRootNode->mTransformation;
        // Half of a float's last bit, as a share of the model's size
        const double share = std::ldexp(std::max(extent.vertex, extent.second_translation), -24) / extent.middle.size();
        if (share > 1e-6) not_shown.add(details_below(share));
    }
    return exponent;
}

}  // namespace lfdsim::reader
