// Any bytes given as a glTF file: refused in words, or a scene whose faces name vertices that are there. Anything else is a crash.
#include "content/reader/gltf/gltf_loader.h"
#include "imported_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim::reader;
    const auto open = [](const std::string& name) {
        return name == "t.bin" ? std::optional(std::string(300, '\x3f')) : std::nullopt;
    };
    return lfdsim::fuzz_scene([&](aiScene& scene, NotShown& not_shown) {
        read_gltf({reinterpret_cast<const char*>(data), size}, open, scene, not_shown);
    });
}
