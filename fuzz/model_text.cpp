// Any bytes given as a text that is edited before Assimp reads it, or as a .mtl file: anything but an answer is a crash.
#include "content/reader/limits/edited_text.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim::reader;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const char* ending : {".obj", ".off", ".stl"}) readable_positions(text, ending);
    std::map<std::string, Tiling> tilings;
    NotShown not_shown;
    without_texture_options(text, tilings, not_shown);
    return 0;
}
