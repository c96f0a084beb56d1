#include "content/reader/gltf/gltf_draco.h"

#include <draco/compression/decode.h>

#include <stdexcept>

namespace lfdsim::reader {

DracoMesh::DracoMesh(std::string_view bytes) {
    draco::DecoderBuffer buffer;
    buffer.Init(bytes.data(), bytes.size());
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    if (!mesh.ok()) throw std::runtime_error("its data by KHR_draco_mesh_compression are damaged");
    mesh_ = std::move(mesh).value();
}

DracoMesh::~DracoMesh() = default;

AccessorValues DracoMesh::numbers(std::uint32_t id, const Item& accessor) const {
    const draco::PointAttribute* const attribute = mesh_->GetAttributeByUniqueId(id);
    if (!attribute) accessor.fail("is not among its data by KHR_draco_mesh_compression");
    const auto width = std::size_t(attribute->num_components()), count = std::size_t(mesh_->num_points());
    AccessorValues out{width, count, std::vector<double>(width * count)};
    for (std::uint32_t i = 0; i < mesh_->num_points(); ++i)
        if (!attribute->ConvertValue(attribute->mapped_index(draco::PointIndex(i)), attribute->num_components(),
                                     &out.all[i * width]))
            accessor.fail("has damaged data by KHR_draco_mesh_compression");
    if (!attribute->normalized()) out.normalize(accessor);
    return out;
}

std::vector<double> DracoMesh::indices() const {
    std::vector<double> all;
    for (draco::FaceIndex f(0); f < mesh_->num_faces(); ++f)
        for (const draco::PointIndex& corner : mesh_->face(f)) all.push_back(double(corner.value()));
    return all;
}

}  // namespace lfdsim::reader
