// Which sanitizer the tests are built with.
#pragma once
#if defined(__SANITIZE_ADDRESS__)
#define LFDSIM_ASAN true
#elif defined(__has_feature)
#define LFDSIM_ASAN __has_feature(address_sanitizer)
#else
#define LFDSIM_ASAN false
#endif

namespace lfdsim {

/// AddressSanitizer keeps freed memory for a while, and its shadow memory takes terabytes of address space.
inline constexpr bool address_sanitizer = LFDSIM_ASAN;

}  // namespace lfdsim
