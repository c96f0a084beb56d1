#include "image/texels.h"

#include <sys/mman.h>
#include <new>

namespace lfdsim {
namespace {

constexpr std::size_t huge_page = std::size_t(1) << 21;  // x86-64
constexpr std::size_t texel_bytes = 4 * sizeof(float);

/// Anonymous (zeroed) memory that begins on a huge page: maps one page more than needed and gives the ends back.
void* map_aligned(std::size_t bytes) {
    void* const whole = mmap(nullptr, bytes + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (whole == MAP_FAILED) throw std::bad_alloc();
    const std::size_t head = (huge_page - reinterpret_cast<std::uintptr_t>(whole) % huge_page) % huge_page;
    char* const start = static_cast<char*>(whole) + head;
    if (head > 0) munmap(whole, head);
    if (head < huge_page) munmap(start + bytes, huge_page - head);
    return start;
}

}  // namespace

void Texels::Unmap::operator()(float* texels) const { munmap(texels, bytes); }

Texels::Texels(std::int64_t columns, std::int64_t rows) : columns_(columns), rows_(rows) {
    constexpr std::int64_t limit = std::int64_t(1) << 31;
    if (columns < 1 || rows < 1 || columns >= limit || rows >= limit || columns * rows >= limit) throw std::bad_alloc();
    const std::size_t bytes = (std::size_t(columns * rows) * texel_bytes + huge_page - 1) / huge_page * huge_page;
    data_ = {static_cast<float*>(map_aligned(bytes)), Unmap{bytes}};
    madvise(data_.get(), bytes, MADV_HUGEPAGE);  // a wish: without it all works, with more TLB misses
}

Texels make_texels(const Image& image) {
    Texels texels(image.width, image.height);
    const float* from = image.rgb.data();
    float* const to = texels.data();
    for (std::size_t i = 0; i < image.rgb.size() / 3; ++i)
        for (std::size_t c = 0; c < 3; ++c) to[4 * i + c] = from[3 * i + c];
    return texels;
}

}  // namespace lfdsim
