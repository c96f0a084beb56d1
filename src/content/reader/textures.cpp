#include "content/reader/textures.h"

#include "content/reader/limits/limits.h"
#include "image/formats/upright.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

// One well-maintained decoder for the formats that models use; it runs in this confined process only.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_MAX_DIMENSIONS 16384
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace lfdsim::reader {
namespace {

// Returns stb's reason why a picture was not decoded. If it gets no memory it says so by one word, or nothing.
std::string failure() {
    const char* const reason = std::exchange(stbi__g_failure_reason, nullptr);
    if (!reason) return "it is damaged, or takes more memory than there is";
    return reason == std::string_view("outofmem") ? "it takes more memory than there is" : reason;
}

// Copies stb's texels and frees them.
Texture adopt(stbi_uc* pixels, int width, int height) {
    Texture t{width, height, {}};
    t.rgba.assign(pixels, pixels + std::size_t(width) * height * 4);
    stbi_image_free(pixels);
    return t;
}

// Decodes an embedded texture: Assimp keeps either a compressed file (height 0, width its bytes) or BGRA texels.
bool decode(const aiTexture& embedded, Texture& out) {
    if (embedded.mHeight == 0) {
        int width, height, channels;
        stbi_uc* pixels = stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(embedded.pcData), int(embedded.mWidth), &width,
                                                &height, &channels, 4);
        if (pixels) out = adopt(pixels, width, height);
        return pixels;
    }
    if (embedded.mWidth == 0 || embedded.mWidth > STBI_MAX_DIMENSIONS || embedded.mHeight > STBI_MAX_DIMENSIONS) return false;
    out = {std::int32_t(embedded.mWidth), std::int32_t(embedded.mHeight), {}};
    const std::size_t texels = std::size_t(embedded.mWidth) * embedded.mHeight;
    out.rgba.reserve(texels * 4);
    for (std::size_t i = 0; i < texels; ++i) {
        const aiTexel& t = embedded.pcData[i];
        out.rgba.insert(out.rgba.end(), {t.r, t.g, t.b, t.a});
    }
    return true;
}

// Returns why the picture in these bytes was not decoded: its format is not read, or stb's reason.
std::string reason(std::string_view bytes) {
    constexpr std::pair<std::string_view, const char*> others[] = {{"WEBP", "WebP (in glTF by EXT_texture_webp)"},
                                                                   {"KTX 2", "KTX2 (in glTF by KHR_texture_basisu)"},
                                                                   {"ftypavif", "AVIF (in glTF by EXT_texture_avif)"},
                                                                   {"DDS ", "DDS (in glTF by MSFT_texture_dds)"}};
    for (const auto& [mark, name] : others)
        if (bytes.substr(0, 16).find(mark) != std::string_view::npos) return std::string("it is ") + name + ", which is not read";
    return failure();
}

bool decode(const std::filesystem::path& file, Texture& out) {
    int width, height, channels;
    allow_for(file);
    stbi_uc* pixels = stbi_load(file.c_str(), &width, &height, &channels, 4);
    if (pixels) out = adopt(pixels, width, height);
    return pixels;
}

// Returns a picture as viewers show it; `file` is the one that it was decoded from.
Texture upright(Texture stored, const std::filesystem::path& file) {
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), std::fclose);
    const int orientation = stream ? read_orientation(stream.get()) : 1;
    if (orientation == 1) return stored;
    const Upright places(orientation, stored.width, stored.height);
    constexpr std::size_t texel = 4;
    Texture shown{std::int32_t(places.columns), std::int32_t(places.rows), std::vector<std::uint8_t>(stored.rgba.size())};
    const std::uint8_t* from = stored.rgba.data();
    for (std::int64_t r = 0; r < stored.height; ++r)
        for (std::int64_t i = 0; i < stored.width; ++i, from += texel)
            std::copy_n(from, texel, &shown.rgba[texel * std::size_t(places.row(r) + i * places.pixel_step)]);
    return shown;
}

}  // namespace

Texture read_texture(const std::filesystem::path& file) {
    Texture texture;
    if (!decode(file, texture)) throw std::runtime_error(failure());
    return upright(std::move(texture), file);
}

bool has_alpha(const Texture& t) {
    for (std::size_t i = 3; i < t.rgba.size(); i += 4)
        if (t.rgba[i] != 255) return true;
    return false;
}

int Textures::index(const std::string& name) {
    const auto [entry, fresh] = known_.try_emplace(name, -1);
    if (fresh) entry->second = load(name);
    return entry->second;
}

void Textures::leave_out(const std::string& name, const std::string& why) {
    const std::string which = name.starts_with('*') ? "embedded texture " + name.substr(1) : "texture \"" + name + '"';
    const std::string note = which + " left out, shown grey: " + why;
    if (std::find(left_out_.begin(), left_out_.end(), note) == left_out_.end()) left_out_.push_back(note);
}

std::vector<std::string> Textures::notes() const {
    constexpr std::size_t most = 5;
    if (left_out_.size() <= most + 1) return left_out_;
    std::vector<std::string> first(left_out_.begin(), left_out_.begin() + most);
    first.push_back(std::to_string(left_out_.size() - most) + " more textures left out, shown grey");
    return first;
}

int Textures::load(const std::string& name) {
    Texture decoded;
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(name.c_str())) {
        if (!decode(*embedded, decoded)) {
            const std::size_t size = embedded->mHeight == 0 ? embedded->mWidth : 0;
            leave_out(name, reason({reinterpret_cast<const char*>(embedded->pcData), size}));
            return -1;
        }
    } else if (const auto file = folder_.find(name); !file) {
        leave_out(name, "not found in the model's folder");
        return -1;
    } else if (!decode(*file, decoded)) {
        std::string start(16, '\0');
        std::ifstream(*file, std::ios::binary).read(start.data(), std::streamsize(start.size()));
        leave_out(name, reason(start));
        return -1;
    } else {
        files.push_back(file->string());
    }
    textures.push_back(std::move(decoded));
    return int(textures.size()) - 1;
}

}  // namespace lfdsim::reader
