// Any bytes given as a PNG picture: refused with an InputError, or a picture. Anything else is a crash.
#include "picture.h"

#include <zlib.h>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    return lfdsim::fuzz_picture(".png", data, size);
}

// Makes the sums of chunks right again after a change, or little would get past them; of every eighth input it leaves them wrong.
extern "C" std::size_t LLVMFuzzerMutate(unsigned char* data, std::size_t size, std::size_t most);
extern "C" std::size_t LLVMFuzzerCustomMutator(unsigned char* data, std::size_t size, std::size_t most, unsigned seed) {
    size = LLVMFuzzerMutate(data, size, most);
    constexpr std::size_t signature = 8, frame = 12;  // of a chunk: length, name, sum
    for (std::size_t at = signature; seed % 8 != 0 && at + frame <= size;) {
        const std::size_t bytes = std::size_t(data[at]) << 24 | data[at + 1] << 16 | data[at + 2] << 8 | data[at + 3];
        if (bytes > size - at - frame) break;
        const auto sum = std::uint32_t(crc32(0, data + at + 4, unsigned(bytes) + 4));
        for (std::size_t k = 0; k < 4; ++k) data[at + 8 + bytes + k] = static_cast<unsigned char>(sum >> (24 - 8 * k));
        at += bytes + frame;
    }
    return size;
}
