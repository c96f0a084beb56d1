#include "content/reader/gltf/gltf_materials.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace lfdsim::reader {
namespace {

constexpr aiTextureType base = aiTextureType_BASE_COLOR;

int mode_of(const Item& wrap) {
    switch (wrap.whole(10497)) {
        case 33071:
            return aiTextureMapMode_Clamp;
        case 33648:
            return aiTextureMapMode_Mirror;
        default:
            return aiTextureMapMode_Wrap;
    }
}

// Returns a picture as compressed in its file: height 0, width its bytes.
std::unique_ptr<aiTexture> embedded_picture(std::string_view bytes) {
    auto texture = std::make_unique<aiTexture>();
    texture->mHeight = 0;
    texture->mWidth = unsigned(std::min<std::size_t>(bytes.size(), INT32_MAX));
    texture->pcData = new aiTexel[texture->mWidth / sizeof(aiTexel) + 1];
    std::memcpy(texture->pcData, bytes.data(), texture->mWidth);
    return texture;
}

}  // namespace

std::array<double, 2> UvTransform::operator()(double u, double v) const {
    // R = (c, s; -s, c)
    const double x = scale[0] * u, y = scale[1] * v, c = std::cos(rotation), s = std::sin(rotation);
    return {offset[0] + c * x + s * y, offset[1] - s * x + c * y};
}

unsigned GltfMaterials::index(const Item& number, NotShown& not_shown) {
    const auto from = file_.named(number, "materials");
    const auto [entry, fresh] = known_.try_emplace(from ? number.whole(0) : SIZE_MAX, unsigned(all.size()));
    if (!fresh) return entry->second;
    all.push_back(std::make_unique<aiMaterial>());
    uses_.emplace_back();
    if (!from) return entry->second;

    aiMaterial& to = *all.back();
    const Item extensions = from->at("extensions"), metal = from->at("pbrMetallicRoughness"),
               gloss = extensions.at("KHR_materials_pbrSpecularGlossiness");
    const auto factor = (gloss.is_there() ? gloss.at("diffuseFactor") : metal.at("baseColorFactor")).numbers<4>({1, 1, 1, 1});
    const aiColor4D colour{float(factor[0]), float(factor[1]), float(factor[2]), 1};
    to.AddProperty(&colour, 1, AI_MATKEY_BASE_COLOR);
    add_texture(gloss.is_there() ? gloss.at("diffuseTexture") : metal.at("baseColorTexture"), to);

    const std::string mode = from->at("alphaMode").text();
    const aiString alpha(mode.empty() ? "OPAQUE" : mode);
    to.AddProperty(&alpha, AI_MATKEY_GLTF_ALPHAMODE);
    const float opacity = float(1 - extensions.at("KHR_materials_transmission").at("transmissionFactor").number(0));
    to.AddProperty(&opacity, 1, AI_MATKEY_OPACITY);
    if (from->has("normalTexture")) not_shown.add("normal and bump maps");
    const auto light = from->at("emissiveFactor").numbers<3>({0, 0, 0});
    const aiColor3D emission{float(light[0]), float(light[1]), float(light[2])};
    to.AddProperty(&emission, 1, AI_MATKEY_COLOR_EMISSIVE);
    if (extensions.has("KHR_materials_unlit")) {
        const int unlit = aiShadingMode_Unlit;
        to.AddProperty(&unlit, 1, AI_MATKEY_SHADING_MODEL);
    }
    return entry->second;
}

// Adds a material's texture. A picture in a format of the specification comes before those of extensions, which are not read
// (textures.cpp names their format in a note).
void GltfMaterials::add_texture(const Item& use, aiMaterial& to) {
    const auto texture = file_.named(use.at("index"), "textures");
    if (!texture) return;
    const Item transform = use.at("extensions").at("KHR_texture_transform");
    TextureUse& how = uses_.back();
    how.channel = "TEXCOORD_" + std::to_string(transform.at("texCoord").whole(use.at("texCoord").whole(0)));
    how.transform = {transform.at("offset").numbers<2>({0, 0}), transform.at("scale").numbers<2>({1, 1}),
                     transform.at("rotation").number(0)};
    std::string name = name_of_image(texture->at("source"));
    for (const char* extension : {"EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"})
        if (name.empty()) name = name_of_image(texture->at("extensions").at(extension).at("source"));
    const aiString text(name);
    to.AddProperty(&text, AI_MATKEY_TEXTURE(base, 0));
    if (const auto sampler = file_.named(texture->at("sampler"), "samplers")) {
        const int modes[2] = {mode_of(sampler->at("wrapS")), mode_of(sampler->at("wrapT"))};
        to.AddProperty(&modes[0], 1, AI_MATKEY_MAPPINGMODE_U(base, 0));
        to.AddProperty(&modes[1], 1, AI_MATKEY_MAPPINGMODE_V(base, 0));
    }
}

// Returns an image's name: "*0" and so on of embedded ones, "" of none.
std::string GltfMaterials::name_of_image(const Item& number) {
    const auto image = file_.named(number, "images");
    if (!image) return {};
    const auto [entry, fresh] = images_.try_emplace(number.whole(0));
    if (!fresh) return entry->second;
    const std::string uri = image->at("uri").text();
    std::optional<std::string> bytes = GltfFile::data_of(uri);
    if (const auto view = file_.named(image->at("bufferView"), "bufferViews")) bytes = file_.view(*view);
    if (bytes) {
        entry->second = "*" + std::to_string(embedded.size());
        embedded.push_back(embedded_picture(*bytes));
    } else {
        entry->second = GltfFile::file_name(uri);
    }
    return entry->second;
}

}  // namespace lfdsim::reader
