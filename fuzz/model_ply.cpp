// Any bytes given as a PLY file: refused in words, or a scene whose faces name vertices that are there. Anything else is a crash.
#include "content/reader/ply/ply_loader.h"
#include "imported_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim::reader;
    return lfdsim::fuzz_scene([&](aiScene& scene, NotShown& not_shown) {
        read_ply({reinterpret_cast<const char*>(data), size}, scene, not_shown);
    });
}
