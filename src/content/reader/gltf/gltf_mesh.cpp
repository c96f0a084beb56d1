#include "content/reader/gltf/gltf_mesh.h"

namespace lfdsim::reader {
namespace {

// Returns a normal transformed by a linear map: by the inverse transpose times a positive number, from the cofactors, which exist
// for any map.
Place turned_normal(const Matrix& m, const Place& n) {
    const Place a(m.a1, m.b1, m.c1), b(m.a2, m.b2, m.c2), c(m.a3, m.b3, m.c3);
    const Place turned = (b ^ c) * n.x + (c ^ a) * n.y + (a ^ b) * n.z;
    const double size = turned.Length(), sign = (a ^ b) * c < 0 ? -1 : 1;
    return size > 0 ? turned * (sign / size) : Place();
}

// Returns whether a map mirrors: triangles are then turned over, or they would be seen from behind.
bool mirrors(const Matrix& m) { return (Place(m.a1, m.b1, m.c1) ^ Place(m.a2, m.b2, m.c2)) * Place(m.a3, m.b3, m.c3) < 0; }

Matrix weighted_sum(const Matrix& sum, double weight, const Matrix& term) {
    Matrix out;
    for (unsigned row = 0; row < 4; ++row)
        for (unsigned column = 0; column < 4; ++column) out[row][column] = sum[row][column] + weight * term[row][column];
    return out;
}

const Matrix zero(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);

}  // namespace

/// A primitive of a mesh, decompressed if it is compressed.
struct GltfMeshes::Primitive {
    Item item;
    Item packed_ids;  // numbers of its attributes in `packed`
    std::unique_ptr<DracoMesh> packed;
};

/// What all instances of a primitive have in common.
struct GltfMeshes::Vertices {
    AccessorValues places;
    std::optional<AccessorValues> normals, uvs, colours;
    UvTransform uv_transform;
    std::vector<std::uint32_t> triangles;
    unsigned material;
};

void GltfMeshes::add(const Item& mesh, const Posing& posing) {
    const Item primitives = mesh.at("primitives");
    for (std::size_t i = 0; i < primitives.size(); ++i) add_primitive(primitives[i], posing);
}

void GltfMeshes::add_primitive(const Item& item, const Posing& posing) {
    std::size_t mode = item.at("mode").whole(4);
    if (mode > 6) item.at("mode").fail("is not a kind of primitive");
    const auto position = file_.named(item.at("attributes").at("POSITION"), "accessors");
    if (!position) return;  // as the specification allows
    if (mode < 4) {
        points_ += position->at("count").whole(0);
        not_shown_.add("points and lines");
        return;
    }
    const Item draco = item.at("extensions").at("KHR_draco_mesh_compression");
    Primitive primitive{item, draco.at("attributes"), nullptr};
    if (const auto view = file_.named(draco.at("bufferView"), "bufferViews")) {
        primitive.packed = std::make_unique<DracoMesh>(file_.view(*view));
        mode = 4;
    }
    Vertices v;
    v.places = *posed(primitive, "POSITION", posing, 3, 3);
    v.material = materials_.index(item.at("material"), not_shown_);
    const TextureUse& texture = materials_.texture_use(v.material);
    v.uv_transform = texture.transform;
    v.normals = posed(primitive, "NORMAL", posing, 3, 3);
    if (!texture.channel.empty()) v.uvs = posed(primitive, texture.channel.c_str(), posing, 2, 2);
    v.colours = posed(primitive, "COLOR_0", posing, 3, 4);
    if (item.at("attributes").has("COLOR_1")) not_shown_.add("colours of vertices beyond COLOR_0");
    for (const auto* other : {&v.normals, &v.uvs, &v.colours})
        if (*other && (*other)->count != v.places.count) item.at("attributes").fail("have different counts");
    v.triangles = triangles(primitive, mode, v.places.count);
    if (v.triangles.empty()) return;
    if (!posing.joints.empty() && item.at("attributes").has("JOINTS_0"))
        return place(v, joint_matrices(primitive, posing, v.places.count));
    for (const Matrix& instance : posing.instances) place(v, {instance});
}

std::optional<AccessorValues> GltfMeshes::numbers(const Primitive& primitive, const std::string& attribute) {
    const auto accessor = file_.named(primitive.item.at("attributes").at(attribute.c_str()), "accessors");
    if (!accessor) return {};
    const Item id = primitive.packed_ids.at(attribute.c_str());
    return primitive.packed && id.is_there() ? primitive.packed->numbers(std::uint32_t(id.whole(0)), *accessor)
                                             : file_.numbers(*accessor);
}

// Returns an attribute with the displacements of morph targets times their weights. `least`, `most`: the numbers that an element
// of it may have.
std::optional<AccessorValues> GltfMeshes::posed(const Primitive& primitive, const char* attribute, const Posing& posing,
                                                std::size_t least, std::size_t most) {
    std::optional<AccessorValues> all = numbers(primitive, attribute);
    if (!all) return {};
    if (all->width < least || all->width > most)
        primitive.item.at("attributes").at(attribute).fail("names an accessor of the wrong type");
    const Item targets = primitive.item.at("targets");
    for (std::size_t t = 0; t < std::min(targets.size(), posing.morph_weights.size()); ++t) {
        const double weight = posing.morph_weights[t];
        const auto target = weight == 0 ? std::nullopt : file_.named(targets[t].at(attribute), "accessors");
        if (!target) continue;
        const AccessorValues moves = file_.numbers(*target);
        if (moves.width != all->width || moves.count != all->count)
            target->fail("does not have the size of the list that it displaces");
        for (std::size_t i = 0; i < moves.all.size(); ++i) all->all[i] += weight * moves.all[i];
    }
    return all;
}

// Returns three vertex indices for each triangle of a list (mode 4), a strip (5) or a fan (6).
std::vector<std::uint32_t> GltfMeshes::triangles(const Primitive& primitive, std::size_t mode, std::size_t vertices) {
    std::vector<std::uint32_t> order;
    const auto accessor = file_.named(primitive.item.at("indices"), "accessors");
    if (primitive.packed || accessor) {
        if (accessor && accessor->at("type").text() != "SCALAR") accessor->fail("has the wrong type for indices");
        if (accessor) file_.check_index_type(*accessor);
        const std::vector<double> all = primitive.packed ? primitive.packed->indices() : file_.numbers(*accessor).all;
        for (const double i : all) {
            if (!(i >= 0 && i < double(vertices)))
                primitive.item.fail("has indices of vertices that do not exist; the file is damaged, export it again");
            order.push_back(std::uint32_t(i));
        }
    } else {
        order.resize(vertices);
        for (std::size_t i = 0; i < vertices; ++i) order[i] = std::uint32_t(i);
    }
    if (mode == 4 ? order.size() % 3 != 0 : order.size() < 3) not_shown_.add("corners that form no triangle");
    if (mode == 4) {
        order.resize(order.size() / 3 * 3);
        return order;
    }
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i + 2 < order.size(); ++i) {  // a strip's every other triangle is turned over
        const std::size_t first = mode == 6 ? 0 : i, second = mode == 5 ? i + 1 + i % 2 : i + 1,
                          third = mode == 5 ? i + 2 - i % 2 : i + 2;
        list.insert(list.end(), {order[first], order[second], order[third]});
    }
    return list;
}

