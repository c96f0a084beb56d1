#include "image/formats/huge_pages.h"

#include <sys/mman.h>
#include <cstdint>

namespace lfdsim::detail {

void want_huge_pages(void* memory, std::size_t bytes) {
    const auto begin = reinterpret_cast<std::uintptr_t>(memory), first = (begin + huge_page - 1) / huge_page * huge_page,
               end = (begin + bytes) / huge_page * huge_page;
    if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
}

}  // namespace lfdsim::detail
