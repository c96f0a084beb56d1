// Any bytes given as an EXR picture: refused with an InputError, or a picture. Anything else is a crash.
#include "image/formats/formats.h"
#include "picture.h"

namespace {

/// Whether the header is refused or asks for no more pixels than are quickly zeroed: a small file may have a frame of 2^25.
bool is_quick(const std::filesystem::path& file) {
    struct Large {};
    try {
        lfdsim::detail::read_exr(lfdsim::detail::InputFile(file), [](std::int64_t columns, std::int64_t rows) {
            if (columns * rows > 1 << 16) throw Large();
            throw lfdsim::InputError("", "");
            return lfdsim::detail::Pixels{};
        });
    } catch (const lfdsim::InputError&) {
    } catch (const Large&) {
        return false;
    }
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    return lfdsim::fuzz_picture(".exr", data, size, is_quick);
}