// Returns a matrix for each vertex (glTF 2.0, 3.7.3): the mean of its joints' matrices by their weights; the node's transform
// does not count. Vertices without weights follow the node.
std::vector<Matrix> GltfMeshes::joint_matrices(const Primitive& primitive, const Posing& posing, std::size_t vertices) {
    std::vector<Matrix> sums(vertices, zero);
    std::vector<double> totals(vertices);
    for (std::size_t set = 0;; ++set) {
        const std::string joint_name = "JOINTS_" + std::to_string(set);
        const auto joint_list = numbers(primitive, joint_name), weight_list = numbers(primitive, "WEIGHTS_" + std::to_string(set));
        if (!joint_list || !weight_list) break;
        const Item joint_number = primitive.item.at("attributes").at(joint_name.c_str());
        const AccessorValues &joints = *joint_list, &weights = *weight_list;
        if (joints.width != 4 || weights.width != 4 || joints.count != vertices || weights.count != vertices)
            joint_number.fail("does not have four joints and weights for each vertex");
        for (std::size_t i = 0; i < joints.all.size(); ++i) {
            const double joint = joints.all[i], weight = weights.all[i];
            if (weight == 0) continue;
            if (!(joint >= 0 && joint < double(posing.joints.size())))
                joint_number.fail("refers to joints that are not in the skin");
            sums[i / 4] = weighted_sum(sums[i / 4], weight, posing.joints[std::size_t(joint)]);
            totals[i / 4] += weight;
        }
    }
    for (std::size_t v = 0; v < vertices; ++v)
        sums[v] = totals[v] > 0 ? weighted_sum(zero, 1 / totals[v], sums[v]) : posing.instances.front();
    return sums;
}

