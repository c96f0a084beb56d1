// Large memory with fewer page faults and TLB misses. Internal to src/image. Floor 0.
#pragma once
#include <cstddef>

namespace lfdsim::detail {

inline constexpr std::size_t huge_page = std::size_t(1) << 21;  // x86-64

/// Requests huge pages where whole ones lie in these bytes; to be called before they are touched. Failure has no consequences.
void want_huge_pages(void* memory, std::size_t bytes);

}  // namespace lfdsim::detail
