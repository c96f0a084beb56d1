#include "image/texels.h"

#include "image/formats/encoder.h"
#include "image/formats/encoding.h"
#include "image/formats/huge_pages.h"

#include <sys/mman.h>
#include <tbb/parallel_for.h>
#include <new>

namespace lfdsim {
namespace {

using detail::huge_page;
constexpr std::size_t texel_bytes = 4 * sizeof(float);

/// Returns anonymous (zeroed) memory that begins on a huge page: maps one huge page more than needed and unmaps the ends.
void* map_aligned(std::size_t bytes) {
    void* const whole = mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (whole == MAP_FAILED) throw std::bad_alloc();
    const std::size_t head = (huge_page - reinterpret_cast<std::uintptr_t>(whole) % huge_page) % huge_page;
    char* const start = static_cast<char*>(whole) + head;
    if (head > 0) munmap(whole, head);
    if (head < huge_page) munmap(start + bytes, huge_page - head);
    return start;
}

/// Copies an image with each value converted, rows on all threads: most of the time goes into the first touch of the memory.
template <class Convert>
Texels converted(const Image& image, const Convert& convert) {
    Texels texels(image.width, image.height);
    tbb::parallel_for(0, image.height, [&](int row) {
        const float* from = image.at(0, row);
        float* to = texels.row(row);
        for (int column = 0; column < image.width; ++column, from += 3, to += 4)
            for (int c = 0; c < 3; ++c) to[c] = convert(from[c]);
    });
    return texels;
}

}  // namespace

void Texels::Unmap::operator()(float* texels) const { munmap(texels, bytes); }

Texels::Texels(std::int64_t columns, std::int64_t rows) : columns_(columns), rows_(rows) {
    constexpr std::int64_t limit = std::int64_t(1) << 31;
    if (columns < 1 || rows < 1 || columns >= limit || rows >= limit || columns * rows >= limit) throw std::bad_alloc();
    const std::size_t bytes = (std::size_t(columns * rows) * texel_bytes + huge_page - 1) / huge_page * huge_page;
    data_ = {static_cast<float*>(map_aligned(bytes)), Unmap{bytes}};
    detail::want_huge_pages(data_.get(), bytes);
}

Texels make_texels(const Image& image) {
    return converted(image, [](float light) { return light; });
}

Texels shown_texels(const Image& image, Encoding encoding) {
    const Encoder8& code = Encoder8::of(encoding);
    const std::vector<float>& light = decode_table(encoding, 8);
    return converted(image, [&](float value) { return light[code(value)]; });
}

}  // namespace lfdsim