// Adds the triangles, moved into the scene, as a piece. `at`: one matrix for all vertices, or one for each.
void GltfMeshes::place(const Vertices& v, const std::vector<Matrix>& at) {
    const std::size_t count = v.places.count;
    if ((vertices_ += count) >= std::size_t(1) << 32) throw std::runtime_error("has more than 2^32 vertices");
    const auto matrix = [&](std::size_t i) -> const Matrix& { return at[at.size() == 1 ? 0 : i]; };
    Piece piece{std::make_unique<aiMesh>(), {}};
    aiMesh& mesh = *piece.mesh;
    mesh.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    mesh.mMaterialIndex = v.material;
    mesh.mNumVertices = unsigned(count);
    piece.places.reserve(count);
    if (v.normals) mesh.mNormals = new aiVector3D[count];
    if (v.uvs) mesh.mTextureCoords[0] = new aiVector3D[count];
    if (v.uvs) mesh.mNumUVComponents[0] = 2;
    if (v.colours) mesh.mColors[0] = new aiColor4D[count];
    for (std::size_t i = 0; i < count; ++i) {
        const double* const p = v.places[i];
        piece.places.push_back(matrix(i) * Place(p[0], p[1], p[2]));
        if (v.normals)
            mesh.mNormals[i] =
                to_float(turned_normal(matrix(i), Place((*v.normals)[i][0], (*v.normals)[i][1], (*v.normals)[i][2])));
        if (v.uvs) {
            const auto uv = v.uv_transform((*v.uvs)[i][0], (*v.uvs)[i][1]);
            mesh.mTextureCoords[0][i] = {float(uv[0]), float(1 - uv[1]), 0};
        }
        if (v.colours) {
            const double* const c = (*v.colours)[i];
            mesh.mColors[0][i] = {float(c[0]), float(c[1]), float(c[2]), v.colours->width == 4 ? float(c[3]) : 1.f};
        }
    }
    mesh.mNumFaces = unsigned(v.triangles.size() / 3);
    mesh.mFaces = new aiFace[mesh.mNumFaces];
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const std::uint32_t* const corner = &v.triangles[3 * std::size_t(f)];
        const bool turn_over = mirrors(matrix(corner[0]));
        mesh.mFaces[f].mNumIndices = 3;
        mesh.mFaces[f].mIndices = new unsigned[3]{corner[0], corner[turn_over ? 2 : 1], corner[turn_over ? 1 : 2]};
    }
    pieces.push_back(std::move(piece));
}

}  // namespace lfdsim::reader
