// Limits of the reader, against hostile model files.
#pragma once
#include <cstdint>

namespace lfdsim::reader {

/// Limits this process: address space and processor time; no core dump, no file written; ends when its parent does.
/// Under AddressSanitizer the address space is not limited, as its shadow memory takes terabytes of it.
void confine(std::int64_t bytes, double seconds);

}  // namespace lfdsim::reader
