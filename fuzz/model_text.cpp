// Any bytes given as a text that is edited before Assimp reads it, or as a .mtl file: anything but an answer or a refusal is a
// crash.
#include "content/reader/limits/edited_text.h"

#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace lfdsim::reader;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    for (const char* ending : {".obj", ".off", ".stl"}) readable_positions(text, ending);
    std::map<std::string, Tiling> tilings;
    NotShown not_shown;
    note_free_forms(text, not_shown);
    try {
        readable_materials(text, "m.mtl", tilings, not_shown);
    } catch (const std::runtime_error&) {
    }
    return 0;
}
