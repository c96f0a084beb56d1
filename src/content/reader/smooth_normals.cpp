#include "content/reader/smooth_normals.h"

#include "base/constants.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

namespace lfdsim::reader {
namespace {

// Returns a face's unit normal by Newell's sum, which holds for any polygon; (0, 0, 0) if the face has no area.
aiVector3D face_normal(const aiMesh& mesh, const aiFace& face) {
    aiVector3D sum;
    for (unsigned k = 0; k + 2 < face.mNumIndices; ++k) {
        const aiVector3D& origin = mesh.mVertices[face.mIndices[0]];
        sum += (mesh.mVertices[face.mIndices[k + 1]] - origin) ^ (mesh.mVertices[face.mIndices[k + 2]] - origin);
    }
    return sum.NormalizeSafe();
}

// Returns the number of each vertex's position, and how many positions there are: equal ones have one number, from 0 on.
std::pair<std::vector<unsigned>, std::size_t> positions(const aiMesh& mesh) {
    std::vector<unsigned> order(mesh.mNumVertices), number(mesh.mNumVertices);
    std::iota(order.begin(), order.end(), 0u);
    // Bits have an order even where coordinates are no numbers; adding 0 makes -0 and 0 equal.
    const auto bits = [&](unsigned v) {
        const aiVector3D& p = mesh.mVertices[v];
        return std::array{std::bit_cast<std::uint32_t>(p.x + 0.f), std::bit_cast<std::uint32_t>(p.y + 0.f),
                          std::bit_cast<std::uint32_t>(p.z + 0.f)};
    };
    std::sort(order.begin(), order.end(), [&](unsigned a, unsigned b) { return bits(a) < bits(b); });
    unsigned count = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || bits(order[i]) != bits(order[i - 1])) ++count;
        number[order[i]] = count - 1;
    }
    return {std::move(number), count};
}

// Appends to a list the entries of other vertices. Null: there is none.
template <class T>
void extend(T*& list, unsigned size, const std::vector<unsigned>& copied) {
    if (!list) return;
    auto all = std::make_unique<T[]>(size + copied.size());
    std::copy_n(list, size, all.get());
    for (std::size_t i = 0; i < copied.size(); ++i) all[size + i] = list[copied[i]];
    delete[] list;
    list = all.release();
}

template <class T>
void remove_all(T**& items, unsigned& count) {
    for (unsigned i = 0; i < count; ++i) delete items[i];
    delete[] items;
    items = nullptr;
    count = 0;
}

void smooth(aiMesh& mesh, float least_cosine) {
    // The faces about each position, in their order: those of position p are about[first[p]] to about[first[p + 1] - 1].
    const auto [number, count] = positions(mesh);
    std::vector<std::size_t> first(count + 1);
    const auto each_corner = [&](const auto& visit) {
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k) visit(f, mesh.mFaces[f].mIndices[k]);
    };
    each_corner([&, &number = number](unsigned, unsigned vertex) { ++first[number[vertex] + 1]; });
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<unsigned> about(first.back());
    std::vector<std::size_t> next(first.begin(), first.end() - 1);
    each_corner([&, &number = number](unsigned face, unsigned vertex) { about[next[number[vertex]]++] = face; });

    std::vector<aiVector3D> of_face(mesh.mNumFaces);
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) of_face[f] = face_normal(mesh, mesh.mFaces[f]);

    // A vertex has the normal of its first corner; corners with another one get a copy of it.
    std::vector<aiVector3D> normals(mesh.mNumVertices);
    std::vector<bool> known(mesh.mNumVertices);
    std::vector<unsigned> copied;
    each_corner([&, &number = number](unsigned face, unsigned& vertex) {
        aiVector3D sum;
        const std::size_t end = first[number[vertex] + 1];
        for (std::size_t i = first[number[vertex]]; i < end; ++i)
            if (of_face[about[i]] * of_face[face] >= least_cosine) sum += of_face[about[i]];
        sum.NormalizeSafe();
        if (!known[vertex]) {
            known[vertex] = true;
            normals[vertex] = sum;
        } else if (!(normals[vertex] == sum)) {
            copied.push_back(vertex);
            normals.push_back(sum);
            vertex = unsigned(normals.size() - 1);
        }
    });

    const unsigned size = mesh.mNumVertices;
    extend(mesh.mVertices, size, copied);
    extend(mesh.mTangents, size, copied);
    extend(mesh.mBitangents, size, copied);
    for (auto& coordinates : mesh.mTextureCoords) extend(coordinates, size, copied);
    for (auto& colours : mesh.mColors) extend(colours, size, copied);
    mesh.mNumVertices = unsigned(normals.size());
    mesh.mNormals = std::make_unique<aiVector3D[]>(normals.size()).release();
    std::copy(normals.begin(), normals.end(), mesh.mNormals);
    remove_all(mesh.mBones, mesh.mNumBones);
    remove_all(mesh.mAnimMeshes, mesh.mNumAnimMeshes);
}

}  // namespace

void smooth_normals(aiScene& scene, double crease_deg) {
    for (unsigned m = 0; m < scene.mNumMeshes; ++m)
        if (aiMesh& mesh = *scene.mMeshes[m]; mesh.HasPositions() && mesh.HasFaces() && !mesh.HasNormals())
            smooth(mesh, float(std::cos(crease_deg * pi / 180)));
}

}  // namespace lfdsim::reader
