// Huge pages for large memory: fewer page faults and TLB misses. Internal to src/image. Floor 0.
#pragma once
#include <cstddef>

namespace lfdsim::detail {

inline constexpr std::size_t huge_page = std::size_t(1) << 21;  // bytes, of x86-64

/// Requests huge pages for those that lie wholly in these bytes. It must be called before they are touched. Failure is ignored.
void want_huge_pages(void* memory, std::size_t bytes);

}  // namespace lfdsim::detail
